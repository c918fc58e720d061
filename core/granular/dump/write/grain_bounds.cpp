// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/grain_bounds.h"

#include "granular/dump/write/row_values.h"

#include <algorithm>
#include <string>
#include <vector>

namespace granular
{
namespace
{
double radius_of(const RowValues::Column& column, std::size_t row) noexcept
{
  return column.type == ValueType::Int32 ? column.at<std::int32_t>(row)
    : column.type == ValueType::Int64    ? static_cast<double>(column.at<std::int64_t>(row))
                                         : column.at<double>(row);
}
}

void GrainBounds::add(const GrainBounds& other) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lo[axis] = std::min(lo[axis], other.lo[axis]);
    hi[axis] = std::max(hi[axis], other.hi[axis]);
  }
}

Box GrainBounds::box() const
{
  Vector3 from = {};
  Vector3 to = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (lo[axis] <= hi[axis])
    {
      from[axis] = lo[axis];
      to[axis] = hi[axis];
    }
  }
  Box box = Box::from_bounds(from, to);
  box.boundary = "ff ff ff";
  return box;
}

GrainBounds bounds_of_grains(const FrameView& frame)
{
  std::vector<std::string> names = { "x", "y", "z" };
  const std::optional<ValueSource> radii = find_values(frame, "radius");
  const bool spheres = radii && radii->type != ValueType::Text;
  if (spheres)
  {
    names.emplace_back("radius");
  }
  Notices none;
  const ColumnPlan plan = plan_columns(names, frame, true, none);
  GrainBounds bounds;
  RowValues values;
  constexpr auto most = static_cast<std::int64_t>(RowValues::most_rows);
  for (std::int64_t first = 0; first < frame.rows; first += most)
  {
    values.load(frame, plan, {}, first, std::min(most, frame.rows - first), 0);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (std::size_t row = 0; row < values.rows(); ++row)
      {
        const double x = values.columns()[axis].at<double>(row);
        const double r = spheres ? radius_of(values.columns()[3], row) : 0;
        const bool finite = std::isfinite(x - r) && std::isfinite(x + r);
        bounds.lo[axis] = finite ? std::min(bounds.lo[axis], x - r) : bounds.lo[axis];
        bounds.hi[axis] = finite ? std::max(bounds.hi[axis], x + r) : bounds.hi[axis];
      }
    }
  }
  return bounds;
}
}
