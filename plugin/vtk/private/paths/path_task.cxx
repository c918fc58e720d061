// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/path_task.h"

#include "private/dump/dump_input.h"

#include "granular/common/words.h"
#include "granular/geometry/box.h"
#include "granular/memory/block.h"
#include "granular/parallel/executor.h"
#include "granular/parallel/trade.h"
#include "granular/particles/known_arrays.h"

#include "vtkAlgorithm.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace vtkGranularPrivate
{
namespace
{
/**
 * The memory that frames are decoded in is used again for the next ones.
 */
constexpr std::size_t PoolBytes = std::size_t{ 1 } << 30;

granular::Coordinates FormOf(const granular::Request& shown, const granular::PathRequest& request)
{
  return shown.coordinates == granular::Coordinates::Unwrapped && !request.absolute
    ? granular::Coordinates::Unwrapped
    : granular::Coordinates::Absolute;
}
}

PathFrames::PathFrames(
  vtkAlgorithm* consumer, granular::Communicator& group, granular::Communicator& ranks, int threads)
  : Group(group)
  , Ranks(ranks)
  , Threads(threads)
{
  this->Input.emplace(consumer, InputFrames::Part{ group.rank(), group.size(), 0 });
  this->Times = this->Input->GetTimes();
  CheckTimes(this->Times, ranks);
  this->Reader = ReaderFrames::Find(consumer);
  if (this->Reader && this->Reader->Index->size() != this->GetSize())
  {
    this->Reader.reset();
  }
  // all of them read the files, or none
  std::int64_t readers = this->Reader ? 1 : 0;
  ranks.sum({ &readers, 1 });
  if (readers != ranks.size())
  {
    this->Reader.reset();
  }
  if (this->Reader)
  {
    this->Reader->Request.pool = std::make_shared<granular::BlockPool>(PoolBytes);
  }
}

std::vector<granular::PathFrame> PathFrames::Load(const std::vector<std::size_t>& numbers,
  const granular::PathRequest& request, granular::Notices& notices,
  granular::PartialProgress& progress)
{
  std::vector<granular::PathFrame> frames(numbers.size());
  if (!this->Reader)
  {
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      progress.step(static_cast<double>(i) / static_cast<double>(numbers.size()));
      granular::Progress quiet;
      frames[i] = this->Request(numbers[i], request, quiet);
    }
    return frames;
  }
  for (granular::PathFrame& frame : frames)
  {
    for (const std::string& name : request.arrays)
    {
      frame.arrays.push_back({ name });
    }
  }
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (static_cast<int>(i % static_cast<std::size_t>(this->Group.size())) == this->Group.rank())
    {
      own.push_back(i);
    }
  }
  granular::Request base = this->Reader->Request;
  base.coordinates = FormOf(base, request);
  base.threads = std::max(1, this->Threads / std::max(1, static_cast<int>(own.size())));
  std::vector<granular::Notices> said(own.size());
  granular::do_together(this->Ranks,
    [&]
    {
      granular::Executor(this->Threads)
        .parallel_for(
          own.size(),
          [&](std::size_t i, std::size_t)
          {
            granular::Progress quiet; // that of the whole is reported between frames
            frames[own[i]] = granular::read_particles(
              this->Reader->Index->pieces(numbers[own[i]]), request, base, said[i], quiet);
          },
          progress);
    });
  for (const granular::Notices& some : said)
  {
    notices.insert(notices.end(), some.begin(), some.end());
  }
  return frames;
}

granular::PathFrame PathFrames::LoadPart(std::size_t number, const granular::PathRequest& request,
  granular::Notices& notices, granular::PartialProgress& progress, granular::PathFrame spent)
{
  if (!this->Reader)
  {
    return this->Request(number, request, progress);
  }
  granular::Request base = this->Reader->Request;
  base.coordinates = FormOf(base, request);
  base.threads = this->Threads;
  base.piece = this->Group.rank();
  base.pieces = this->Group.size();
  return granular::do_together(this->Ranks,
    [&]
    {
      return granular::read_particles(
        this->Reader->Index->pieces(number), request, base, notices, progress, std::move(spent));
    });
}

granular::PathFrame PathFrames::Request(
  std::size_t number, const granular::PathRequest& request, granular::Progress& progress)
{
  this->Input->Update(
    this->Times.empty() ? std::nullopt : std::optional(this->Times[number]), this->Ranks);
  return granular::do_together(this->Ranks,
    [&]
    {
      const Particles particles(this->Input->GetData(), this->Group);
      const granular::FrameView& view = particles.View;
      const std::vector<std::int64_t> rows = granular::gather(this->Group, view.rows);
      const std::int64_t first =
        std::accumulate(rows.begin(), rows.begin() + this->Group.rank(), std::int64_t{ 0 });
      return granular::pick_particles(
        view, request, first, granular::Executor(this->Threads), progress);
    });
}

void PathFrames::NameRows(std::int64_t id, std::size_t number) const
{
  if (!this->Reader)
  {
    return;
  }
  granular::PathRequest all;
  all.points = false;
  granular::Request base;
  base.pool = this->Reader->Request.pool;
  granular::Notices notices;
  granular::Progress quiet;
  const std::vector<granular::FramePiece> pieces = this->Reader->Index->pieces(number);
  const granular::PathFrame frame = granular::read_particles(pieces, all, base, notices, quiet);
  const auto first = std::ranges::find(frame.ids, id);
  const auto second = first == frame.ids.end() ? first : std::find(first + 1, frame.ids.end(), id);
  if (second != frame.ids.end())
  {
    granular::throw_repeated(id, frame.header.timestep, first - frame.ids.begin(),
      second - frame.ids.begin(), granular::where_of(pieces.front()));
  }
}
}

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
void vtkGranularPathAlgorithm::PathTask::Choose()
{
  this->ReadInput();
  this->ChooseFrames();
  this->Request.selection = granular::IdSelection(this->Self->Ids);
  this->Request.selection.keep_multiples(this->Self->EveryNth);
  this->ChooseParticles(granular::restricts(this->Self->RegionOfInterest),
    static_cast<std::size_t>(std::max<vtkTypeInt64>(this->Self->NumberOfSamples, 0)),
    this->Self->SelectionFrame);
}

//------------------------------------------------------------------------------
void vtkGranularPathAlgorithm::PathTask::ChooseFew(std::size_t few)
{
  const granular::IdSelection all = this->Request.selection;
  if (this->Self->NumberOfSamples < 0 && all.is_all())
  {
    if (this->ChooseParticles(false, few, this->Self->SelectionFrame) == 0)
    {
      this->Request.selection = all;
      this->ChooseParticles(false, few, static_cast<std::int64_t>(this->Frames.GetSize() / 2));
    }
  }
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
  this->Request.arrays = granular::share_names(this->Self->Arrays, view, this->Ranks);
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
// Returns the number of particles that a frame has of those that are wanted, if it matters.
std::size_t vtkGranularPathAlgorithm::PathTask::ChooseParticles(
  bool hasRegion, std::size_t samples, std::int64_t wanted)
{
  granular::IdSelection& selection = this->Request.selection;
  if (!hasRegion && samples == 0)
  {
    return 0;
  }
  const auto frames = static_cast<std::int64_t>(this->Frames.GetSize());
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
  const std::vector<std::int64_t> chosen = samples > 0
    ? granular::sample_ids(ids, samples, this->Self->Seed, this->Group)
    : granular::share_ids(ids, this->Group);
  selection.keep_only(chosen);
  return chosen.size();
}

//------------------------------------------------------------------------------
void vtkGranularPathAlgorithm::PathTask::NoteAbsent(const std::vector<std::int64_t>& ids)
{
  constexpr std::size_t most = 5;
  const granular::IdSelection& selection = this->Request.selection;
  std::vector<std::int64_t> named;
  std::ranges::copy_if(selection.named(), std::back_inserter(named),
    [&](std::int64_t id) { return selection.holds(id); });
  std::vector<std::int64_t> found(named.size());
  std::ranges::transform(named, found.begin(),
    [&](std::int64_t id) { return std::ranges::binary_search(ids, id) ? 1 : 0; });
  this->Group.sum(found);
  std::vector<std::string> absent;
  for (std::size_t i = 0; i < named.size(); ++i)
  {
    if (found[i] == 0)
    {
      absent.push_back(std::to_string(named[i]));
    }
  }
  if (const std::size_t count = absent.size(); count > 0)
  {
    absent.resize(std::min(count, most));
    this->Notices.push_back({ {},
      "ids that are in no frame: " + granular::join_words(absent, ", ") +
        (count > most ? " and " + std::to_string(count - most) + " others" : "") });
  }
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
