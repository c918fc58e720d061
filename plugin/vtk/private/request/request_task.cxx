// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/request_task.h"

#include "vtkGranularAlgorithm.h"

#include "vtkDataObject.h"
#include "vtkInformationVector.h"

#include <cstdint>

namespace vtkGranularPrivate
{
namespace
{
bool IsOwn(const PieceRequest& wanted, const granular::Communicator& ranks)
{
  return wanted.Pieces == ranks.size() && wanted.Piece == ranks.rank();
}

/**
 * Returns true if each rank requests its own part of a whole, false if each requests all or is alone.
 */
bool AreTogether(const PieceRequest& wanted, bool mayDiffer, granular::Communicator& ranks)
{
  std::int64_t all = IsOwn(wanted, ranks) ? 1 : 0;
  ranks.sum({ &all, 1 });
  const bool together = all == ranks.size();
  if (all != 0 && !together && !mayDiffer)
  {
    throw granular::UnsupportedError(
      "expected that all processes ask for their own piece, or none, got " + std::to_string(all) +
      " of " + std::to_string(ranks.size()));
  }
  return together;
}
}

PieceRequest PieceOfInput(const PieceRequest& wanted, const granular::Communicator& ranks)
{
  return IsOwn(wanted, ranks) ? wanted : PieceRequest();
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
  , Together(AreTogether(this->Wanted, mayDiffer, this->Ranks))
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
