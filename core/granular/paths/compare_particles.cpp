// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/compare_particles.h"

#include "granular/common/error.h"
#include "granular/local/fetch_particles.h"
#include "granular/local/id_directory.h"
#include "granular/local/id_finder.h"
#include "granular/parallel/executor.h"
#include "granular/particles/point_forms.h"
#include "granular/paths/unwrap.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t some = 1024; // rows at once, which stay in the cache
constexpr std::size_t rows_per_chunk = 32 * some;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

using Numbers = std::vector<std::int64_t>;

std::vector<std::string> distinct_names(const std::vector<std::string>& names)
{
  std::vector<std::string> distinct;
  for (const std::string& name : names)
  {
    if (std::ranges::find(distinct, name) == distinct.end())
    {
      distinct.push_back(name);
    }
  }
  return distinct;
}

/// Points without the origin, which displacements add where it matters; of scaled points it is added first.
FrameView as_shown(const FrameView& frame)
{
  FrameView shown = frame;
  shown.point_origin = frame.coordinates == Coordinates::Scaled ? frame.point_origin : Vector3{};
  return shown;
}

/// The values of one frame that are compared.
struct Side
{
  ParticleValues values; ///< the wanted arrays, then the counts of images if these are used
  bool has_images = false;
};

const char* const image_array = "image";

/// Returns true if rows of a rank can be unwrapped; of a rank without rows nothing is known.
bool cannot_unwrap(const FrameView& frame)
{
  const ArrayView* const images = frame.find(image_array);
  const bool has_images =
    frame.has_box && images && images->size() == 3 && is_integer(images->type);
  return frame.rows > 0 && frame.coordinates != Coordinates::Unwrapped && !has_images;
}

Side load_side(const FrameView& frame, std::vector<std::string> names, bool unwrap,
  const Executor& executor, Progress& progress)
{
  Side side;
  side.has_images = unwrap && frame.coordinates != Coordinates::Unwrapped;
  if (side.has_images)
  {
    names.emplace_back(image_array);
  }
  side.values = view_particles(as_shown(frame), names, executor, progress);
  return side;
}

/// Checks that wanted arrays have the same size in both frames, and gives a frame without rows the sizes of the other one.
void match_sizes(ParticleValues& current, ParticleValues& reference, std::size_t wanted,
  const std::array<std::int64_t, 2>& rows)
{
  for (std::size_t i = 0; i < wanted; ++i)
  {
    ArrayView& now = current.arrays[i];
    ArrayView& before = reference.arrays[i];
    if (rows[0] > 0 && rows[1] > 0 && now.size() != before.size())
    {
      throw Error("expected as many numbers a particle in array '" + now.name +
        "' of both frames, got " + std::to_string(now.size()) + " and " +
        std::to_string(before.size()) + " in the reference frame");
    }
    (rows[0] > 0 ? before : now).components.resize((rows[0] > 0 ? now : before).components.size());
  }
}

/// A point, and how often it has crossed the box along each of its vectors.
struct CountedPoint
{
  Vector3 point = {};
  Vector3 images = {};
};

Vector3 origin_of(const FrameView& frame)
{
  return frame.coordinates == Coordinates::Scaled ? Vector3{} : frame.point_origin;
}

/// Finds displacements of particles from a reference frame to the current frame.
class Displacements
{
public:
  /// The boxes, and the origins that were subtracted from points that are not scaled, are those of the frames. unwrapped:
  /// points and their images give the unwrapped positions; otherwise displacements are the shortest periodic images. See
  /// compare_particles.
  Displacements(const FrameView& current, const FrameView& reference, bool unwrapped)
  {
    if (origin_of(current) != origin_of(reference))
    {
      origins_ = { origin_of(current), origin_of(reference) };
    }
    vectors_ = { current.header.box.vectors, reference.header.box.vectors };
    if (!unwrapped)
    {
      shortest_.emplace(current.has_box ? current.header.box
          : reference.has_box           ? reference.header.box
                                        : Box{});
      vectors_[0] = shortest_->box.vectors; // of which the shortest image takes some
    }
  }

  /// Returns the displacement, rounded once.
  Vector3 find(const CountedPoint& current, const CountedPoint& reference) const noexcept
  {
    const Vector3 displacement = this->subtract(current, reference);
    const BoxCounts counts = shortest_ ? shortest_->images.find(displacement) : BoxCounts{};
    if (counts == BoxCounts{})
    {
      return displacement;
    }
    CountedPoint shortest = current;
    std::ranges::transform(counts, shortest.images.begin(),
      [](std::int64_t count) { return static_cast<double>(count); });
    return this->subtract(shortest, reference);
  }

  /// Returns true if a shortest image is far: the particle may have moved by another image.
  bool is_far(const Vector3& displacement) const noexcept
  {
    return shortest_ && shortest_->is_far(displacement);
  }

private:
  Vector3 subtract(const CountedPoint& current, const CountedPoint& reference) const noexcept
  {
    Vector3 result;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      CompensatedSum sum;
      sum.add(current.point[axis]);
      sum.add(-reference.point[axis]);
      sum.add(origins_[0][axis]);
      sum.add(-origins_[1][axis]);
      for (std::size_t i = 0; i < 3; ++i)
      {
        if (current.images[i] != 0) // a box without bounds there has no images, and no number
        {
          sum.add_product(current.images[i], vectors_[0][i][axis]);
        }
        if (reference.images[i] != 0)
        {
          sum.add_product(-reference.images[i], vectors_[1][i][axis]);
        }
      }
      result[axis] = sum.value();
    }
    return result;
  }

  std::array<Vector3, 2> origins_ = {}; ///< added to the current points, and to those before
  std::array<std::array<Twofold3, 3>, 2> vectors_ = {}; ///< of the boxes
  std::optional<BoxImages>
    shortest_; ///< in which box the shortest is taken; of unwrapped points none
};

/// The places of some particles in both frames.
struct Pairs
{
  std::array<std::int64_t, some> current;   ///< rows
  std::array<std::int64_t, some> reference; ///< places among the values of the reference frame
  std::size_t count = 0;

  std::span<const std::int64_t> now() const { return { current.data(), count }; }
  std::span<const std::int64_t> before() const { return { reference.data(), count }; }
};

/// Compares the rows of a rank, chunk by chunk.
struct Comparer
{
  /// places: of the rows from first on, in the reference frame, or IdFinder::nowhere. Returns how many particles are far.
  std::int64_t compare(
    std::span<const std::int64_t> places, std::size_t first, const unsigned char* ghosts) const
  {
    Pairs pairs;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const bool found = places[i] != IdFinder::nowhere;
      result.changes[first + i] = found ? Change::Kept : Change::New;
      if (found)
      {
        pairs.current[pairs.count] = static_cast<std::int64_t>(first + i);
        pairs.reference[pairs.count++] = places[i];
      }
      else
      {
        this->leave_empty(first + i);
      }
    }
    for (std::size_t k = 0; k < result.differences.size(); ++k)
    {
      this->subtract(k, pairs);
    }
    return this->displace(pairs, ghosts);
  }

  static double* numbers(const Block& block) { return static_cast<double*>(block.data()); }

  void leave_empty(std::size_t row) const
  {
    std::fill_n(numbers(result.displacements) + 3 * row, 3, none);
    for (const DifferenceArray& array : result.differences)
    {
      const auto size = static_cast<std::size_t>(array.size);
      std::fill_n(numbers(array.values) + size * row, size, none);
    }
  }

  void subtract(std::size_t which, const Pairs& pairs) const
  {
    std::array<double, some> now;
    std::array<double, some> before;
    const DifferenceArray& array = result.differences[which];
    for (int k = 0; k < array.size; ++k)
    {
      load_numbers(component_of(current.values.arrays[which], k), pairs.now(), now.data());
      load_numbers(component_of(reference.values.arrays[which], k), pairs.before(), before.data());
      for (std::size_t i = 0; i < pairs.count; ++i)
      {
        numbers(array.values)[pairs.current[i] * array.size + k] = now[i] - before[i];
      }
    }
  }

  /// The counts of images of some particles, 0 where there are none.
  static std::array<std::array<double, some>, 3> load_images(
    const Side& side, std::span<const std::int64_t> rows)
  {
    std::array<std::array<double, some>, 3> images = {};
    // a rank without particles may lack the array's components
    const bool there = side.has_images && side.values.arrays.back().size() == 3;
    for (int axis = 0; there && axis < 3; ++axis)
    {
      load_numbers(component_of(side.values.arrays.back(), axis), rows,
        images[static_cast<std::size_t>(axis)].data());
    }
    return images;
  }

  static Vector3 point_of(const Side& side, std::int64_t row)
  {
    const double* const point = side.values.points + row * side.values.point_step;
    return { point[0], point[1], point[2] };
  }

  std::int64_t displace(const Pairs& pairs, const unsigned char* ghosts) const
  {
    const auto now = load_images(current, pairs.now());
    const auto before = load_images(reference, pairs.before());
    std::int64_t far = 0;
    for (std::size_t i = 0; i < pairs.count; ++i)
    {
      const std::int64_t row = pairs.current[i];
      const Vector3 displacement = displacements.find(
        { point_of(current, row), { now[0][i], now[1][i], now[2][i] } },
        { point_of(reference, pairs.reference[i]), { before[0][i], before[1][i], before[2][i] } });
      std::ranges::copy(displacement, numbers(result.displacements) + 3 * row);
      far += displacements.is_far(displacement) && !FrameView::is_duplicate(ghosts, row) ? 1 : 0;
    }
    return far;
  }

  const Side& current;
  const Side& reference;
  const Displacements& displacements;
  ComparedParticles& result;
};

void make_arrays(
  const Side& current, std::size_t wanted, std::int64_t rows, ComparedParticles& result)
{
  const auto count = static_cast<std::size_t>(rows);
  result.changes.resize(count);
  result.displacements = Block(count * 3 * sizeof(double));
  for (std::size_t i = 0; i < wanted; ++i)
  {
    const ArrayView& array = current.values.arrays[i];
    const auto size = static_cast<std::size_t>(array.size());
    result.differences.push_back(
      { array.name + "_difference", array.size(), Block(count * size * sizeof(double)) });
  }
}

/// The rows of this rank's reference particles that no rank has now.
Numbers find_lost(std::span<const std::int64_t> ids, const FrameView& reference,
  const IdDirectory& current, Communicator& ranks)
{
  const std::vector<ParticleHome> homes = current.find(ids, ranks);
  Numbers lost;
  for (std::size_t i = 0; i < homes.size(); ++i)
  {
    const auto row = static_cast<std::int64_t>(i);
    if (homes[i].rank < 0 && !reference.is_duplicate(row))
    {
      lost.push_back(row);
    }
  }
  return lost;
}
}

ComparedParticles compare_particles(const FrameView& current, const FrameView& reference,
  const ParticleCompareRequest& request, Communicator& ranks, Progress& progress)
{
  SharedProgress shared(progress, ranks);
  PartialProgress parts(shared);
  return do_together(ranks,
    [&]
    {
      const Executor executor(request.threads);
      parts.set_part(0, 0.1);
      const Ids ids = load_ids(current, "particles", executor, parts);
      const Ids old_ids = load_ids(reference, "particles of the reference frame", executor, parts);
      const IdDirectory directory(ids.values(), current.ghosts, ranks);
      directory.expect_distinct("particles", ranks);
      const IdDirectory old_directory(old_ids.values(), reference.ghosts, ranks);
      old_directory.expect_distinct("particles of the reference frame", ranks);

      std::array<std::int64_t, 4> sums = { current.rows, reference.rows,
        cannot_unwrap(current) ? 1 : 0, cannot_unwrap(reference) ? 1 : 0 };
      ranks.sum(sums);
      ComparedParticles result;
      result.unwrapped = sums[2] == 0 && sums[3] == 0;
      const std::vector<std::string> names = distinct_names(request.differences);
      parts.set_part(0.1, 0.4);
      Side now = load_side(current, names, result.unwrapped, executor, parts);
      Side before = load_side(reference, names, result.unwrapped, executor, parts);
      share_sizes(now.values, current.rows, ranks);
      share_sizes(before.values, reference.rows, ranks);
      match_sizes(now.values, before.values, names.size(), { sums[0], sums[1] });
      result.lost = find_lost(old_ids.values(), reference, directory, ranks);

      const Numbers wanted(ids.values().begin(), ids.values().end());
      FetchedParticles fetched = fetch_particles(before.values, old_directory, wanted, ranks);
      before.values = std::move(fetched.values);
      const IdFinder finder(fetched.ids);
      make_arrays(now, names.size(), current.rows, result);
      const Displacements displacements(current, reference, result.unwrapped);
      const Comparer comparer = { now, before, displacements, result };
      std::atomic<std::int64_t> far = 0;
      parts.set_part(0.4, 1);
      executor.for_each_stretch(
        wanted.size(), rows_per_chunk,
        [&](std::size_t first, std::size_t rows, std::size_t)
        {
          std::array<std::int64_t, some> places;
          for (std::size_t row = first; row < first + rows; row += some)
          {
            const std::size_t count = std::min(some, first + rows - row);
            finder.find(ids.values().subspan(row, count), places.data());
            far += comparer.compare({ places.data(), count }, row, current.ghosts);
          }
        },
        parts);
      result.far = far;
      ranks.sum({ &result.far, 1 });
      return result;
    });
}
}
