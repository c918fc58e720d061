// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/point_forms.h"

#include "granular/geometry/expansion.h"

#include <cmath>

namespace granular
{
namespace
{
using Rows = std::span<const std::int64_t>;

template <class From, class To>
void copy_values(const ValueSource& source, Rows rows, To* to)
{
  const auto* from = static_cast<const From*>(source.data);
  const std::int64_t step = source.step;
  const auto count = static_cast<std::int64_t>(rows.size());
  if (count > 0 && is_consecutive(rows))
  {
    from += rows.front() * step;
    for (std::int64_t i = 0; i < count; ++i)
    {
      to[i] = static_cast<To>(from[i * step]);
    }
    return;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    to[i] = static_cast<To>(from[rows[i] * step]);
  }
}

template <std::size_t size>
void copy_rows(const ValueSource& first, Rows rows, double* to) noexcept
{
  const auto* const from = static_cast<const double*>(first.data);
  for (const std::int64_t row : rows)
  {
    for (std::size_t k = 0; k < size; ++k)
    {
      to[k] = from[row * first.step + static_cast<std::int64_t>(k)];
    }
    to += size;
  }
}

/// The sign of what a vector spans with the two that follow an axis of the box.
int side_of(const ExactVector& vector, const Box& box, std::size_t axis) noexcept
{
  return determinant(
    vector, exact_vector(box.vectors[(axis + 1) % 3]), exact_vector(box.vectors[(axis + 2) % 3]))
    .sign();
}

/// Returns true if the scaled coordinate of a point along an axis is below a number. orientation: side_of the vector of that axis.
bool is_below(
  const Box& box, int orientation, std::size_t axis, const double* point, double number) noexcept
{
  ExactVector offset;
  for (std::size_t k = 0; k < 3; ++k)
  {
    offset[k].add(point[k]);
    offset[k].add(-box.origin[k]);
    offset[k].add_product(-number, box.vectors[axis][k]);
  }
  return side_of(offset, box, axis) * orientation < 0;
}
}

bool is_consecutive(Rows rows) noexcept
{
  const auto count = static_cast<std::int64_t>(rows.size());
  if (count > 0 && rows.back() - rows.front() != count - 1)
  {
    return false;
  }
  std::int64_t others = 0; // of rows in no order the ends say nothing
  for (std::int64_t i = 0; i < count; ++i)
  {
    others |= rows[static_cast<std::size_t>(i)] ^ (rows.front() + i);
  }
  return others == 0;
}

template <class Number>
void load_numbers(const ValueSource& source, Rows rows, Number* to)
{
  using Copy = void (*)(const ValueSource&, Rows, Number*);
  constexpr Copy copies[] = { copy_values<std::int8_t>, copy_values<std::uint8_t>,
    copy_values<std::int16_t>, copy_values<std::uint16_t>, copy_values<std::int32_t>,
    copy_values<std::uint32_t>, copy_values<std::int64_t>, copy_values<std::uint64_t>,
    copy_values<float>, copy_values<double> };
  copies[static_cast<std::size_t>(source.type)](source, rows, to);
}

template void load_numbers(const ValueSource& source, Rows rows, double* to);
template void load_numbers(const ValueSource& source, Rows rows, std::int64_t* to);

bool are_rows(std::span<const ValueSource> sources) noexcept
{
  const ValueSource& first = sources.front();
  bool same = first.type == ValueType::Float64 && first.factor == 1;
  for (std::size_t k = 1; same && k < sources.size(); ++k)
  {
    same = sources[k].type == ValueType::Float64 && sources[k].factor == 1 &&
      sources[k].step == first.step &&
      sources[k].data == static_cast<const double*>(first.data) + k;
  }
  return same;
}

void load_rows(std::span<const ValueSource> sources, Rows rows, double* to)
{
  const std::size_t size = sources.size();
  if (rows.empty())
  {
    return; // there may be no array at all
  }
  if ((size == 1 || size == 3 || size == 6) && are_rows(sources))
  {
    const auto copy = size == 1 ? copy_rows<1> : size == 3 ? copy_rows<3> : copy_rows<6>;
    copy(sources.front(), rows, to);
    return;
  }
  std::array<double, 256> values;
  while (!rows.empty())
  {
    const Rows some = rows.first(std::min(rows.size(), values.size()));
    for (std::size_t k = 0; k < size; ++k)
    {
      load_numbers(sources[k], some, values.data());
      for (std::size_t i = 0; i < some.size(); ++i)
      {
        to[size * i + k] = values[i] * sources[k].factor;
      }
    }
    rows = rows.subspan(some.size());
    to += size * some.size();
  }
}

bool is_periodic(const Box& box, std::size_t axis) noexcept
{
  return 3 * axis < box.boundary.size() && box.boundary[3 * axis] == 'p';
}

ValueSource point_values(const FrameView& frame, std::size_t axis)
{
  return { frame.points->type, frame.points->components[axis], frame.points->step };
}

void load_point_rows(const FrameView& frame, Rows rows, double* to)
{
  const std::array<ValueSource, 3> points = { point_values(frame, 0), point_values(frame, 1),
    point_values(frame, 2) };
  load_rows(points, rows, to);
}

void load_image_rows(const std::array<std::optional<ValueSource>, 3>& images, Rows rows, double* to)
{
  const double none = 0;
  std::array<ValueSource, 3> counts;
  std::ranges::transform(images, counts.begin(),
    [&](const auto& image) {
      return image.value_or(ValueSource{ ValueType::Float64, &none, 0 });
    });
  load_rows(counts, rows, to);
}

PositionPlan plan_form(Coordinates from, ColumnRole to) noexcept
{
  PositionPlan plan;
  plan.coordinates = is_scaled(to) ? Coordinates::Scaled : Coordinates::Absolute;
  for (int k = 0; k < 3; ++k)
  {
    PositionPlan::Axis& axis = plan.axes[static_cast<std::size_t>(k)];
    axis.column = k;
    axis.scaled = from == Coordinates::Scaled;
    axis.shift = (is_unwrapped(to) ? 1 : 0) - (from == Coordinates::Unwrapped ? 1 : 0);
  }
  return plan;
}

Box less_origin(const Box& box, const Vector3& origin)
{
  Box moved = box;
  for (std::size_t k = 0; k < 3; ++k)
  {
    CompensatedSum sum;
    sum.add(box.origin[k]);
    sum.add(-origin[k]);
    moved.origin[k] = sum.twofold();
  }
  return moved;
}

Box box_of_points(const FrameView& frame, const Box& box)
{
  if (frame.coordinates != Coordinates::Scaled)
  {
    return less_origin(box, frame.point_origin);
  }
  Box moved = box;
  for (std::size_t k = 0; k < 3; ++k)
  {
    CompensatedSum sum;
    sum.add(box.origin[k]);
    for (std::size_t j = 0; j < 3; ++j)
    {
      sum.add_product(frame.point_origin[j], box.vectors[j][k]);
    }
    moved.origin[k] = sum.twofold();
  }
  return moved;
}

void count_crossings(const Box& box, std::span<const double> points, std::vector<double>& images)
{
  constexpr double rounding = 0x1p-20; // far more than that of a scaled coordinate
  const int orientation = side_of(exact_vector(box.vectors[0]), box, 0); // the same for all axes
  images.assign(points.begin(), points.end());
  convert_positions(
    plan_form(Coordinates::Absolute, ColumnRole::ScaledPosition), box, {}, {}, images);
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const double scaled = images[i];
    const std::size_t axis = i % 3;
    images[i] = is_periodic(box, axis) && std::isfinite(scaled) ? std::floor(scaled) : 0;
    const double face = std::nearbyint(scaled);
    if (is_periodic(box, axis) && std::abs(scaled) < 0x1p52 && std::abs(scaled - face) < rounding)
    {
      images[i] = face - (is_below(box, orientation, axis, &points[i - axis], face) ? 1 : 0);
    }
  }
}
}
