// SPDX-License-Identifier: BSD-3-Clause
// Particles that walk through periodic boxes on a grid of integers, on which everything is exact.
#ifndef granular_tests_paths_walks_h
#define granular_tests_paths_walks_h

#include "granular/paths/paths.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace walks
{
using Place = std::array<std::int64_t, 3>;

/// Steps of the grid in a unit of length.
constexpr std::int64_t grid = std::int64_t{ 1 } << 20;

inline Place sum(const Place& a, std::int64_t times, const Place& b)
{
  return { a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2] };
}

inline double length_of(std::int64_t steps)
{
  return static_cast<double>(steps) / static_cast<double>(grid);
}

inline granular::Vector3 lengths_of(const Place& place)
{
  return { length_of(place[0]), length_of(place[1]), length_of(place[2]) };
}

/// A corner and the vectors a = (ax, 0, 0), b = (xy, by, 0), c = (xz, yz, cz).
struct GridBox
{
  Place origin = {};
  std::array<Place, 3> vectors = { Place{ grid, 0, 0 }, Place{ 0, grid, 0 }, Place{ 0, 0, grid } };
  std::string boundary = "pp pp pp";
  std::optional<std::array<Place, 3>>
    unflipped = {}; ///< as the vectors of the frame before have become

  const std::array<Place, 3>& grown() const { return unflipped ? *unflipped : vectors; }

  granular::Box box() const
  {
    granular::Box box = granular::Box::from_edges(lengths_of(origin),
      { lengths_of(vectors[0]), lengths_of(vectors[1]), lengths_of(vectors[2]) });
    box.boundary = boundary;
    return box;
  }

  bool is_periodic(std::size_t axis) const { return boundary[3 * axis] == 'p'; }
};

__extension__ using Wide = __int128;

/// Divides, rounding down.
inline std::int64_t quotient(Wide number, Wide by)
{
  return static_cast<std::int64_t>(
    number / by - (number % by != 0 && (number < 0) != (by < 0) ? 1 : 0));
}

struct Wrapped
{
  Place place = {};
  Place images = {};
};

/// How many of each vector are in a sum of them.
inline Place counts_in(const GridBox& box, Place sum_of_vectors)
{
  Place counts = {};
  for (const std::size_t axis : { 2U, 1U, 0U })
  {
    counts[axis] = quotient(sum_of_vectors[axis], box.vectors[axis][axis]);
    sum_of_vectors = sum(sum_of_vectors, -counts[axis], box.vectors[axis]);
  }
  return counts;
}

/// The place in the box, and how many vectors were taken away.
inline Wrapped wrap(const GridBox& box, const Place& place)
{
  const auto& [a, b, c] = box.vectors;
  Wrapped wrapped{ place, {} };
  const auto rest = [&](std::size_t k)
  { return static_cast<Wide>(wrapped.place[k] - box.origin[k]); };
  const auto take = [&](std::size_t axis, Wide number, Wide by)
  {
    const std::int64_t images = box.is_periodic(axis) ? quotient(number, by) : 0;
    wrapped.images[axis] = images;
    wrapped.place = sum(wrapped.place, -images, box.vectors[axis]);
  };
  // parts of the vectors, all times their extents
  take(2, rest(2), c[2]);
  take(1, rest(1) * c[2] - rest(2) * c[1], Wide{ b[1] } * c[2]);
  const Wide part = rest(1) * c[2] - rest(2) * c[1];
  take(0, rest(0) * b[1] * c[2] - part * b[0] - rest(2) * c[0] * b[1], Wide{ a[0] } * b[1] * c[2]);
  return wrapped;
}

/// The place that was at another one when the box was another: all move as the periodic box does, in fractions of it.
inline Place carried(const GridBox& from, const GridBox& to, const Place& place)
{
  std::array<double, 3> parts = {};
  Place rest = sum(place, -1, from.origin);
  for (const std::size_t axis : { 2U, 1U, 0U })
  {
    parts[axis] = static_cast<double>(rest[axis]) / static_cast<double>(from.vectors[axis][axis]);
    for (std::size_t k = 0; k < axis; ++k)
    {
      rest[k] -= std::llround(parts[axis] * static_cast<double>(from.vectors[axis][k]));
    }
  }
  Place moved = to.origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      moved[k] += std::llround(parts[axis] * static_cast<double>(to.grown()[axis][k]));
    }
  }
  return moved;
}

/// All that is known of a run: the box of each frame, and where particles really are.
struct Run
{
  std::vector<GridBox> boxes;
  std::vector<std::map<std::int64_t, Place>> frames; ///< by id
};

/// What frames show of a run.
struct Shown
{
  bool images = true;
  bool rows = true;
  std::uint64_t seed = 1; ///< of the order of rows
  bool arrays = true;     ///< v, three doubles, and step, an integer
};

inline double velocity(std::int64_t id, std::size_t frame, int k)
{
  return static_cast<double>(id % 1024) * 0.1 + static_cast<double>(frame) / 7 + k;
}

/// What would be read of one frame.
inline granular::PathFrame frame_of(const Run& run, std::size_t f, const Shown& shown)
{
  std::vector<std::int64_t> order;
  for (const auto& [id, place] : run.frames[f])
  {
    order.push_back(id);
  }
  std::mt19937_64 random(shown.seed + f);
  std::ranges::shuffle(order, random);
  granular::PathFrame frame;
  frame.loaded = true;
  frame.header.timestep = 100 * static_cast<std::int64_t>(f);
  frame.header.rows = std::ssize(order);
  frame.header.box = run.boxes[f].box();
  frame.has_rows = shown.rows && !order.empty();
  frame.has_images = shown.images && !order.empty();
  if (shown.arrays)
  {
    frame.arrays = { { "v", 3, false, {} }, { "step", 1, true, {} } };
  }
  for (std::size_t row = 0; row < order.size(); ++row)
  {
    const Wrapped wrapped = wrap(run.boxes[f], run.frames[f].at(order[row]));
    frame.ids.push_back(order[row]);
    for (std::size_t k = 0; k < 3; ++k)
    {
      frame.points.push_back(length_of(wrapped.place[k]));
    }
    if (frame.has_images)
    {
      frame.images.insert(frame.images.end(), wrapped.images.begin(), wrapped.images.end());
    }
    if (frame.has_rows)
    {
      frame.rows.push_back(static_cast<std::int64_t>(row));
    }
    for (int k = 0; shown.arrays && k < 3; ++k)
    {
      frame.arrays[0].words.push_back(std::bit_cast<std::int64_t>(velocity(order[row], f, k)));
    }
    if (shown.arrays)
    {
      frame.arrays[1].words.push_back(order[row] ^ static_cast<std::int64_t>(f));
    }
  }
  return frame;
}

inline std::vector<granular::PathFrame> frames_of(const Run& run, const Shown& shown)
{
  std::vector<granular::PathFrame> frames;
  for (std::size_t f = 0; f < run.frames.size(); ++f)
  {
    frames.push_back(frame_of(run, f, shown));
  }
  return frames;
}

/// Box vectors that bring a particle in a frame, as shown, next to its place before.
inline Place crossing_of(const Run& run, std::int64_t id, std::size_t before, std::size_t f)
{
  const Place from = wrap(run.boxes[before], run.frames[before].at(id)).images;
  const Place to = wrap(run.boxes[f], run.frames[f].at(id)).images;
  Place vectors = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    vectors = sum(vectors, to[axis], run.boxes[f].vectors[axis]);
    vectors = sum(vectors, -from[axis], run.boxes[f].grown()[axis]);
  }
  return counts_in(run.boxes[f], vectors);
}

/// The paths of a run, in integers: they begin where the particles are shown first.
inline granular::Paths paths_of(const Run& run, const Place& origin, bool crossings)
{
  granular::Paths paths;
  std::map<std::int64_t, std::vector<std::size_t>> known;
  for (std::size_t f = 0; f < run.frames.size(); ++f)
  {
    for (const auto& [id, place] : run.frames[f])
    {
      known[id].push_back(f);
    }
  }
  paths.begins.push_back(0);
  paths.arrays = { { "v", 3, false, {} }, { "step", 1, true, {} } };
  for (const auto& [id, frames] : known)
  {
    paths.ids.push_back(id);
    const Place start = run.frames[frames[0]].at(id);
    const Wrapped first = wrap(run.boxes[frames[0]], start);
    const Place less = sum(sum(start, -1, first.place), 1, origin);
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      const std::size_t f = frames[i];
      const Place place = run.frames[f].at(id);
      const Wrapped wrapped = wrap(run.boxes[f], place);
      paths.frames.push_back(static_cast<std::int32_t>(f));
      for (std::size_t k = 0; k < 3; ++k)
      {
        paths.points.push_back(length_of(place[k] - less[k]));
        if (crossings)
        {
          paths.shown.push_back(length_of(wrapped.place[k]));
        }
      }
      if (crossings)
      {
        const Place crossed = i > 0 ? crossing_of(run, id, frames[i - 1], f) : Place{};
        paths.crossings.insert(paths.crossings.end(), crossed.begin(), crossed.end());
      }
      for (int k = 0; k < 3; ++k)
      {
        paths.arrays[0].words.push_back(std::bit_cast<std::int64_t>(velocity(id, f, k)));
      }
      paths.arrays[1].words.push_back(id ^ static_cast<std::int64_t>(f));
    }
    paths.begins.push_back(paths.places());
  }
  return paths;
}

/// A number from -most to most.
inline std::int64_t any_of(std::mt19937_64& random, std::int64_t most)
{
  return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * most + 1)) - most;
}

inline Place any_step(std::mt19937_64& random, std::int64_t most)
{
  return { any_of(random, most), any_of(random, most), any_of(random, most) };
}

/// How particles walk.
struct Walk
{
  std::int64_t particles = 40;
  std::size_t frames = 30;
  std::int64_t longest = grid / 8; ///< step along each axis
  std::int64_t images = 0;         ///< of the first places, at most
  int absent = 0;                  ///< percent of the places that frames do not have
};

/// A run in boxes, of which the last goes on.
inline Run make_run(const std::vector<GridBox>& boxes, const Walk& walk, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  Run run;
  for (std::size_t f = 0; f < walk.frames; ++f)
  {
    run.boxes.push_back(boxes[std::min(f, boxes.size() - 1)]);
  }
  run.frames.resize(walk.frames);
  for (std::int64_t i = 0; i < walk.particles; ++i)
  {
    const std::int64_t id = 1 + 3 * i - (i % 7 == 0 ? 1'000'000'000'000 : 0);
    Place place = wrap(boxes[0], any_step(random, 100 * grid)).place;
    for (const Place& vector : boxes[0].vectors)
    {
      place = sum(place, walk.images > 0 ? any_of(random, walk.images) : 0, vector);
    }
    for (std::size_t f = 0; f < walk.frames; ++f)
    {
      if (f > 0)
      {
        place = carried(run.boxes[f - 1], run.boxes[f], place);
        place = sum(place, 1, any_step(random, walk.longest));
      }
      if (static_cast<int>(random() % 100) >= walk.absent)
      {
        run.frames[f][id] = place;
      }
    }
  }
  return run;
}

/// An orthogonal box, one with small tilts, and one that leans over several of its widths.
inline GridBox straight_box()
{
  return { { -grid / 3, grid / 5, 0 },
    { Place{ grid, 0, 0 }, Place{ 0, grid * 3 / 4, 0 }, Place{ 0, 0, 2 * grid } } };
}

inline GridBox tilted_box()
{
  return { { 0, -grid, grid / 7 },
    { Place{ grid, 0, 0 }, Place{ grid / 3, grid, 0 }, Place{ -grid / 4, grid / 5, grid } } };
}

inline GridBox leaning_box()
{
  return { { grid / 9, 0, 0 },
    { Place{ grid, 0, 0 }, Place{ 17 * grid / 5, grid, 0 },
      Place{ -36 * grid / 7, 11 * grid / 3, grid } } };
}

/// Boxes that are sheared and flipped as fix deform does: where a tilt exceeds half of its period, and grow.
inline std::vector<GridBox> deformed_boxes(std::size_t frames)
{
  std::vector<GridBox> boxes;
  GridBox box = tilted_box();
  for (std::size_t f = 0; f < frames; ++f)
  {
    boxes.push_back(box);
    auto& [a, b, c] = box.vectors;
    a[0] += grid / 64;
    b[1] -= grid / 128;
    b[0] += grid / 9;
    c[0] += grid / 11;
    c[1] -= grid / 13;
    c[2] += grid / 100;
    box.origin = sum(box.origin, 1, { -grid / 50, grid / 70, 0 });
    box.unflipped = box.vectors;
    if (std::abs(c[1]) > b[1] / 2)
    {
      c = sum(c, c[1] > 0 ? -1 : 1, b);
    }
    if (std::abs(c[0]) > a[0] / 2)
    {
      c = sum(c, c[0] > 0 ? -1 : 1, a);
    }
    if (std::abs(b[0]) > a[0] / 2)
    {
      b = sum(b, b[0] > 0 ? -1 : 1, a);
    }
  }
  return boxes;
}
}
#endif
