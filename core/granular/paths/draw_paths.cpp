// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/box.h"
#include "granular/local/minimum_image.h"
#include "granular/local/split_line.h"
#include "granular/paths/paths.h"

#include <algorithm>
#include <array>
#include <cmath>
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

class Drawer
{
public:
  Drawer(const Paths& paths, const Vector3& origin)
    : paths_(paths)
    , origin_(origin)
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
        paths_.crossings.empty() ? this->draw_whole(first, end) : this->draw_split(first, end);
      });
    return std::move(lines_);
  }

private:
  void draw_whole(std::int64_t first, std::int64_t end)
  {
    for (std::int64_t place = first; place < end; ++place)
    {
      const double* const point = paths_.points.data() + 3 * place;
      this->add_point({ point[0], point[1], point[2] }, place, 0);
    }
    this->end_line();
  }

  void draw_split(std::int64_t first, std::int64_t end)
  {
    this->add_point(this->shown(first, origin_), first, 0);
    for (std::int64_t place = first + 1; place < end; ++place)
    {
      const std::int64_t* const counts = paths_.crossings.data() + 3 * place;
      if (counts[0] != 0 || counts[1] != 0 || counts[2] != 0)
      {
        this->cut(place, { counts[0], counts[1], counts[2] });
      }
      this->add_point(this->shown(place, origin_), place, 0);
    }
    this->end_line();
  }

  /// Ends the line at a face before a place, and begins the next one at another face.
  void cut(std::int64_t place, const BoxCounts& counts)
  {
    const auto frame = static_cast<std::size_t>(paths_.frames[static_cast<std::size_t>(place)]);
    if (!images_ || frame_ != frame)
    {
      images_.emplace(paths_.headers[frame].box);
      frame_ = frame;
    }
    const LineSplitter splitter(paths_.headers[frame].box, *images_, origin_);
    std::array<LinePart, LineSplitter::most_parts> parts;
    const std::size_t count =
      splitter.split(this->shown(place - 1, {}), this->shown(place, {}), counts, parts);
    double whole = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      whole += distance(parts[i].begin.data(), parts[i].end.data());
    }
    double way = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      // from a place in a face the only part may begin at the opposite face
      if (i > 0 || parts[i].begin != this->shown(place - 1, origin_))
      {
        this->end_line();
        this->add_point(parts[i].begin, place - 1, way);
      }
      way += whole > 0 ? distance(parts[i].begin.data(), parts[i].end.data()) / whole : 0;
      way = std::min(way, 1.0);
      if (i + 1 < count)
      {
        this->add_point(parts[i].end, place - 1, way);
      }
      else if (parts[i].end !=
        this->shown(place, origin_)) // the next place is in the opposite face
      {
        this->add_point(parts[i].end, place - 1, 1);
        this->end_line();
      }
    }
  }

  Vector3 shown(std::int64_t place, const Vector3& less) const
  {
    const double* const point = paths_.shown.data() + 3 * place;
    return { point[0] - less[0], point[1] - less[1], point[2] - less[2] };
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
  Vector3 origin_;
  PathLines lines_;
  std::int64_t path_ = 0;
  double length_ = 0;
  std::size_t frame_ = 0; ///< that images_ are of
  std::optional<MinimumImage> images_;
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
