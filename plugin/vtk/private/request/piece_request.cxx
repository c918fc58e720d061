// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/piece_request.h"

#include "granular/common/archive.h"
#include "granular/common/shares.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cstring>

namespace vtkGranularPrivate
{
PieceRequest PieceRequest::Of(vtkInformation* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  PieceRequest request;
  if (output->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()))
  {
    request.Piece = output->Get(Pipeline::UPDATE_PIECE_NUMBER());
    request.Pieces = output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  }
  return request;
}

std::pair<vtkTypeInt64, vtkTypeInt64> PieceRequest::RangeOf(vtkTypeInt64 count) const
{
  const auto first = [&](int piece)
  { return piece < this->Pieces ? granular::begin_of_part(count, piece, this->Pieces) : count; };
  return { first(this->Piece), first(this->Piece + 1) };
}

bool AskTogether(const PieceRequest& wanted, const std::string& form, granular::Communicator& ranks)
{
  granular::ArchiveWriter packer;
  granular::do_together(ranks,
    [&]
    {
      int piece = wanted.Piece;
      int pieces = wanted.Pieces;
      packer.number(piece);
      packer.number(pieces);
      packer.bytes += form;
    });
  constexpr std::size_t piece = sizeof wanted.Piece;
  int rank = 0;
  bool together = wanted.Pieces == ranks.size();
  for (const std::string& other : ranks.all_gather(packer.bytes))
  {
    together = together && std::memcmp(other.data(), &rank, piece) == 0 &&
      other.compare(piece, other.npos, packer.bytes, piece) == 0;
    ++rank;
  }
  return together;
}
}
