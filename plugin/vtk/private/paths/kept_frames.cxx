// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/kept_frames.h"

#include "granular/common/error.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cstddef>
#include <list>
#include <utility>

namespace vtkGranularPrivate
{
namespace
{
std::vector<int> FindInputs(vtkAlgorithm* consumer)
{
  std::vector<int> inputs;
  for (int port = 0; port < consumer->GetNumberOfInputPorts(); ++port)
  {
    if (consumer->GetNumberOfInputConnections(port) > 0)
    {
      inputs.push_back(port);
    }
  }
  return inputs;
}

/**
 * When the pipelines of the inputs were changed last.
 */
std::vector<vtkMTimeType> FindChanged(vtkAlgorithm* consumer)
{
  std::vector<vtkMTimeType> changed;
  for (const int port : FindInputs(consumer))
  {
    auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(consumer->GetInputExecutive(port, 0));
    changed.push_back(pipeline ? pipeline->GetPipelineMTime() : 0);
  }
  return changed;
}

vtkSmartPointer<vtkDataObject> Copy(vtkDataObject* data)
{
  auto copy = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  copy->ShallowCopy(data);
  return copy;
}
}

void KeptFrames::Begin(
  vtkAlgorithm* consumer, const InputFrames::Part& part, granular::Communicator& ranks)
{
  this->Last.reset();
  const std::vector<vtkMTimeType> changed = FindChanged(consumer);
  const bool same =
    changed == this->Changed && part.Piece == this->Part.Piece && part.Pieces == this->Part.Pieces;
  std::int64_t others = same ? 0 : 1;
  ranks.sum({ &others, 1 });
  if (others > 0)
  {
    this->Kept.clear();
    this->Empty = 0;
  }
  this->Changed = changed;
  this->Part = part;
  this->Shown.Data.clear();
  for (const int port : FindInputs(consumer))
  {
    vtkDataObject* data = consumer->GetInputDataObject(port, 0);
    this->Shown.Data.push_back(data ? Copy(data) : nullptr);
  }
  const InputFrames frames(consumer, part);
  this->Times = frames.GetTimes();
  CheckTimes(this->Times, ranks);
  const std::optional<double> time = frames.GetTime() ? frames.GetTime() : frames.GetShownTime();
  const auto after = time ? std::ranges::upper_bound(this->Times, *time) : this->Times.begin();
  this->ShownNumber =
    static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - this->Times.begin() - 1, 0));
  this->Shown.Time = this->Times.empty() ? 0 : this->Times[this->ShownNumber];
}

FrameData KeptFrames::Get(vtkAlgorithm* consumer, std::size_t number, granular::Communicator& ranks)
{
  if (number == this->ShownNumber)
  {
    this->Last = this->Shown;
    return this->Shown.Data;
  }
  const double time = this->Times[number];
  if (this->Last && this->Last->Time == time)
  {
    return this->Last->Data;
  }
  const auto found = std::ranges::find(this->Kept, time, &Frame::Time);
  std::int64_t missing = found == this->Kept.end() ? 1 : 0;
  ranks.sum({ &missing, 1 });
  this->Last = missing == 0 ? *found : this->Read(consumer, time, ranks);
  return this->Last->Data;
}

std::size_t KeptFrames::FindFirst(vtkAlgorithm* consumer, granular::Communicator& ranks)
{
  for (; this->Empty < this->ShownNumber; ++this->Empty)
  {
    const FrameData data = this->Get(consumer, this->Empty, ranks);
    auto* points = vtkPointSet::SafeDownCast(data[0]);
    std::int64_t count = points ? points->GetNumberOfPoints() : 1; // others are refused later
    ranks.sum({ &count, 1 });
    if (count > 0)
    {
      break;
    }
  }
  return std::min(this->Empty, this->ShownNumber);
}

KeptFrames::Frame KeptFrames::Read(
  vtkAlgorithm* consumer, double time, granular::Communicator& ranks) const
{
  Frame frame{ time, {} };
  std::list<InputFrames> inputs; // which make the shown time the current one again at the end
  for (const int port : FindInputs(consumer))
  {
    InputFrames& input = inputs.emplace_back(consumer, this->Part, port);
    input.Update(time, ranks);
    frame.Data.push_back(Copy(input.GetData()));
  }
  for (InputFrames& input : inputs)
  {
    input.Restore(ranks);
  }
  return frame;
}

void KeptFrames::End(bool keepShown)
{
  this->Kept.clear();
  if (this->Last)
  {
    this->Kept.push_back(std::move(*this->Last));
    this->Last.reset();
  }
  if (keepShown && (this->Kept.empty() || this->Kept.front().Time != this->Shown.Time))
  {
    this->Kept.push_back(this->Shown);
  }
  this->Shown.Data.clear();
}
}
