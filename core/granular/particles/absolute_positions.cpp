// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/absolute_positions.h"

#include "granular/common/error.h"
#include "granular/particles/point_forms.h"

#include <limits>
#include <numeric>
#include <vector>

namespace granular
{
AbsolutePositions::AbsolutePositions(const FrameView& frame, bool wrap, const Vector3& less)
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
  less_ = frame.coordinates == Coordinates::Scaled
    ? less
    : Vector3{ less[0] - x, less[1] - y, less[2] - z };
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
    const Twofold length = box.vectors[axis][axis];
    if (wrap && is_periodic(box, axis) && bounds.lo[axis] < bounds.hi[axis] &&
      std::isfinite(length.hi))
    {
      wraps_[axis] = { bounds.lo[axis], bounds.hi[axis], length };
      plan_.axes[axis].shift = 0; // whatever the counts are
    }
  }
  crosses_ = crosses_ &&
    std::ranges::any_of(plan_.axes, [](const PositionPlan::Axis& axis) { return axis.shift != 0; });
  same_ = frame.coordinates == Coordinates::Absolute && less_ == Vector3{};
  plain_ = same_ && frame.points && frame.points->are_triples() && frame.points->step == 3;
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
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (wraps_[axis])
    {
      this->wrap(axis, rows, buffer);
    }
  }
}

void AbsolutePositions::store(std::int64_t first, std::size_t count, double* to) const
{
  for (std::size_t done = 0; done < count; done += most_rows)
  {
    const std::size_t now = std::min(most_rows, count - done);
    double* const there = to + 3 * done;
    const double* const from = this->load(first + static_cast<std::int64_t>(done), now, there);
    if (from != there)
    {
      std::copy_n(from, 3 * now, there);
    }
  }
}

void AbsolutePositions::store(std::span<const std::int64_t> rows, double* to) const
{
  for (std::size_t done = 0; done < rows.size(); done += most_rows)
  {
    this->load(rows.subspan(done, std::min(most_rows, rows.size() - done)), to + 3 * done);
  }
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
    const std::optional<PeriodicAxis>& axis = wraps_[i % 3];
    lo[i] = axis ? axis->lo : lowest;
    hi[i] = axis ? axis->hi : infinity;
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

/// Into the box, along a periodic axis. On a face the coordinate may have been rounded to it from outside.
void AbsolutePositions::wrap(
  std::size_t axis, std::span<const std::int64_t> rows, double* buffer) const
{
  const PeriodicAxis& period = *wraps_[axis];
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    double& x = buffer[3 * i + axis];
    if (!(x > period.lo && x < period.hi))
    {
      x = period.wrap(this->exact(axis, rows[i]), x);
    }
  }
}

/// The coordinate along an axis that wraps, before it is.
ExactCoordinate AbsolutePositions::exact(std::size_t axis, std::int64_t row) const
{
  const ValueSource source = point_values(frame_, axis);
  double point = 0;
  load_numbers(source, { &row, 1 }, &point);
  ExactCoordinate sum;
  const double terms[] = { point * source.factor, frame_.point_origin[axis] };
  for (const double term : terms)
  {
    if (frame_.coordinates == Coordinates::Scaled)
    {
      sum.add_product(term, wraps_[axis]->length);
    }
    else
    {
      sum.add(term);
    }
  }
  if (frame_.coordinates == Coordinates::Scaled)
  {
    sum.add(wraps_[axis]->lo);
  }
  return sum;
}

/// Absolute, but not wrapped.
void AbsolutePositions::convert(std::span<const std::int64_t> rows, double* buffer) const
{
  const std::size_t count = rows.size();
  load_point_rows(frame_, rows, buffer);
  if (same_)
  {
    return;
  }
  std::vector<double> images;
  if (frame_.coordinates == Coordinates::Unwrapped)
  {
    images.resize(3 * count);
    load_image_rows(images_, rows, images.data());
    if (crosses_)
    {
      count_crossings(box_, { buffer, 3 * count }, images);
    }
  }
  convert_positions(plan_, box_, less_, images, { buffer, 3 * count });
}

std::vector<double> absolute_points(FrameView points)
{
  if (points.coordinates == Coordinates::Unwrapped)
  {
    points.coordinates = Coordinates::Absolute;
  }
  std::vector<double> made(static_cast<std::size_t>(3 * points.rows));
  AbsolutePositions(points, false).store(0, static_cast<std::size_t>(points.rows), made.data());
  return made;
}
}
