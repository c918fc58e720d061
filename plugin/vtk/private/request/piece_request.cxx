// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/piece_request.h"

#include "granular/common/archive.h"
#include "granular/common/shares.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
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

PieceRequest PieceRequest::Of(vtkInformation* request, vtkInformationVector* outputs)
{
  const int port = request->Has(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT())
    ? std::max(request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT()), 0)
    : 0;
  return PieceRequest::Of(outputs->GetInformationObject(port));
}

std::pair<vtkTypeInt64, vtkTypeInt64> PieceRequest::RangeOf(vtkTypeInt64 count) const
{
  const auto first = [&](int piece)
  { return piece < this->Pieces ? granular::begin_of_part(count, piece, this->Pieces) : count; };
  return { first(this->Piece), first(this->Piece + 1) };
}

bool AskTogether(granular::Communicator& ranks, const PieceRequest& wanted,
  const std::set<std::string>& arrays, const std::function<void(granular::ArchiveWriter&)>& form)
{
  granular::ArchiveWriter same;
  same.number(wanted.Pieces);
  form(same);
  for (const std::string& name : arrays)
  {
    same.text(name);
  }
  const std::string own = std::to_string(wanted.Piece) + ' ' + same.bytes;
  bool together = wanted.Pieces == ranks.size();
  const std::vector<std::string> all = ranks.all_gather(own);
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    together = together && all[rank] == std::to_string(rank) + ' ' + same.bytes;
  }
  return together;
}
}
