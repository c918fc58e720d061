// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/box.h"
#include "granular/lines/lines.h"
#include "granular/particles/point_forms.h"
#include "granular/paths/paths.h"
#include "granular/paths/unwrap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace granular
{
namespace
{
double distance(const double* a, const double* b) noexcept
{
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// Calls visit(path, first, end) for each stretch of places without a gap.
template <class Visit>
void visit_stretches(const Paths& paths, const Visit& visit)
{
  for (std::size_t path = 0; path < paths.ids.size(); ++path)
  {
    const std::int64_t end = paths.begins[path + 1];
    for (std::int64_t first = paths.begins[path]; first < end;)
    {
      std::int64_t last = first;
      const auto frame_of = [&](std::int64_t place)
      { return paths.frames[static_cast<std::size_t>(place)]; };
      while (last + 1 < end && frame_of(last + 1) == frame_of(last) + 1)
      {
        ++last;
      }
      visit(static_cast<std::int64_t>(path), first, last + 1);
      first = last + 1;
    }
  }
}

double length_of(const Paths& paths, std::int64_t first, std::int64_t end)
{
  double length = 0;
  for (std::int64_t place = first; place + 1 < end; ++place)
  {
    length += distance(paths.points.data() + 3 * place, paths.points.data() + 3 * (place + 1));
  }
  return length;
}

/// Moves a point into the box along periodic axes. Returns how many of each vector were taken away.
BoxCounts wrap(const BoxImages& images, Vector3& point)
{
  const Vector3 offset = minus(point, values_of(images.box.origin));
  BoxCounts counts;
  BoxCounts back;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    counts[axis] = static_cast<std::int64_t>(std::floor(dot(images.duals[axis], offset)));
    back[axis] = -counts[axis];
  }
  point = images.images.moved(point, back, {});
  return counts;
}

class Drawer
{
public:
  Drawer(const Paths& paths, const Vector3& origin)
    : paths_(paths)
    , origin_(minus(origin, paths.shown_origin))
  {
    lines_.begins.push_back(0);
  }

  PathLines run()
  {
    visit_stretches(paths_,
      [this](std::int64_t path, std::int64_t first, std::int64_t end)
      {
        length_ = length_of(paths_, first, end);
        path_ = path;
        for (std::int64_t place = first; place < end; ++place)
        {
          if (place > first && !paths_.crossings.empty())
          {
            this->cut(place);
          }
          this->add_point(this->drawn(place), place, 0);
        }
        this->end_line();
      });
    return std::move(lines_);
  }

private:
  /// Draws a step across faces, but for the place that it goes to. The parts of a step across several periods cross each face
  /// once at most; a step across very many is left out.
  void cut(std::int64_t place)
  {
    BoxCounts counts;
    std::copy_n(paths_.crossings.data() + 3 * place, 3, counts.begin());
    if (counts == BoxCounts{})
    {
      return;
    }
    const auto frame = static_cast<std::size_t>(paths_.frames[static_cast<std::size_t>(place)]);
    if (!images_ || frame_ != frame)
    {
      images_.emplace(less_origin(paths_.headers[frame].box, paths_.shown_origin));
      frame_ = frame;
    }
    std::int64_t most = 0;
    for (const std::int64_t count : counts)
    {
      most = std::max(most, std::abs(count));
    }
    if (most > PathLines::most_periods)
    {
      this->end_line();
      return;
    }
    Step step{ this->shown(place - 1), {}, {}, place - 1, 0, 0 };
    const Vector3 to = this->shown(place);
    const Vector3 way = images_->images.moved(to, counts, step.from);
    const std::int64_t steps = most > 1 ? most + 1 : 1;
    BoxCounts before = {};
    for (std::int64_t i = 1; i <= steps; ++i)
    {
      step.end = static_cast<double>(i) / static_cast<double>(steps);
      BoxCounts now = counts;
      step.to = to;
      if (i < steps)
      {
        const Vector3 start = this->shown(place - 1);
        step.to = { start[0] + step.end * way[0], start[1] + step.end * way[1],
          start[2] + step.end * way[2] };
        now = wrap(*images_, step.to);
      }
      step.counts = minus(now, before);
      this->cut(step);
      if (i < steps)
      {
        this->add_point(minus(step.to, origin_), place - 1, step.end);
      }
      before = now;
      step.from = step.to;
      step.begin = step.end;
    }
  }

  /// A part of the way from a place to the next one.
  struct Step
  {
    Vector3 from = {};
    Vector3 to = {};
    BoxCounts counts = {}; ///< that bring its end next to its beginning
    std::int64_t place = 0;
    double begin = 0; ///< where it is on the way
    double end = 0;
  };

  /// Ends the line at a face, and begins the next one at another face.
  void cut(const Step& step)
  {
    const LineSplitter splitter(images_->box, images_->images, origin_);
    std::array<LinePart, LineSplitter::most_parts> parts;
    const std::size_t count = splitter.split(step.from, step.to, step.counts, parts);
    double whole = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      whole += distance(parts[i].begin.data(), parts[i].end.data());
    }
    double done = 0;
    const auto part_now = [&]
    { return step.begin + std::min(done, 1.0) * (step.end - step.begin); };
    for (std::size_t i = 0; i < count; ++i)
    {
      // from a place in a face the only part may begin at the opposite face
      if (i > 0 || parts[i].begin != minus(step.from, origin_))
      {
        this->end_line();
        this->add_point(parts[i].begin, step.place, part_now());
      }
      done += whole > 0 ? distance(parts[i].begin.data(), parts[i].end.data()) / whole : 0;
      if (i + 1 < count)
      {
        this->add_point(parts[i].end, step.place, part_now());
      }
      else if (parts[i].end != minus(step.to, origin_)) // the end is in the opposite face
      {
        this->add_point(parts[i].end, step.place, step.end);
        this->end_line();
      }
    }
  }

  static Vector3 point_at(const std::vector<double>& points, std::int64_t place)
  {
    const double* const point = points.data() + 3 * place;
    return { point[0], point[1], point[2] };
  }

  Vector3 shown(std::int64_t place) const { return point_at(paths_.shown, place); }

  Vector3 drawn(std::int64_t place) const
  {
    return paths_.crossings.empty() ? point_at(paths_.points, place)
                                    : minus(this->shown(place), origin_);
  }

  void add_point(const Vector3& point, std::int64_t place, double part)
  {
    lines_.points.insert(lines_.points.end(), point.begin(), point.end());
    lines_.places.push_back(place);
    lines_.parts.push_back(part);
  }

  void end_line()
  {
    lines_.begins.push_back(static_cast<std::int64_t>(lines_.places.size()));
    lines_.paths.push_back(path_);
    lines_.lengths.push_back(length_);
  }

  const Paths& paths_;
  Vector3 origin_; ///< still to be subtracted
  PathLines lines_;
  std::int64_t path_ = 0;
  double length_ = 0;
  std::size_t frame_ = 0; ///< whose images these are
  std::optional<BoxImages> images_;
};
}

PathLines draw_paths(const Paths& paths, const Vector3& origin)
{
  return Drawer(paths, origin).run();
}

std::vector<double> find_speeds(const Paths& paths, std::span<const double> times)
{
  std::vector<double> speeds(paths.frames.size());
  visit_stretches(paths,
    [&](std::int64_t, std::int64_t first, std::int64_t end)
    {
      for (std::int64_t place = first; place < end; ++place)
      {
        const std::int64_t from = std::max(place - 1, first);
        const std::int64_t to = std::min(place + 1, end - 1);
        const auto time_of = [&](std::int64_t at)
        { return times[static_cast<std::size_t>(paths.frames[static_cast<std::size_t>(at)])]; };
        const double time = time_of(to) - time_of(from);
        speeds[static_cast<std::size_t>(place)] =
          time > 0 ? length_of(paths, from, to + 1) / time : 0;
      }
    });
  return speeds;
}
}
