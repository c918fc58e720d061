// SPDX-License-Identifier: BSD-3-Clause
#include "piece_request.h"

#include "granular/dump/exchange_rows.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

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
}
