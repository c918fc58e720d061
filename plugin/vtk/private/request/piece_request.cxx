// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/piece_request.h"

#include "granular/common/shares.h"

#include "vtkAlgorithm.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace vtkGranularPrivate
{
namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

/**
 * Holds the piece, the number of pieces and the ghost levels that were requested of an output.
 */
class PiecesKey : public vtkInformationIntegerVectorKey
{
public:
  PiecesKey()
    : vtkInformationIntegerVectorKey("PIECES", "vtkGranularKeptPieces", 3)
  {
  }

  void CopyDefaultInformation(
    vtkInformation* request, vtkInformation* from, vtkInformation* to) override
  {
    if (request->Has(Pipeline::REQUEST_INFORMATION()))
    {
      const int wanted[] = { to->Get(Pipeline::UPDATE_PIECE_NUMBER()),
        to->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()),
        to->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) };
      this->Set(to, wanted, 3);
    }
    else if (request->Has(Pipeline::REQUEST_UPDATE_TIME()))
    {
      const int* const wanted = this->Get(from);
      if (wanted[1] > 1 && from->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) == 1)
      {
        from->Set(Pipeline::UPDATE_PIECE_NUMBER(), wanted[0]);
        from->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), wanted[1]);
        from->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), wanted[2]);
      }
      const int none[] = { 0, 1, 0 };
      this->Set(from, none, 3);
    }
  }
};

PiecesKey* GetKey()
{
  static PiecesKey* const key = new PiecesKey; // of VTK, which deletes all keys
  return key;
}
}

PieceRequest PieceRequest::Of(vtkInformation* output)
{
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

void ForgetPieces(vtkInformation* output)
{
  const int none[] = { 0, 1, 0 };
  if (output->Has(GetKey()))
  {
    output->Set(GetKey(), none, 3);
  }
}

void KeepPieces(vtkAlgorithm* self, vtkInformationVector* outputs)
{
  // other programs say which piece they want after information is made
  if (self->GetExecutive()->IsA("vtkPVCompositeDataPipeline"))
  {
    const int none[] = { 0, 1, 0 };
    for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
    {
      outputs->GetInformationObject(port)->Set(GetKey(), none, 3);
    }
  }
}
}
