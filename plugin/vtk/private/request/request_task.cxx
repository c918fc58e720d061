// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/request_task.h"

#include "vtkGranularAlgorithm.h"

#include "granular/parallel/pieces.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstdint>

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
  return granular::range_of_piece(count, this->Piece, this->Pieces);
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

PieceRequest PieceOfInput(const PieceRequest& wanted, const granular::Communicator& ranks)
{
  return granular::is_own_piece(wanted.Piece, wanted.Pieces, ranks) ? wanted : PieceRequest();
}

RequestTask::RequestTask(vtkGranularAlgorithm* self, vtkInformation* request,
  vtkInformationVector** inputs, vtkInformationVector* outputs, bool mayDiffer)
  : Algorithm(self)
  , Inputs(inputs)
  , Outputs(outputs)
  , AlgorithmReport(self)
  , RankReport(this->AlgorithmReport, self->Ranks->Get())
  , Ranks(self->Ranks->Get())
  , Wanted(PieceRequest::Of(request, outputs))
  , Together(
      granular::are_together(this->Wanted.Piece, this->Wanted.Pieces, mayDiffer, this->Ranks))
  , Group(this->Together ? this->Ranks : this->Alone)
  , Threads(ChooseThreads(self->GetThreads(), this->Ranks))
  , Progress(this->RankReport)
{
}

void RequestTask::Run()
{
  this->Progress.step(0);
  this->Execute();
  this->Progress.set_part(1, 1);
  this->Progress.step(1);
  for (const granular::Notice& notice : this->Notices)
  {
    const std::string text = granular::to_string(notice);
    const std::string& topic = notice.topic.empty() ? text : notice.topic;
    if (notice.where.path.empty())
    {
      this->Tell(true, topic, text);
    }
    else
    {
      this->Remarks.push_back({ topic, text }); // the rank that read the file knows it alone
    }
  }
  this->Algorithm->Ranks->Warn(this->Algorithm, this->Remarks);
}

vtkDataObject* RequestTask::GetInput(int port) const
{
  return vtkDataObject::GetData(this->Inputs[port]);
}

vtkInformation* RequestTask::GetOutputInformation() const
{
  return this->Outputs->GetInformationObject(0);
}

std::pair<vtkTypeInt64, vtkTypeInt64> RequestTask::RangeOf(vtkTypeInt64 count) const
{
  return this->Together ? std::pair(vtkTypeInt64{ 0 }, count) : this->Wanted.RangeOf(count);
}

void RequestTask::Tell(bool holds, const std::string& topic, const std::string& text)
{
  if (holds && (this->Ranks.rank() == 0 || !this->Together))
  {
    this->Remarks.push_back({ topic, text });
  }
}
}
