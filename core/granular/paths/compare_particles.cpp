// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/compare_particles.h"

#include "granular/common/error.h"
#include "granular/lines/fetch_particles.h"
#include "granular/lines/id_finder.h"
#include "granular/parallel/executor.h"
#include "granular/particles/point_forms.h"
#include "granular/paths/unwrap.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <numeric>
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

/// Compares the rows of a rank with the particles of the reference frame, whose values were fetched: they are doubles.
class Comparer
{
public:
  /// The boxes, and the origins that were subtracted from points that are not scaled, are those of the frames. If
  /// result.unwrapped, points and their images give the unwrapped positions; otherwise displacements are the shortest periodic
  /// images. See compare_particles.
  Comparer(const FrameView& current, const FrameView& reference, const Side& now,
    const Side& before, ComparedParticles& result)
    : now_(now)
    , before_(before)
    , ghosts_(current.ghosts)
    , result_(result)
    , vectors_{ current.header.box.vectors, reference.header.box.vectors }
  {
    if (origin_of(current) != origin_of(reference))
    {
      origins_ = { origin_of(current), origin_of(reference) };
    }
    if (!result.unwrapped)
    {
      shortest_.emplace(current.has_box ? current.header.box
          : reference.has_box           ? reference.header.box
                                        : Box{});
      vectors_[0] = shortest_->box.vectors; // of which the shortest image takes some
    }
  }

  /// places: of the rows from first on, in the reference frame, or IdFinder::nowhere. Returns how many particles are far.
  std::int64_t compare(std::span<const std::int64_t> places, std::size_t first) const
  {
    std::array<std::int64_t, some> all;
    const std::span rows(all.data(), places.size());
    std::iota(rows.begin(), rows.end(), static_cast<std::int64_t>(first));
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      result_.changes[first + i] = places[i] == IdFinder::nowhere ? Change::New : Change::Kept;
    }
    for (std::size_t which = 0; which < result_.differences.size(); ++which)
    {
      this->subtract(which, rows, places);
    }
    return this->displace(rows, places);
  }

private:
  using Places = std::span<const std::int64_t>;

  static double value_of(const ArrayView& array, int component, std::int64_t place) noexcept
  {
    const void* const values = array.components[static_cast<std::size_t>(component)];
    return static_cast<const double*>(values)[place * array.step];
  }

  void subtract(std::size_t which, Places rows, Places places) const
  {
    std::array<double, some> now;
    const DifferenceArray& array = result_.differences[which];
    auto* const differences = static_cast<double*>(array.values.data());
    for (int k = 0; k < array.size; ++k)
    {
      load_numbers(component_of(now_.values.arrays[which], k), rows, now.data());
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        differences[rows[i] * array.size + k] = places[i] == IdFinder::nowhere
          ? none
          : now[i] - value_of(before_.values.arrays[which], k, places[i]);
      }
    }
  }

  static CountedPoint point_of(const Side& side, std::int64_t place) noexcept
  {
    CountedPoint counted;
    std::copy_n(side.values.points + place * side.values.point_step, 3, counted.point.begin());
    return counted;
  }

  std::int64_t displace(Places rows, Places places) const
  {
    std::array<std::array<double, some>, 3> images = {};
    for (std::size_t axis = 0; now_.has_images && axis < 3; ++axis)
    {
      load_numbers(
        component_of(now_.values.arrays.back(), static_cast<int>(axis)), rows, images[axis].data());
    }
    std::int64_t far = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      Vector3 displacement = { none, none, none };
      if (places[i] != IdFinder::nowhere)
      {
        CountedPoint now = point_of(now_, rows[i]);
        now.images = { images[0][i], images[1][i], images[2][i] };
        CountedPoint before = point_of(before_, places[i]);
        for (int axis = 0; before_.has_images && axis < 3; ++axis)
        {
          before.images[static_cast<std::size_t>(axis)] =
            value_of(before_.values.arrays.back(), axis, places[i]);
        }
        displacement = this->find(now, before);
        const bool is_far = shortest_ && shortest_->is_far(displacement);
        far += is_far && !FrameView::is_duplicate(ghosts_, rows[i]) ? 1 : 0;
      }
      std::ranges::copy(
        displacement, static_cast<double*>(result_.displacements.data()) + 3 * rows[i]);
    }
    return far;
  }

  /// Returns the displacement, rounded once.
  Vector3 find(CountedPoint current, const CountedPoint& reference) const noexcept
  {
    const Vector3 displacement = this->subtract(current, reference);
    const BoxCounts counts = shortest_ ? shortest_->images.find(displacement) : BoxCounts{};
    if (counts == BoxCounts{})
    {
      return displacement;
    }
    std::ranges::copy(counts, current.images.begin());
    return this->subtract(current, reference);
  }

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

  const Side& now_;
  const Side& before_;
  const unsigned char* ghosts_; ///< of the current rows
  ComparedParticles& result_;
  std::array<Vector3, 2> origins_ = {}; ///< added to the current points, and to those before
  std::array<std::array<Twofold3, 3>, 2> vectors_; ///< of the boxes
  std::optional<BoxImages>
    shortest_; ///< in which box the shortest is taken; of unwrapped points none
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
      const Comparer comparer(current, reference, now, before, result);
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
            far += comparer.compare({ places.data(), count }, row);
          }
        },
        parts);
      result.far = far;
      ranks.sum({ &result.far, 1 });
      return result;
    });
}
}
