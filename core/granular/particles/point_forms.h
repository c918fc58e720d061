// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_point_forms_h
#define granular_particles_point_forms_h

#include "granular/geometry/box.h"
#include "granular/geometry/positions.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Whether rows are one behind the other; true for none.
bool is_consecutive(std::span<const std::int64_t> rows) noexcept;

/// Writes the values of some rows as double or std::int64_t, from any type but texts, not multiplied by the factor.
template <class Number>
void load_numbers(const ValueSource& source, std::span<const std::int64_t> rows, Number* to);

/// Whether a box is periodic along an axis, by its boundary flags.
bool is_periodic(const Box& box, std::size_t axis) noexcept;

/// Where a coordinate of the points lies; there must be points.
ValueSource point_values(const FrameView& frame, std::size_t axis);

/// From what the points are to what a column of this role holds.
PositionPlan plan_form(Coordinates from, ColumnRole to) noexcept;

/// The box in the coordinates of points that an origin was subtracted from, so that no digit is lost by adding
/// it to them.
Box box_of_points(const FrameView& frame, const Box& box);

/// How often unwrapped points have crossed the box along its periodic axes: three counts a point, 0 along others. Exact, in
/// tilted boxes, too, up to 2^52 crossings.
void count_crossings(const Box& box, std::span<const double> points, std::vector<double>& images);
}
#endif
