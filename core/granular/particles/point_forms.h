// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_point_forms_h
#define granular_particles_point_forms_h

#include "granular/geometry/box.h"
#include "granular/geometry/positions.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/frame_view.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace granular
{
/// Returns true if rows are contiguous; true for no rows.
bool is_consecutive(std::span<const std::int64_t> rows) noexcept;

/// Writes the values of some rows as double or std::int64_t, from any type but texts, not multiplied by the factor.
template <class Number>
void load_numbers(const ValueSource& source, std::span<const std::int64_t> rows, Number* to);

/// Calls take(number) for each row of a source of any type but texts, multiplied by the factor.
template <class Take>
void for_each_number(const ValueSource& source, std::int64_t rows, const Take& take)
{
  constexpr std::int64_t most = 256; // at a time
  std::array<std::int64_t, most> some;
  std::array<double, most> numbers;
  for (std::int64_t first = 0; first < rows; first += most)
  {
    const auto count = static_cast<std::size_t>(std::min(rows - first, most));
    std::iota(some.begin(), some.end(), first);
    load_numbers(source, std::span(some).first(count), numbers.data());
    std::for_each_n(numbers.begin(), count, [&](double number) { take(number * source.factor); });
  }
}

/// Returns true if sources are doubles of a row side by side, with factors of 1.
bool are_rows(std::span<const ValueSource> sources) noexcept;

/// Writes the values of several sources, multiplied by their factors, one row after the other: the values of a row are side by
/// side. They may be of any type but texts.
void load_rows(
  std::span<const ValueSource> sources, std::span<const std::int64_t> rows, double* to);

/// Returns true if a box is periodic along an axis, by its boundary flags.
bool is_periodic(const Box& box, std::size_t axis) noexcept;

/// Returns where a coordinate of the points lies; there must be points.
ValueSource point_values(const FrameView& frame, std::size_t axis);

/// Writes three coordinates of each row; there must be points.
void load_point_rows(const FrameView& frame, std::span<const std::int64_t> rows, double* to);

/// Writes three image counts of each row, 0 along axes without any.
void load_image_rows(const std::array<std::optional<ValueSource>, 3>& images,
  std::span<const std::int64_t> rows, double* to);

/// Returns the conversion from the points to a column of this role.
PositionPlan plan_form(Coordinates from, ColumnRole to) noexcept;

/// Returns the box in coordinates from which an origin was subtracted.
Box less_origin(const Box& box, const Vector3& origin);

/// Returns the box in the coordinates of points from which an origin was subtracted, so that adding it to them loses no
/// digit.
Box box_of_points(const FrameView& frame, const Box& box);

/// Returns how often unwrapped points have crossed the box along its periodic axes: three counts per point, 0 along others.
/// Exact, also in tilted boxes, up to 2^52 crossings.
void count_crossings(const Box& box, std::span<const double> points, std::vector<double>& images);
}
#endif
