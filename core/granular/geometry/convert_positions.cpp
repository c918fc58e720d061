// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/positions.h"

#include "granular/common/simd.h"
#include "granular/geometry/expansion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granular
{
namespace
{
/// Box and plan in the form that the loops over rows want.
struct Conversion
{
  const PositionPlan& plan;
  const Box& box;
  Vector3 point_origin;
  Twofold volume; ///< of a general box, where coordinates are scaled by it
};

[[gnu::always_inline]] inline double shift_of(
  const PositionPlan::Axis& axis, const double* images, std::size_t k) noexcept
{
  return axis.shift == 0 ? 0.0 : axis.shift * images[k];
}

/// Returns true if component k of the box vector j is a term of coordinate k at all. One that is 0 by the
/// shape of the box is none: a particle that was lost along j keeps its coordinate k.
[[gnu::always_inline]] inline bool reaches(const Box& box, std::size_t j, std::size_t k) noexcept
{
  return j == k || box.vectors[j][k].hi != 0;
}

/// Cartesian from scaled or cartesian columns. Without tilt each coordinate has terms of its own axis alone.
template <bool tilted>
[[gnu::always_inline]] inline void to_cartesian(
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
      const bool term = tilted ? reaches(c.box, j, k) : j == k;
      if (term && axis.scaled)
      {
        sum.add_product(given[j], c.box.vectors[j][k]);
      }
      if (term && axis.shift != 0)
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
    sum.add(-box.origin[k]);
    offset[k] = sum.twofold();
  }
  return offset;
}

/// Scaled coordinates in a box whose vectors form an upper triangle, by back substitution.
[[gnu::always_inline]] inline Twofold3 solve_triangular(
  const Box& box, const Twofold3& offset) noexcept
{
  Twofold3 scaled;
  for (std::size_t k = 3; k-- > 0;)
  {
    CompensatedSum sum;
    sum.add(offset[k]);
    for (std::size_t j = k + 1; j < 3; ++j)
    {
      if (reaches(box, j, k))
      {
        sum.add_product(-scaled[j], box.vectors[j][k]);
      }
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
    sum.add_product(-a[j], b[i]);
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

/// Scaled coordinates in a box of any three vectors, by Cramer's rule. The volume of a flat one has few of the bits of its
/// terms: it is computed exactly.
inline Twofold3 solve_general(
  const Box& box, const Twofold& volume, const Twofold3& offset) noexcept
{
  Twofold3 scaled;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Twofold3 normal = cross(box.vectors[(k + 1) % 3], box.vectors[(k + 2) % 3]);
    scaled[k] = dot(normal, offset).over(volume);
  }
  return scaled;
}

[[gnu::always_inline]] inline void to_scaled(
  const Conversion& c, const double* images, double* point) noexcept
{
  const Twofold3 offset = from_corner(c.box, point);
  const Twofold3 solved =
    c.box.general ? solve_general(c.box, c.volume, offset) : solve_triangular(c.box, offset);
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

/// Returns true if three scaled coordinates become those of an aligned box, as in most dumps.
bool places_scaled(const Conversion& c) noexcept
{
  return c.plan.coordinates != Coordinates::Scaled && !c.box.tilted &&
    std::ranges::all_of(c.plan.axes,
      [](const PositionPlan::Axis& axis)
      { return axis.column >= 0 && axis.scaled && axis.shift == 0; });
}

/// Does the work of to_cartesian then. Eight points at once: compilers find vector instructions for them.
[[gnu::always_inline]] inline void place_rows(
  const Conversion& c, std::span<double> points) noexcept
{
  constexpr std::size_t some = 24;
  std::array<Twofold, some> origin;
  std::array<Twofold, some> length;
  std::array<double, some> less;
  for (std::size_t i = 0; i < some; ++i)
  {
    origin[i] = c.box.origin[i % 3];
    length[i] = c.box.vectors[i % 3][i % 3];
    less[i] = -c.point_origin[i % 3];
  }
  const auto place = [&](double& x, std::size_t i)
  {
    CompensatedSum sum;
    sum.add(origin[i]);
    sum.add_product(x, length[i]);
    sum.add(less[i]);
    x = sum.value();
  };
  double* x = points.data();
  const double* const end = x + points.size();
  for (; end - x >= static_cast<std::ptrdiff_t>(some); x += some)
  {
    for (std::size_t i = 0; i < some; ++i)
    {
      place(x[i], i);
    }
  }
  for (std::size_t i = 0; x + i < end; ++i)
  {
    place(x[i], i);
  }
}

[[gnu::always_inline]] inline void convert_rows(
  const Conversion& c, std::span<const double> images, std::span<double> points) noexcept
{
  if (places_scaled(c))
  {
    place_rows(c, points);
    return;
  }
  const double none[3] = {};
  const std::size_t step = images.empty() ? 0 : 3;
  const double* image = images.empty() ? none : images.data();
  const bool scaled = c.plan.coordinates == Coordinates::Scaled;
  for (double* point = points.data(); point != points.data() + points.size(); point += 3)
  {
    if (scaled)
    {
      to_scaled(c, image, point);
    }
    else if (c.box.tilted)
    {
      to_cartesian<true>(c, image, point);
    }
    else
    {
      to_cartesian<false>(c, image, point);
    }
    image += step;
  }
}

/// Does the work of to_scaled in an aligned box. Without branches: compilers find vector instructions for it.
[[gnu::always_inline]] inline void scale_rows(
  const Box& box, std::size_t axis, std::span<double> coordinates) noexcept
{
  constexpr double largest = std::numeric_limits<double>::max();
  const Twofold low = -box.origin[axis];
  const Twofold length = box.vectors[axis][axis];
  for (double& x : coordinates)
  {
    const double offset = x + low.hi;
    const double part = offset - x;
    const double rest = (x - (offset - part)) + (low.hi - part) + low.lo;
    const double quotient = offset / length.hi;
    const double left = std::fma(-quotient, length.hi, offset) + rest - quotient * length.lo;
    // a sum with 0 would lose the sign of -0, which simulations print
    x = std::abs(quotient) <= largest && left != 0 ? quotient + left / length.hi : quotient;
  }
}

#if GRANULAR_X86
/// The same operations; std::fma is an instruction here and a function call there.
__attribute__((target("avx2,fma"))) void convert_avx2(
  const Conversion& c, std::span<const double> images, std::span<double> points) noexcept
{
  convert_rows(c, images, points);
}

__attribute__((target("avx2,fma"))) void scale_avx2(
  const Box& box, std::size_t axis, std::span<double> coordinates) noexcept
{
  scale_rows(box, axis, coordinates);
}
#endif

/// Coordinates that no column gives.
void clear_missing(const PositionPlan& plan, std::span<double> points) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t i = axis; plan.axes[axis].column < 0 && i < points.size(); i += 3)
    {
      points[i] = 0;
    }
  }
}

Twofold volume_of(const Box& box) noexcept
{
  return determinant(
    exact_vector(box.vectors[0]), exact_vector(box.vectors[1]), exact_vector(box.vectors[2]))
    .twofold();
}
}

bool changes_points(const PositionPlan& plan, const Vector3& point_origin) noexcept
{
  return point_origin != Vector3{} ||
    std::ranges::any_of(plan.axes,
      [&](const PositionPlan::Axis& axis) { return axis.shift != 0 || is_rescaled(plan, axis); });
}

void scale_aligned(const Box& box, std::size_t axis, std::span<double> coordinates) noexcept
{
#if GRANULAR_X86
  if (best_simd() != Simd::Portable)
  {
    scale_avx2(box, axis, coordinates);
    return;
  }
#endif
  scale_rows(box, axis, coordinates);
}

void convert_positions(const PositionPlan& plan, const Box& box, const Vector3& point_origin,
  std::span<const double> images, std::span<double> points) noexcept
{
  const bool scales = box.general && plan.coordinates == Coordinates::Scaled;
  const Conversion conversion{ plan, box, point_origin, scales ? volume_of(box) : Twofold{} };
  clear_missing(plan, points);
  if (!changes_points(plan, point_origin))
  {
    return;
  }
#if GRANULAR_X86
  if (best_simd() != Simd::Portable)
  {
    convert_avx2(conversion, images, points);
    return;
  }
#endif
  convert_rows(conversion, images, points);
}
}
