// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_positions_h
#define granular_geometry_positions_h

#include "granular/columns/column.h"
#include "granular/common/error.h"
#include "granular/geometry/box.h"

#include <array>
#include <cstdint>
#include <span>

namespace granular
{
/// The form of coordinates.
enum class Coordinates : std::uint8_t
{
  Absolute,  ///< in the box, as the simulation holds them
  Unwrapped, ///< plus the image counts times the box vectors
  Scaled     ///< in units of the box vectors, 0 to 1 inside the box
};

/// Returns "Absolute", "Unwrapped" or "Scaled".
const char* to_string(Coordinates coordinates) noexcept;

/// Returns whether a coordinate column of this role is in units of the box vectors, and whether it is unwrapped.
bool is_scaled(ColumnRole role) noexcept;
bool is_unwrapped(ColumnRole role) noexcept;

/// The columns that give the points of a frame, and the conversions.
struct PositionPlan
{
  struct Axis
  {
    int column = -1;     ///< -1: the file has none; the coordinate is 0
    bool scaled = false; ///< the column is in units of the box vectors
    int shift = 0;       ///< image counts are to be added (1), subtracted (-1) or not needed (0)
  };

  std::array<Axis, 3> axes;
  std::array<int, 3> images = { -1, -1, -1 };      ///< columns, if any axis needs a shift
  Coordinates coordinates = Coordinates::Absolute; ///< form of the points
};

/// Chooses the columns. A form that the file cannot give is replaced by a possible one, with a notice. Throws FormatError
/// without a coordinate column, UnsupportedError for a tilted box with scaled coordinates on one axis and absolute ones on
/// another.
PositionPlan plan_positions(const ColumnSchema& schema, const Box& box, Coordinates wanted,
  const Where& where, Notices& notices);

/// Returns true if a coordinate is multiplied or divided by the box.
inline bool is_rescaled(const PositionPlan& plan, const PositionPlan::Axis& axis) noexcept
{
  return axis.column >= 0 && axis.scaled != (plan.coordinates == Coordinates::Scaled);
}

/// Checks that a finite box can convert scaled coordinates, if a plan does so. Throws FormatError for a box without volume.
void check_scale(const PositionPlan& plan, const Box& box, const Where& where);

/// Returns true if points differ from the numbers of the columns.
bool changes_points(const PositionPlan& plan, const Vector3& point_origin) noexcept;

/// Turns the columns' values into points minus point_origin, in place: points holds x y z of each
/// row, images (empty unless the plan has images) the three counts. Coordinates without a column are
/// taken as 0.
///
/// Each coordinate is within half an ulp plus 2^-100 of the sum of the magnitudes of its terms of
/// the exact value, the file's doubles being exact: also far from the origin, for thin, for nearly
/// flat and for strongly tilted boxes, and after any number of crossings. Terms are those of the
/// expanded formula, by the volume of the box where it is general.
void convert_positions(const PositionPlan& plan, const Box& box, const Vector3& point_origin,
  std::span<const double> images, std::span<double> points) noexcept;

/// Converts absolute coordinates along one axis of an orthogonal box to scaled ones, in place, like convert_positions for
/// rows.
void scale_aligned(const Box& box, std::size_t axis, std::span<double> coordinates) noexcept;
}
#endif
