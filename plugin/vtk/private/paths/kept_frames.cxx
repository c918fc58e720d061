// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/kept_frames.h"

#include "granular/common/error.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <list>
#include <optional>

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
  this->Shown.clear();
  for (const int port : FindInputs(consumer))
  {
    vtkDataObject* data = consumer->GetInputDataObject(port, 0);
    this->Shown.push_back(data ? Copy(data) : nullptr);
  }
  const InputFrames frames(consumer, part);
  this->Times = frames.GetTimes();
  CheckTimes(this->Times, ranks);
  const std::optional<double> time = frames.GetTime() ? frames.GetTime() : frames.GetShownTime();
  const auto after = time ? std::ranges::upper_bound(this->Times, *time) : this->Times.begin();
  this->ShownNumber =
    static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - this->Times.begin() - 1, 0));
}

FrameData KeptFrames::Get(vtkAlgorithm* consumer, std::size_t number, granular::Communicator& ranks)
{
  this->Last = number;
  if (number == this->ShownNumber)
  {
    return this->Shown;
  }
  const double time = this->Times[number];
  std::int64_t missing = this->Kept.contains(time) ? 0 : 1;
  ranks.sum({ &missing, 1 });
  if (missing > 0)
  {
    this->Kept[time] = this->Read(consumer, time, ranks);
  }
  return this->Kept[time];
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
    this->Kept.erase(this->Times[this->Empty]);
  }
  return std::min(this->Empty, this->ShownNumber);
}

FrameData KeptFrames::Read(vtkAlgorithm* consumer, double time, granular::Communicator& ranks) const
{
  FrameData frame;
  std::list<InputFrames> inputs; // which make the shown time the current one again at the end
  for (const int port : FindInputs(consumer))
  {
    InputFrames& input = inputs.emplace_back(consumer, this->Part, port);
    input.Update(time, ranks);
    frame.push_back(Copy(input.GetData()));
  }
  for (InputFrames& input : inputs)
  {
    input.Restore(ranks);
  }
  return frame;
}

void KeptFrames::End(bool keepShown)
{
  if (!this->Times.empty())
  {
    std::erase_if(
      this->Kept, [&](const auto& frame) { return frame.first != this->Times[this->Last]; });
    if (keepShown || this->Last == this->ShownNumber)
    {
      this->Kept[this->Times[this->ShownNumber]] = this->Shown;
    }
  }
  this->Shown.clear();
}
}
