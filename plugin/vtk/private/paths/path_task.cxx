// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/path_task.h"

#include "private/dump/particles.h"
#include "private/dump/shared_names.h"

#include "granular/geometry/region.h"
#include "granular/paths/id_selection.h"

#include <algorithm>
#include <cstdint>

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
void vtkGranularPathAlgorithm::PathTask::Choose()
{
  this->ReadInput();
  this->ChooseFrames();
  this->ChooseParticles();
}

//------------------------------------------------------------------------------
/**
 * Reads what the shown frame tells: the origin of the points, and the names that "*" stands for.
 */
void vtkGranularPathAlgorithm::PathTask::ReadInput()
{
  const Particles particles(this->GetInput(0), this->Ranks);
  const granular::FrameView& view = particles.View;
  if (view.coordinates != granular::Coordinates::Scaled)
  {
    this->Origin = view.point_origin;
    this->Request.origin = this->Origin;
  }
  this->Request.arrays = ShareNames(this->Self->Arrays, view, this->Ranks);
}

//------------------------------------------------------------------------------
void vtkGranularPathAlgorithm::PathTask::ChooseFrames()
{
  const std::vector<double>& times = this->Frames.GetTimes();
  const auto [first, last] = this->Self->TimeWindow;
  std::size_t count = 0; // in the range
  for (std::size_t i = 0; i < this->Frames.GetSize(); ++i)
  {
    if (first > last || (!times.empty() && times[i] >= first && times[i] <= last))
    {
      if (count++ % static_cast<std::size_t>(this->Self->FrameStride) == 0)
      {
        this->Numbers.push_back(i);
      }
    }
  }
  if (this->Numbers.empty())
  {
    throw granular::Error("expected a TimeWindow with frames, got none from " +
      std::to_string(first) + " to " + std::to_string(last));
  }
}

//------------------------------------------------------------------------------
void vtkGranularPathAlgorithm::PathTask::ChooseParticles()
{
  granular::IdSelection& selection = this->Request.selection;
  selection = granular::IdSelection(this->Self->Ids);
  selection.keep_multiples(this->Self->EveryNth);
  const auto samples = static_cast<std::size_t>(this->Self->NumberOfSamples);
  const bool hasRegion = granular::restricts(this->Self->RegionOfInterest);
  if (!hasRegion && samples == 0)
  {
    return;
  }
  const auto frames = static_cast<std::int64_t>(this->Frames.GetSize());
  const std::int64_t wanted = this->Self->SelectionFrame;
  if (wanted >= frames || wanted < -frames)
  {
    throw granular::Error("expected a SelectionFrame from " + std::to_string(-frames) + " to " +
      std::to_string(frames - 1) + ", got " + std::to_string(wanted));
  }
  const auto number = static_cast<std::size_t>(wanted < 0 ? wanted + frames : wanted);
  granular::PathRequest request;
  request.selection = selection;
  request.points = hasRegion;
  request.absolute = true;
  const granular::PathFrame frame =
    std::move(this->Frames.Load({ number }, request, this->Notices, this->Progress).front());
  const std::vector<std::int64_t> ids =
    hasRegion ? granular::ids_in_region(frame, this->Self->RegionOfInterest) : frame.ids;
  selection.keep_only(samples > 0
      ? granular::sample_ids(ids, samples, this->Self->Seed, this->Group)
      : granular::share_ids(ids, this->Group));
}

//------------------------------------------------------------------------------
std::vector<double> vtkGranularPathAlgorithm::PathTask::GetTimes()
{
  const std::vector<double>& all = this->Frames.GetTimes();
  std::vector<double> times;
  for (const std::size_t number : this->Numbers)
  {
    times.push_back(all.empty() ? 0 : all[number]);
  }
  return times;
}

//------------------------------------------------------------------------------
granular::Paths vtkGranularPathAlgorithm::PathTask::Join(
  std::vector<granular::PathFrame> frames, bool crossings)
{
  granular::PathJoin join;
  join.origin = this->Origin;
  join.frames_origin = this->Origin;
  join.crossings = crossings;
  join.name_rows = [this](std::int64_t id, std::size_t frame)
  { this->Frames.NameRows(id, this->Numbers[frame]); };
  return granular::join_frames(std::move(frames), join, this->Group, this->Notices, this->Progress);
}
