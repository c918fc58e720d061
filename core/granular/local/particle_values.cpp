// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/particle_values.h"

#include "granular/common/error.h"
#include "granular/parallel/gather.h"
#include "granular/particles/absolute_positions.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

namespace granular
{
namespace
{
constexpr std::size_t rows_per_chunk = 64 * AbsolutePositions::most_rows;

/// Returns particles by the places where they are shown: in how many periods they have been does not.
FrameView as_shown(const FrameView& frame)
{
  FrameView shown = frame;
  shown.coordinates =
    frame.coordinates == Coordinates::Unwrapped ? Coordinates::Absolute : frame.coordinates;
  return shown;
}

/// Doubles x y z of each row, one after the other, as they are wanted.
bool is_plain(const FrameView& frame) noexcept
{
  return frame.coordinates != Coordinates::Scaled && frame.point_origin == Vector3{} &&
    frame.points->are_triples();
}

void compute_points(
  const FrameView& frame, ParticleValues& particles, const Executor& executor, Progress& progress)
{
  const AbsolutePositions positions(frame, false);
  const auto rows = static_cast<std::size_t>(frame.rows);
  particles.own.resize(3 * rows);
  double* const points = particles.own.data();
  executor.for_each_stretch(
    rows, rows_per_chunk,
    [&](std::size_t first, std::size_t count, std::size_t)
    { positions.store(static_cast<std::int64_t>(first), count, points + 3 * first); },
    progress);
  particles.points = points;
  particles.point_step = 3;
}

ArrayView view_array(const FrameView& frame, const std::string& name)
{
  const ArrayView* const array = frame.find(name);
  if (!array && frame.rows > 0)
  {
    throw Error("expected an array '" + name + "' of the particles, got none");
  }
  if (array && array->type == ValueType::Text)
  {
    throw Error("expected numbers in array '" + name + "' of the particles, got texts");
  }
  return array ? *array : ArrayView{ name };
}

/// 1 if a rank has rows, else 0; then the sizes of its arrays.
using ArraySizes = std::vector<int>;

/// Returns the size that the ranks with rows have, which must agree; if none has any, that of the first that knows it.
int size_among(const std::vector<ArraySizes>& all, std::size_t place, const std::string& name)
{
  int size = 0;
  bool counted = false; // on a rank with rows
  for (const ArraySizes& sizes : all)
  {
    const int here = sizes[place];
    const bool counts = sizes[0] != 0;
    if (counts && counted && here != size)
    {
      throw Error("expected as many numbers a particle in array '" + name +
        "' on all processes, got " + std::to_string(size) + " and " + std::to_string(here));
    }
    if (counts ? !counted : size == 0)
    {
      size = here;
    }
    counted = counted || counts;
  }
  return std::max(size, 1);
}
}

ParticleValues view_particles(const FrameView& frame, std::span<const std::string> names,
  const Executor& executor, Progress& progress)
{
  ParticleValues particles;
  for (const std::string& name : names)
  {
    particles.arrays.push_back(view_array(frame, name));
  }
  if (frame.rows == 0)
  {
    return particles;
  }
  if (!frame.points)
  {
    throw Error("expected points of the particles, got none");
  }
  const FrameView shown = as_shown(frame);
  if (is_plain(shown))
  {
    particles.points = static_cast<const double*>(shown.points->components[0]);
    particles.point_step = shown.points->step;
  }
  else
  {
    compute_points(shown, particles, executor, progress);
  }
  return particles;
}

void share_sizes(ParticleValues& particles, std::int64_t rows, Communicator& ranks)
{
  ArraySizes own = { rows > 0 ? 1 : 0 };
  std::ranges::transform(particles.arrays, std::back_inserter(own), &ArrayView::size);
  const std::vector<ArraySizes> all = gather(ranks, own);
  for (std::size_t i = 0; i < particles.arrays.size(); ++i)
  {
    ArrayView& array = particles.arrays[i];
    array.components.resize(static_cast<std::size_t>(size_among(all, i + 1, array.name)));
  }
}
}
