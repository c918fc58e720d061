// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/paths.h"

#include "granular/lines/id_finder.h"
#include "granular/lines/minimum_image.h"
#include "granular/particles/point_forms.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/unwrap.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
/// Puts the particles of frames together to paths.
class Joiner
{
public:
  Joiner(std::vector<PathFrame>& frames, const PathJoin& join, Progress& progress)
    : frames_(frames)
    , join_(join)
    , progress_(progress)
  {
  }

  Paths run()
  {
    this->find_paths();
    this->lay_out();
    for (std::size_t f = 0; f < frames_.size(); ++f)
    {
      progress_.step(static_cast<double>(f) / static_cast<double>(frames_.size()));
      paths_.headers.push_back(frames_[f].header);
      unwrapper_.add_box(less_origin(frames_[f].header.box, join_.frames_origin));
      this->add_frame(f);
      frames_[f] = {};
    }
    paths_.begins.pop_back();
    paths_.begins.insert(paths_.begins.begin(), 0);
    return std::move(paths_);
  }

  std::int64_t long_steps() const noexcept { return long_steps_; }

private:
  /// Numbers the particles in the order of their ids, and counts their places.
  void find_paths()
  {
    IdTable places;
    std::vector<std::int64_t> found; // ids in the order in which they occur
    std::vector<std::int64_t> counts;
    for (PathFrame& frame : frames_)
    {
      for (std::int64_t& id : frame.ids)
      {
        const auto next = static_cast<std::int64_t>(found.size());
        const bool is_new = places.add(id, next);
        const std::int64_t place = is_new ? next : places.find(id);
        if (is_new)
        {
          found.push_back(id);
          counts.push_back(0);
        }
        ++counts[static_cast<std::size_t>(place)];
        id = place; // from here on
      }
    }
    std::vector<std::size_t> order(found.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    std::sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return found[a] < found[b]; });
    path_of_.resize(found.size());
    paths_.begins = { 0 };
    for (const std::size_t place : order)
    {
      path_of_[place] = static_cast<std::int64_t>(paths_.ids.size());
      paths_.ids.push_back(found[place]);
      paths_.begins.push_back(paths_.begins.back() + counts[place]);
    }
  }

  void lay_out()
  {
    const auto places = static_cast<std::size_t>(paths_.begins.back());
    paths_.frames.resize(places);
    paths_.points.resize(3 * places);
    if (join_.crossings)
    {
      paths_.shown_origin = join_.frames_origin;
      paths_.shown.resize(3 * places);
      paths_.crossings.resize(3 * places);
    }
    for (std::size_t i = 0; !frames_.empty() && i < frames_.front().arrays.size(); ++i)
    {
      const PathArray& array = frames_.front().arrays[i];
      paths_.arrays.push_back({ array.name, array.size, array.integers, {} });
      paths_.arrays.back().words.resize(places * static_cast<std::size_t>(array.size));
    }
    states_.resize(paths_.ids.size());
  }

  void add_frame(std::size_t f)
  {
    PathFrame& frame = frames_[f];
    std::vector<double> counts(3 * frame.ids.size());
    std::vector<double> drifts(counts.size());
    std::vector<std::int64_t> to(frame.ids.size());
    for (std::size_t i = 0; i < frame.ids.size(); ++i)
    {
      const std::int64_t path = path_of_[static_cast<std::size_t>(frame.ids[i])];
      PathState& state = states_[static_cast<std::size_t>(path)];
      if (state.frame == static_cast<std::int64_t>(f))
      {
        this->fail_repeated(f, path, i);
      }
      const Unwrapper::Step step = unwrapper_.advance(state, frame, i);
      long_steps_ += step.is_long ? 1 : 0;
      // begins move to the ends while frames are added
      const std::int64_t place = paths_.begins[static_cast<std::size_t>(path)]++;
      to[i] = place;
      paths_.frames[static_cast<std::size_t>(place)] = static_cast<std::int32_t>(f);
      for (std::size_t k = 0; k < 3; ++k)
      {
        counts[3 * i + k] = static_cast<double>(state.counts[k]);
        drifts[3 * i + k] = state.drift[k];
      }
      if (join_.crossings)
      {
        std::ranges::copy(step.counts, paths_.crossings.begin() + 3 * place);
        std::copy_n(frame.points.begin() + 3 * static_cast<std::ptrdiff_t>(i), 3,
          paths_.shown.begin() + 3 * place);
      }
    }
    convert_positions(plan_form(Coordinates::Absolute, ColumnRole::UnwrappedPosition),
      frame.header.box, minus(join_.origin, join_.frames_origin), counts, frame.points);
    std::ranges::transform(frame.points, drifts, frame.points.begin(), std::plus<>());
    scatter(frame.points, 3, to, paths_.points);
    for (std::size_t a = 0; a < frame.arrays.size(); ++a)
    {
      scatter(frame.arrays[a].words, static_cast<std::size_t>(frame.arrays[a].size), to,
        paths_.arrays[a].words);
    }
  }

  [[noreturn]] void fail_repeated(std::size_t f, std::int64_t path, std::size_t second)
  {
    const PathFrame& frame = frames_[f];
    const auto is_same = [&](std::int64_t place)
    { return path_of_[static_cast<std::size_t>(place)] == path; };
    const auto first = std::ranges::find_if(frame.ids, is_same) - frame.ids.begin();
    const auto row_of = [&](std::size_t i) { return frame.has_rows ? frame.rows[i] : -1; };
    const std::int64_t id = paths_.ids[static_cast<std::size_t>(path)];
    if (join_.name_rows)
    {
      join_.name_rows(id, f);
    }
    throw_repeated(
      id, frame.header.timestep, row_of(static_cast<std::size_t>(first)), row_of(second));
  }

  template <class Value>
  static void scatter(const std::vector<Value>& from, std::size_t size,
    const std::vector<std::int64_t>& to, std::vector<Value>& all)
  {
    for (std::size_t i = 0; i < to.size(); ++i)
    {
      std::copy_n(
        from.data() + i * size, size, all.data() + static_cast<std::size_t>(to[i]) * size);
    }
  }

  std::vector<PathFrame>& frames_;
  const PathJoin& join_;
  Progress& progress_;
  std::vector<std::int64_t> path_of_; ///< by the order in which the ids occur
  std::vector<PathState> states_;     ///< of paths
  Unwrapper unwrapper_;
  std::int64_t long_steps_ = 0;
  Paths paths_;
};
}

Paths join_frames(std::vector<PathFrame> frames, const PathJoin& join, Communicator& ranks,
  Notices& notices, Progress& progress)
{
  return do_together(ranks,
    [&]
    {
      expect_none(share_kinds(frames, ranks));
      exchange_frames(frames, share_out(frames, ranks), ranks);
      Joiner joiner(frames, join, progress);
      Paths paths = joiner.run();
      std::int64_t long_steps = joiner.long_steps();
      ranks.sum({ &long_steps, 1 });
      if (long_steps > 0)
      {
        notices.push_back(note_long_steps(long_steps));
      }
      return paths;
    });
}

Notice note_long_steps(std::int64_t steps)
{
  Notice notice;
  notice.topic = "long steps";
  notice.text = std::to_string(steps) +
    " steps from frame to frame are longer than a quarter of a period: without image counts ix iy "
    "iz some may go to a wrong image";
  return notice;
}
}
