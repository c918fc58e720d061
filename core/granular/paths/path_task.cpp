// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/path_task.h"

#include "granular/common/words.h"
#include "granular/frames/frame_times.h"
#include "granular/particles/known_arrays.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace granular
{
PathTask::PathTask(FrameLoader& all_frames, PathChoice choice, const FrameView& shown,
  Communicator& all, Communicator& ranks, Notices& told, PartialProgress& report)
  : frames(all_frames)
  , group(all)
  , notices(told)
  , progress(report)
  , choice_(std::move(choice))
{
  if (shown.coordinates != Coordinates::Scaled)
  {
    origin = shown.point_origin;
    request.origin = origin;
  }
  request.arrays = share_names(choice_.arrays, shown, ranks);
  this->choose_frames();
  request.selection = IdSelection(choice_.ids);
  request.selection.keep_multiples(choice_.every_nth);
  this->choose_particles(restricts(choice_.region),
    static_cast<std::size_t>(std::max<std::int64_t>(choice_.samples, 0)), choice_.selection_frame);
}

void PathTask::choose_few(std::size_t few)
{
  const IdSelection all = request.selection;
  if (choice_.samples < 0 && all.is_all())
  {
    if (this->choose_particles(false, few, choice_.selection_frame) == 0)
    {
      request.selection = all;
      this->choose_particles(false, few, static_cast<std::int64_t>(frames.size() / 2));
    }
  }
}

void PathTask::keep_tail(double time, std::int64_t tail)
{
  const std::vector<double> all = this->times();
  const auto next = std::ranges::upper_bound(all, time);
  const auto end = std::max<std::ptrdiff_t>(next - all.begin(), 1);
  const auto first = std::max<std::ptrdiff_t>(end - 1 - tail, 0);
  numbers = { numbers.begin() + first, numbers.begin() + end };
}

void PathTask::choose_frames()
{
  const std::vector<std::size_t> all =
    frames_in_window(choice_.window, frames.size(), frames.times());
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(choice_.stride))
  {
    numbers.push_back(all[i]);
  }
}

/// Returns the number of particles that a frame has of those that are wanted, if it matters.
std::size_t PathTask::choose_particles(bool has_region, std::size_t samples, std::int64_t wanted)
{
  IdSelection& selection = request.selection;
  if (!has_region && samples == 0)
  {
    return 0;
  }
  const auto count = static_cast<std::int64_t>(frames.size());
  if (wanted >= count || wanted < -count)
  {
    throw Error("expected a SelectionFrame from " + std::to_string(-count) + " to " +
      std::to_string(count - 1) + ", got " + std::to_string(wanted));
  }
  const auto number = static_cast<std::size_t>(wanted < 0 ? wanted + count : wanted);
  PathRequest in_frame;
  in_frame.selection = selection;
  in_frame.points = has_region;
  in_frame.absolute = true;
  const PathFrame frame = std::move(frames.load({ number }, in_frame, notices, progress).front());
  const std::vector<std::int64_t> ids =
    has_region ? ids_in_region(frame, choice_.region) : frame.ids;
  const std::vector<std::int64_t> chosen =
    samples > 0 ? sample_ids(ids, samples, choice_.seed, group) : share_ids(ids, group);
  selection.keep_only(chosen);
  return chosen.size();
}

void PathTask::note_absent(const std::vector<std::int64_t>& ids)
{
  constexpr std::size_t most = 5;
  const IdSelection& selection = request.selection;
  std::vector<std::int64_t> named;
  std::ranges::copy_if(selection.named(), std::back_inserter(named),
    [&](std::int64_t id) { return selection.holds(id); });
  std::vector<std::int64_t> found(named.size());
  std::ranges::transform(named, found.begin(),
    [&](std::int64_t id) { return std::ranges::binary_search(ids, id) ? 1 : 0; });
  group.sum(found);
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
    notices.push_back({ {},
      "ids that are in no frame: " + join_words(absent, ", ") +
        (count > most ? " and " + std::to_string(count - most) + " others" : "") });
  }
}

std::vector<double> PathTask::times() const
{
  const std::vector<double>& all = frames.times();
  std::vector<double> chosen;
  for (const std::size_t number : numbers)
  {
    chosen.push_back(all.empty() ? 0 : all[number]);
  }
  return chosen;
}

Paths PathTask::join(std::vector<PathFrame> loaded, bool crossings)
{
  PathJoin join;
  join.origin = origin;
  join.frames_origin = origin;
  join.crossings = crossings;
  join.name_rows = [this](std::int64_t id, std::size_t frame)
  { frames.name_rows(id, numbers[frame]); };
  return join_frames(std::move(loaded), join, group, notices, progress);
}
}
