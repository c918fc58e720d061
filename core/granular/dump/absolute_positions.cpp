// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/absolute_positions.h"

#include "granular/base/error.h"
#include "granular/dump/point_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace granular
{
namespace
{
/// x y z of each row, without anything between.
bool is_plain(const ArrayView& points) noexcept
{
  const auto* first = static_cast<const double*>(points.components[0]);
  return points.type == ScalarType::Float64 && points.step == 3 &&
    points.components[1] == first + 1 && points.components[2] == first + 2;
}

/// The image in [lo, hi) of a coordinate outside of it; length is hi - lo.
double wrap_one(double x, double lo, double hi, const Twofold& length) noexcept
{
  // so far away that its last bit is more than a period it is nowhere in particular
  if (!(std::abs(x - lo) < 0x1p53 * length.value()))
  {
    return x;
  }
  CompensatedSum sum;
  sum.add(x);
  sum.add_product(-std::floor((x - lo) / length.value()), length);
  // the quotient was rounded, and so may be the image of what lies just below the box
  return std::clamp(sum.value(), lo, std::nextafter(hi, lo));
}
}

AbsolutePositions::AbsolutePositions(const FrameView& frame, bool wrap)
  : frame_(frame)
{
  const Box& box = frame.header.box;
  if (!frame.has_box && frame.coordinates != Coordinates::Absolute)
  {
    throw Error(std::string("expected the box of ") +
      (frame.coordinates == Coordinates::Scaled ? "scaled" : "unwrapped") +
      " points in the field data (BoxOrigin, BoxVectors), got none");
  }
  plan_ = plan_form(frame.coordinates, ColumnRole::Position);
  box_ = frame.has_box ? box_of_points(frame, box) : Box{};
  const auto& [x, y, z] = frame.point_origin;
  less_ = frame.coordinates == Coordinates::Scaled ? Vector3{} : Vector3{ -x, -y, -z };
  bool counted = false;
  if (frame.coordinates == Coordinates::Unwrapped)
  {
    constexpr std::array<const char*, 3> names = { "ix", "iy", "iz" };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      images_[axis] = find_values(frame, names[axis]);
      counted = counted || images_[axis];
    }
    crosses_ = !counted;
  }
  const BoxBounds bounds = frame.has_box && !box.tilted ? box.bounds() : BoxBounds{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lo_[axis] = bounds.lo[axis];
    hi_[axis] = bounds.hi[axis];
    wraps_[axis] = wrap && is_periodic(box, axis) && lo_[axis] < hi_[axis];
  }
  plain_ = frame.points && is_plain(*frame.points) && frame.point_origin == Vector3{} &&
    frame.coordinates == Coordinates::Absolute;
}

const double* AbsolutePositions::load(std::int64_t first, std::size_t count, double* buffer) const
{
  if (plain_)
  {
    const double* const points = this->loaded(first);
    if (this->is_wrapped({ points, 3 * count }))
    {
      return points;
    }
  }
  std::array<std::int64_t, most_rows> rows;
  std::iota(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count), first);
  this->load(std::span(rows).first(count), buffer);
  return buffer;
}

void AbsolutePositions::load(std::span<const std::int64_t> rows, double* buffer) const
{
  this->convert(rows, buffer);
  this->wrap({ buffer, 3 * rows.size() });
}

bool AbsolutePositions::is_wrapped(std::span<const double> points) const noexcept
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double lowest = std::numeric_limits<double>::lowest(); // is finite: -inf is not there
  constexpr std::size_t some = 8; // points at once, without branches
  std::array<double, 3 * some> lo;
  std::array<double, 3 * some> hi;
  for (std::size_t i = 0; i < lo.size(); ++i)
  {
    lo[i] = wraps_[i % 3] ? lo_[i % 3] : lowest;
    hi[i] = wraps_[i % 3] ? hi_[i % 3] : infinity;
  }
  std::size_t outside = 0;
  for (std::size_t first = 0; first < points.size(); first += lo.size())
  {
    const std::size_t count = std::min(lo.size(), points.size() - first);
    for (std::size_t i = 0; i < count; ++i)
    {
      const double x = points[first + i];
      outside |= static_cast<std::size_t>(x < lo[i]) | static_cast<std::size_t>(!(x < hi[i]));
    }
  }
  return outside == 0;
}

/// Into the box, along periodic axes.
void AbsolutePositions::wrap(std::span<double> points) const noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t i = axis; wraps_[axis] && i < points.size(); i += 3)
    {
      if (!(points[i] >= lo_[axis] && points[i] < hi_[axis]))
      {
        points[i] =
          wrap_one(points[i], lo_[axis], hi_[axis], frame_.header.box.vectors[axis][axis]);
      }
    }
  }
}

/// Absolute, but not wrapped.
void AbsolutePositions::convert(std::span<const std::int64_t> rows, double* buffer) const
{
  const std::size_t count = rows.size();
  std::array<double, most_rows> values;
  const auto load_axis = [&](const ValueSource& source, std::size_t axis, double* to)
  {
    load_numbers(source, rows, values.data());
    for (std::size_t i = 0; i < count; ++i)
    {
      to[3 * i + axis] = values[i] * source.factor;
    }
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    load_axis(point_values(frame_, axis), axis, buffer);
  }
  if (frame_.coordinates == Coordinates::Absolute && frame_.point_origin == Vector3{})
  {
    return;
  }
  std::vector<double> images;
  if (frame_.coordinates == Coordinates::Unwrapped)
  {
    images.assign(3 * count, 0);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (images_[axis])
      {
        load_axis(*images_[axis], axis, images.data());
      }
    }
    if (crosses_)
    {
      count_crossings(box_, { buffer, 3 * count }, images);
    }
  }
  convert_positions(plan_, box_, less_, images, { buffer, 3 * count });
}
}
