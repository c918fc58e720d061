// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/positions.h"

#include <algorithm>
#include <string>

#if defined(__x86_64__) && defined(__GNUC__)
#define GRANULAR_FMA 1
#endif

namespace granular
{
namespace
{
constexpr std::size_t choices_per_kind = 6;

/// A way to get a coordinate: from the column of a role, adding or subtracting image counts.
struct Choice
{
  ColumnRole role;
  int shift;
  Coordinates gives;
};

using enum ColumnRole;
using enum Coordinates;

/// By what is wanted, best first.
constexpr Choice choices[3][choices_per_kind] = {
  {
    { Position, 0, Absolute },
    { ScaledPosition, 0, Absolute },
    { UnwrappedPosition, -1, Absolute },
    { ScaledUnwrappedPosition, -1, Absolute },
    { UnwrappedPosition, 0, Unwrapped },
    { ScaledUnwrappedPosition, 0, Unwrapped },
  },
  {
    { UnwrappedPosition, 0, Unwrapped },
    { ScaledUnwrappedPosition, 0, Unwrapped },
    { Position, 1, Unwrapped },
    { ScaledPosition, 1, Unwrapped },
    { Position, 0, Absolute },
    { ScaledPosition, 0, Absolute },
  },
  {
    { ScaledPosition, 0, Scaled },
    { Position, 0, Scaled },
    { ScaledUnwrappedPosition, -1, Scaled },
    { UnwrappedPosition, -1, Scaled },
    { ScaledUnwrappedPosition, 0, Scaled },
    { UnwrappedPosition, 0, Scaled },
  },
};

bool is_scaled(ColumnRole role) noexcept
{
  return role == ScaledPosition || role == ScaledUnwrappedPosition;
}

bool is_unwrapped(ColumnRole role) noexcept
{
  return role == UnwrappedPosition || role == ScaledUnwrappedPosition;
}

/// The columns of a frame that choices are made from.
struct Columns
{
  const ColumnSchema& schema;
  bool tilted; ///< a shift along one axis moves all coordinates

  int find(const Choice& choice, int axis) const noexcept
  {
    const bool counted = tilted
      ? schema.find(Image, 0) >= 0 && schema.find(Image, 1) >= 0 && schema.find(Image, 2) >= 0
      : schema.find(Image, axis) >= 0;
    return choice.shift != 0 && !counted ? -1 : schema.find(choice.role, axis);
  }

  bool complete(const Choice& choice) const noexcept
  {
    return find(choice, 0) >= 0 && find(choice, 1) >= 0 && find(choice, 2) >= 0;
  }
};

/// The choice of each axis: one for all if that can be, else the best of each; null: no column.
std::array<const Choice*, 3> choose(const Columns& columns, std::span<const Choice> order)
{
  std::array<const Choice*, 3> chosen = {};
  for (const Choice& choice : order)
  {
    if (columns.complete(choice))
    {
      return { &choice, &choice, &choice };
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!chosen[axis] && columns.find(choice, static_cast<int>(axis)) >= 0)
      {
        chosen[axis] = &choice;
      }
    }
  }
  return chosen;
}

bool mixed(const PositionPlan& plan) noexcept
{
  bool scaled = false;
  bool absolute = false;
  for (const PositionPlan::Axis& axis : plan.axes)
  {
    scaled = scaled || (axis.column >= 0 && axis.scaled);
    absolute = absolute || (axis.column >= 0 && !axis.scaled);
  }
  return scaled && absolute;
}

void note(const PositionPlan& plan, std::span<const Choice* const> chosen, Coordinates wanted,
  const Where& where, Notices& notices)
{
  std::string missing;
  bool uncounted = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    missing += chosen[axis] ? "" : std::string(missing.empty() ? "" : " ") + "xyz"[axis];
    uncounted = uncounted ||
      (wanted == Scaled && chosen[axis] && is_unwrapped(chosen[axis]->role) && chosen[axis]->shift == 0);
  }
  if (!missing.empty())
  {
    notices.push_back({ where, "no column for the coordinate " + missing + "; it is set to 0" });
  }
  if (plan.coordinates != wanted || uncounted)
  {
    notices.push_back({ where,
      std::string("expected image counts ix iy iz to make ") + to_string(wanted) +
        " coordinates, got none; the points are " +
        (uncounted ? "Scaled and unwrapped" : to_string(plan.coordinates)) });
  }
}

/// Box and plan in the form that the loops over rows want.
struct Conversion
{
  const PositionPlan& plan;
  const Box& box;
  Vector3 point_origin;
};

[[gnu::always_inline]] inline double shift_of(
  const PositionPlan::Axis& axis, const double* images, std::size_t k) noexcept
{
  return axis.shift == 0 ? 0.0 : axis.shift * images[k];
}

/// Cartesian from scaled or cartesian columns; the box is axis-aligned.
[[gnu::always_inline]] inline void to_cartesian_aligned(
  const Conversion& c, const double* images, double* point) noexcept
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const PositionPlan::Axis& axis = c.plan.axes[k];
    const double shift = shift_of(axis, images, k);
    CompensatedSum sum;
    if (axis.column >= 0 && axis.scaled)
    {
      sum.add(c.box.origin[k]);
      sum.add_product(point[k], c.box.vectors[k][k]);
    }
    else
    {
      sum.add(point[k]);
    }
    if (axis.shift != 0)
    {
      sum.add_product(shift, c.box.vectors[k][k]);
    }
    sum.add(-c.point_origin[k]);
    point[k] = sum.value();
  }
}

[[gnu::always_inline]] inline void to_cartesian_tilted(
  const Conversion& c, const double* images, double* point) noexcept
{
  const Vector3 given = { point[0], point[1], point[2] };
  for (std::size_t k = 0; k < 3; ++k)
  {
    CompensatedSum sum;
    if (c.plan.axes[k].scaled)
    {
      sum.add(c.box.origin[k]);
    }
    else
    {
      sum.add(given[k]);
    }
    for (std::size_t j = 0; j < 3; ++j)
    {
      const PositionPlan::Axis& axis = c.plan.axes[j];
      if (axis.scaled)
      {
        sum.add_product(given[j], c.box.vectors[j][k]);
      }
      if (axis.shift != 0)
      {
        sum.add_product(shift_of(axis, images, j), c.box.vectors[j][k]);
      }
    }
    sum.add(-c.point_origin[k]);
    point[k] = sum.value();
  }
}

/// point - origin of the box, to the last bit
[[gnu::always_inline]] inline Twofold3 from_corner(const Box& box, const double* point) noexcept
{
  Twofold3 offset;
  for (std::size_t k = 0; k < 3; ++k)
  {
    CompensatedSum sum;
    sum.add(point[k]);
    sum.add(Twofold{ -box.origin[k].hi, -box.origin[k].lo });
    offset[k] = sum.twofold();
  }
  return offset;
}

inline Twofold negative(Twofold value) noexcept
{
  return { -value.hi, -value.lo };
}

/// Scaled coordinates in a box whose vectors form an upper triangle, by back substitution.
[[gnu::always_inline]] inline Twofold3 solve_triangular(const Box& box, const Twofold3& offset) noexcept
{
  Twofold3 scaled;
  for (std::size_t k = 3; k-- > 0;)
  {
    CompensatedSum sum;
    sum.add(offset[k]);
    for (std::size_t j = k + 1; j < 3; ++j)
    {
      sum.add_product(negative(scaled[j]), box.vectors[j][k]);
    }
    scaled[k] = sum.over(box.vectors[k][k]);
  }
  return scaled;
}

inline Twofold3 cross(const Twofold3& a, const Twofold3& b) noexcept
{
  Twofold3 product;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    CompensatedSum sum;
    sum.add_product(a[i], b[j]);
    sum.add_product(negative(a[j]), b[i]);
    product[k] = sum.twofold();
  }
  return product;
}

inline CompensatedSum dot(const Twofold3& a, const Twofold3& b) noexcept
{
  CompensatedSum sum;
  for (std::size_t k = 0; k < 3; ++k)
  {
    sum.add_product(a[k], b[k]);
  }
  return sum;
}

/// Scaled coordinates in a box of any three vectors, by Cramer's rule.
inline Twofold3 solve_general(const Box& box, const Twofold3& offset) noexcept
{
  Twofold3 scaled;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Twofold3 normal = cross(box.vectors[(k + 1) % 3], box.vectors[(k + 2) % 3]);
    scaled[k] = dot(normal, offset).over(dot(normal, box.vectors[k]).twofold());
  }
  return scaled;
}

[[gnu::always_inline]] inline void to_scaled(
  const Conversion& c, const double* images, double* point) noexcept
{
  const Twofold3 offset = from_corner(c.box, point);
  const Twofold3 solved =
    c.box.general ? solve_general(c.box, offset) : solve_triangular(c.box, offset);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const PositionPlan::Axis& axis = c.plan.axes[k];
    CompensatedSum sum;
    sum.add(axis.column < 0 || axis.scaled ? Twofold{ point[k], 0 } : solved[k]);
    sum.add(shift_of(axis, images, k));
    sum.add(-c.point_origin[k]);
    point[k] = sum.value();
  }
}

[[gnu::always_inline]] inline void convert_rows(
  const Conversion& c, std::span<const double> images, std::span<double> points) noexcept
{
  const double none[3] = {};
  const std::size_t step = images.empty() ? 0 : 3;
  const double* image = images.empty() ? none : images.data();
  const bool scaled = c.plan.coordinates == Scaled;
  for (double* point = points.data(); point != points.data() + points.size(); point += 3)
  {
    if (scaled)
    {
      to_scaled(c, image, point);
    }
    else if (c.box.tilted)
    {
      to_cartesian_tilted(c, image, point);
    }
    else
    {
      to_cartesian_aligned(c, image, point);
    }
    image += step;
  }
}

void convert_portable(
  const Conversion& c, std::span<const double> images, std::span<double> points) noexcept
{
  convert_rows(c, images, points);
}

#if GRANULAR_FMA
/// The same operations; std::fma is an instruction here and a function call there.
__attribute__((target("fma"))) void convert_fma(
  const Conversion& c, std::span<const double> images, std::span<double> points) noexcept
{
  convert_rows(c, images, points);
}
#endif

bool changes_nothing(const Conversion& c) noexcept
{
  return c.point_origin == Vector3{} &&
    std::all_of(c.plan.axes.begin(), c.plan.axes.end(),
      [&](const PositionPlan::Axis& axis)
      {
        return axis.shift == 0 &&
          (axis.column < 0 || axis.scaled == (c.plan.coordinates == Scaled));
      });
}
}

const char* to_string(Coordinates coordinates) noexcept
{
  constexpr const char* names[] = { "Absolute", "Unwrapped", "Scaled" };
  return names[static_cast<std::size_t>(coordinates)];
}

PositionPlan plan_positions(
  const ColumnSchema& schema, const Box& box, Coordinates wanted, const Where& where, Notices& notices)
{
  const Columns columns{ schema, box.tilted };
  const auto chosen = choose(columns, choices[static_cast<std::size_t>(wanted)]);
  PositionPlan plan;
  plan.coordinates = wanted;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (const Choice* choice = chosen[k])
    {
      plan.axes[k] = { columns.find(*choice, static_cast<int>(k)), is_scaled(choice->role),
        choice->shift };
      plan.coordinates = choice->gives == wanted ? plan.coordinates : choice->gives;
    }
  }
  if (std::count(chosen.begin(), chosen.end(), nullptr) == 3)
  {
    throw FormatError(
      "expected columns of coordinates (x y z, xs ys zs, xu yu zu or xsu ysu zsu), got '" +
        schema.text() + "'",
      where);
  }
  if (box.tilted && mixed(plan))
  {
    throw UnsupportedError(
      "expected all coordinates of a tilted box in one form, got '" + schema.text() + "'", where);
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (std::any_of(plan.axes.begin(), plan.axes.end(), [](const auto& a) { return a.shift != 0; }))
    {
      plan.images[k] = schema.find(Image, static_cast<int>(k));
    }
  }
  note(plan, chosen, wanted, where, notices);
  return plan;
}

void convert_positions(const PositionPlan& plan, const Box& box, const Vector3& point_origin,
  std::span<const double> images, std::span<double> points) noexcept
{
  const Conversion conversion{ plan, box, point_origin };
  if (changes_nothing(conversion))
  {
    return;
  }
#if GRANULAR_FMA
  static const bool has_fma = __builtin_cpu_supports("fma");
  if (has_fma)
  {
    convert_fma(conversion, images, points);
    return;
  }
#endif
  convert_portable(conversion, images, points);
}
}
