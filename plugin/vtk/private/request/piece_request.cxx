// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/piece_request.h"

#include "granular/common/shares.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

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
}
