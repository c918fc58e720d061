// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/sphere_box.h"

#include "exact_sphere_box.h"
#include "sphere_box_volume.h"

#include "../support/hard_case.h"
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{
using granular::sphere_volume;
using granular::Vector3;

struct Case
{
  Vector3 centre;
  double radius;
  Vector3 lo, hi;
};

std::string to_text(const Case& c)
{
  std::ostringstream out;
  out.precision(17);
  for (const Vector3& v : { c.centre, c.lo, c.hi })
  {
    out << "{ " << v[0] << ", " << v[1] << ", " << v[2] << " } ";
  }
  out << "radius " << c.radius;
  return out.str();
}

/// Returns the error in units of what is promised.
double expect_exact(const Case& c)
{
  const double volume = sphere_box_volume(c.centre, c.radius, c.lo, c.hi);
  const ExactVolume exact = exact_sphere_box(c.centre, c.radius, c.lo, c.hi);
  const Quad error = absolute(static_cast<Quad>(volume) - exact.value);
  EXPECT_TRUE(error <= exact.tolerance)
    << to_text(c) << ": got " << volume << ", expected " << static_cast<double>(exact.value)
    << ", error / tolerance " << static_cast<double>(error / exact.tolerance);
  const double box = (c.hi[0] - c.lo[0]) * (c.hi[1] - c.lo[1]) * (c.hi[2] - c.lo[2]);
  EXPECT_GE(volume, 0) << to_text(c);
  EXPECT_LE(volume, sphere_volume(c.radius)) << to_text(c);
  EXPECT_LE(volume, box * (1 + 0x1p-50) + std::numeric_limits<double>::denorm_min()) << to_text(c);
  return static_cast<double>(error / exact.tolerance);
}

// ---- what the other expectations rest on -------------------------------------------------------

/// The area below the circle of this radius, above no less than the x axis, between x = 0 and x.
long double area_below_circle(long double radius, long double x)
{
  x = std::clamp(x, -radius, radius);
  return (x * std::sqrt(radius * radius - x * x) + radius * radius * std::asin(x / radius)) / 2;
}

/// Of a disc where y < to and x0 < x < x1.
long double disc_below(long double radius, long double x0, long double x1, long double to)
{
  x0 = std::clamp(x0, -radius, radius);
  x1 = std::clamp(x1, -radius, radius);
  const auto half = [&](long double a, long double b)
  { return a < b ? area_below_circle(radius, b) - area_below_circle(radius, a) : 0.0L; };
  if (to <= -radius || x0 >= x1)
  {
    return 0;
  }
  if (to >= radius)
  {
    return 2 * half(x0, x1);
  }
  const long double cut = std::sqrt(radius * radius - to * to);
  const long double a = std::clamp(-cut, x0, x1);
  const long double b = std::clamp(cut, x0, x1);
  const long double outer = half(x0, a) + half(b, x1);
  return (to > 0 ? 2 * outer : 0) + half(a, b) + to * (b - a);
}

/// Double-exponential quadrature, which does not mind roots at the ends.
long double integrate(
  long double a, long double b, const std::function<long double(long double)>& function)
{
  constexpr long double half_pi = std::numbers::pi_v<long double> / 2;
  constexpr long double step = 1.0L / 32;
  long double sum = 0;
  for (int i = -130; i <= 130; ++i)
  {
    const long double t = static_cast<long double>(i) * step;
    const long double x = std::tanh(half_pi * std::sinh(t));
    const long double weight =
      half_pi * std::cosh(t) / std::pow(std::cosh(half_pi * std::sinh(t)), 2.0L);
    sum += weight * function((a + b) / 2 + x * (b - a) / 2);
  }
  return sum * step * (b - a) / 2;
}

/// The unit sphere at the origin, by the areas of its slices.
long double volume_by_slices(const Vector3& lo, const Vector3& hi)
{
  std::vector<long double> ends = { lo[2], hi[2], 0, 1, -1 };
  const auto add_ends = [&](long double distance2)
  {
    if (distance2 < 1)
    {
      ends.push_back(std::sqrt(1 - distance2));
      ends.push_back(-std::sqrt(1 - distance2));
    }
  };
  for (const long double x : { lo[0], hi[0] })
  {
    add_ends(x * x);
    for (const long double y : { lo[1], hi[1] })
    {
      add_ends(y * y);
      add_ends(x * x + y * y);
    }
  }
  for (long double& end : ends)
  {
    end = std::clamp<long double>(std::clamp<long double>(end, lo[2], hi[2]), -1, 1);
  }
  std::sort(ends.begin(), ends.end());
  long double volume = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
  {
    if (ends[i] < ends[i + 1])
    {
      volume += integrate(ends[i], ends[i + 1],
        [&](long double z)
        {
          const long double radius = std::sqrt(std::max(0.0L, 1 - z * z));
          return radius > 0
            ? disc_below(radius, lo[0], hi[0], hi[1]) - disc_below(radius, lo[0], hi[0], lo[1])
            : 0.0L;
        });
    }
  }
  return volume;
}

TEST(SphereBox, TheExpectationsAreThoseOfQuadrature)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  for (int i = 0; i < 60; ++i)
  {
    Vector3 lo = {};
    Vector3 hi = {};
    for (std::size_t k = 0; k < 3; ++k)
    {
      lo[k] = place(random);
      hi[k] = i % 2 == 0 ? place(random) : lo[k] + 0.3;
      if (hi[k] < lo[k])
      {
        std::swap(lo[k], hi[k]);
      }
    }
    const ExactVolume exact = exact_sphere_box(Vector3{}, 1, lo, hi);
    EXPECT_NEAR(static_cast<double>(exact.value), static_cast<double>(volume_by_slices(lo, hi)),
      2e-16) // of which the quadrature, with 64 bits, has the larger part
      << to_text({ {}, 1, lo, hi });
  }
}

// ---- volumes that have a name ------------------------------------------------------------------

TEST(SphereBox, WhatIsWhollyInsideAndOutside)
{
  const Vector3 centre = { 0.1, 0.2, 0.3 };
  // the box in the sphere, to the bit
  EXPECT_EQ(sphere_box_volume(centre, 1, { 0, 0, 0 }, { 0.5, 0.25, 0.3 }), 0.25 * 0.3 * 0.5);
  EXPECT_EQ(sphere_box_volume(centre, 10, { -1, -2, -3 }, { 1, 2, 3 }), 48);
  // the sphere in the box, also where it touches all faces
  EXPECT_EQ(sphere_box_volume(centre, 0.5, { -1, -2, -3 }, { 1, 2, 3 }), sphere_volume(0.5));
  EXPECT_EQ(sphere_box_volume({}, 3, { -3, -3, -3 }, { 3, 3, 3 }), sphere_volume(3));
  // beside it, also where it touches a face, an edge, a corner
  EXPECT_EQ(sphere_box_volume(centre, 1, { 5, 0, 0 }, { 6, 1, 1 }), 0);
  EXPECT_EQ(sphere_box_volume({}, 1, { 1, -1, -1 }, { 2, 1, 1 }), 0);
  EXPECT_EQ(sphere_box_volume({}, 5, { 3, 4, -9 }, { 9, 9, 9 }), 0);
  EXPECT_EQ(sphere_box_volume({}, 3, { 1, 2, 2 }, { 9, 9, 9 }), 0);
  EXPECT_GT(sphere_box_volume({}, 3, { -9, -9, -9 }, { -1, 2, -2 }), 0);
}

// ---- against 113 bits --------------------------------------------------------------------------

class Random
{
public:
  explicit Random(std::uint64_t seed)
    : random_(seed)
  {
  }

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double power(double from, double to) { return std::pow(10, from + (to - from) * this->unit()); }
  std::size_t axis() { return static_cast<std::size_t>(random_() % 3); }
  bool one_in(std::uint64_t n) { return random_() % n == 0; }

  /// On the unit sphere, often near a plane or an axis.
  Vector3 direction()
  {
    Vector3 n = {};
    std::normal_distribution<double> normal;
    for (double& x : n)
    {
      x = normal(random_) * (this->one_in(4) ? this->power(-9, 0) : 1);
    }
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return { n[0] / length, n[1] / length, n[2] / length };
  }

private:
  std::mt19937_64 random_;
};

/// A box with these edges, in units of the radius, that holds a point of the surface.
Case box_at_surface(Random& random, const Vector3& edges)
{
  Case c = { {}, random.power(-4, 3), {}, {} };
  const Vector3 n = random.direction();
  for (std::size_t k = 0; k < 3; ++k)
  {
    c.centre[k] = (2 * random.unit() - 1) * c.radius;
    c.lo[k] = c.centre[k] + c.radius * (n[k] - edges[k] * random.unit());
    c.hi[k] = c.lo[k] + edges[k] * c.radius;
  }
  return c;
}

TEST(SphereBox, CubesOfAnySize)
{
  HardCase hard(
    "volumes", "sphere and cube of 1e-6 to 1e6 radii: error over its bound", "bounds", 1);
  Random random(2);
  for (int i = 0; i < 3000; ++i)
  {
    const double edge = random.power(-6, i % 2 == 0 ? 6 : 0.5);
    hard.add(expect_exact(box_at_surface(random, { edge, edge, edge })));
  }
}

TEST(SphereBox, AnyThreeEdges)
{
  HardCase hard("volumes",
    "sphere and box of any three edges, 1e-7 to 10 radii: error over its bound", "bounds", 1);
  Random random(4);
  for (int i = 0; i < 3000; ++i)
  {
    hard.add(expect_exact(
      box_at_surface(random, { random.power(-7, 1), random.power(-7, 1), random.power(-7, 1) })));
  }
}

/// Faces through the centre, at whole multiples of the edge from it, through the poles and just beside them.
TEST(SphereBox, FacesWhereFormulasChange)
{
  Random random(5);
  for (int i = 0; i < 4000; ++i)
  {
    const double edge = random.power(-4, 0.5);
    const bool is_cube = random.one_in(2);
    Case c = box_at_surface(random,
      { edge, is_cube ? edge : random.power(-4, 0.5), is_cube ? edge : random.power(-4, 0.5) });
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double length = c.hi[k] - c.lo[k];
      const double beside = random.one_in(2) ? random.power(-17, -1) : 0;
      switch (static_cast<int>(5 * random.unit()))
      {
        case 0:
          c.lo[k] = c.centre[k] + c.radius * beside;
          break;
        case 1:
          c.lo[k] = c.centre[k] + length * std::floor(random.unit() / edge) + c.radius * beside;
          break;
        case 2:
          c.lo[k] = c.centre[k] - c.radius * (1 + beside);
          break;
        case 3:
          c.lo[k] = c.centre[k] + c.radius * (1 - beside) - length;
          break;
        default:
          break;
      }
      c.hi[k] = c.lo[k] + length;
    }
    expect_exact(c);
  }
}

/// Where coordinates are large, cells may be an ulp thick.
TEST(SphereBox, FarFromTheOriginAndOneUlpThick)
{
  HardCase hard("volumes", "1e10 radii from the origin, cells one ulp thick: error over its bound",
    "bounds", 1);
  Random random(6);
  for (int i = 0; i < 2000; ++i)
  {
    Case c = box_at_surface(random, { random.power(-3, 1), random.power(-3, 1), 1 });
    const double scale = 1e-4 / c.radius;
    c.radius = 1e-4;
    const bool is_far = random.one_in(2);
    for (std::size_t k = 0; k < 3; ++k)
    {
      c.centre[k] = 1e6 + c.centre[k] * scale;
      c.lo[k] = 1e6 + c.lo[k] * scale;
      c.hi[k] = std::max(std::nextafter(c.lo[k], 2e6), 1e6 + c.hi[k] * scale);
    }
    const std::size_t axis = random.axis();
    if (is_far)
    {
      c.hi[axis] = std::nextafter(c.lo[axis], 2e6);
    }
    else // seen from afar
    {
      c.centre[axis] += 1e3;
      c.radius = 1e3;
    }
    hard.add(expect_exact(c));
  }
}

// ---- the ends of the numbers -------------------------------------------------------------------

TEST(SphereBox, NothingOfNothing)
{
  EXPECT_EQ(sphere_volume(0), 0);
  EXPECT_EQ(sphere_box_volume({}, 0, { -1, -1, -1 }, { 1, 1, 1 }), 0);
  EXPECT_EQ(sphere_box_volume({}, 1, { -1, 0.5, -1 }, { 1, 0.5, 1 }), 0);
  EXPECT_EQ(sphere_box_volume({}, 1, { 0, 0, 0 }, { 0, 0, 0 }), 0);
  EXPECT_EQ(sphere_box_volume({}, 1, { -1e300, 0, -1e300 }, { 1e300, 0, 1e300 }), 0);
}

/// A power of two changes nothing, as long as the numbers have all their bits.
TEST(SphereBox, ScalesExactly)
{
  Random random(7);
  for (int i = 0; i < 200; ++i)
  {
    const double edge = random.power(-2, 0.5);
    Case c = box_at_surface(random, { edge, edge, random.power(-2, 0.5) });
    const double volume = sphere_box_volume(c.centre, c.radius, c.lo, c.hi);
    for (const int exponent : { -330, -300, -100, 100, 300, 330 })
    {
      Case d = c;
      for (Vector3* v : { &d.centre, &d.lo, &d.hi })
      {
        for (double& x : *v)
        {
          x = std::ldexp(x, exponent);
        }
      }
      d.radius = std::ldexp(c.radius, exponent);
      const double expected = std::ldexp(volume, 3 * exponent);
      const double got = sphere_box_volume(d.centre, d.radius, d.lo, d.hi);
      if (std::isnormal(expected))
      {
        EXPECT_NEAR(got / expected, 1, 1e-14) << to_text(c) << exponent;
      }
    }
  }
}

TEST(SphereBox, NumbersOfAnySize)
{
  Random random(8);
  const auto number = [&]
  { return (random.one_in(2) ? 1 : -1) * (random.one_in(5) ? 0 : random.power(-330, 308)); };
  for (int i = 0; i < 200000; ++i)
  {
    Case c = { { number(), number(), number() }, std::abs(number()), {}, {} };
    const double near = random.power(-20, 20);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const bool is_near = random.one_in(2);
      c.lo[k] = is_near ? c.centre[k] + c.radius * (random.unit() * 2 - 1) : number();
      c.hi[k] = is_near ? c.lo[k] + c.radius * near : number();
      if (!std::isfinite(c.hi[k]))
      {
        c.hi[k] = std::numeric_limits<double>::max();
      }
      if (!std::isfinite(c.lo[k]))
      {
        c.lo[k] = -std::numeric_limits<double>::max();
      }
      if (c.hi[k] < c.lo[k])
      {
        std::swap(c.hi[k], c.lo[k]);
      }
    }
    const double volume = sphere_box_volume(c.centre, c.radius, c.lo, c.hi);
    ASSERT_TRUE(volume >= 0 && volume <= sphere_volume(c.radius)) << to_text(c) << volume;
  }
  constexpr double denormal = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(sphere_box_volume({}, denormal, { -1, -1, -1 }, { 1, 1, 1 }), 0);
  EXPECT_EQ(sphere_box_volume({}, 1, { 0, 0, 0 }, { denormal, denormal, denormal }), 0);
  EXPECT_TRUE(
    std::isinf(sphere_box_volume({}, 1e150, { -1e200, -1e200, -1e200 }, { 1e200, 1e200, 1e200 })));
  EXPECT_EQ(sphere_box_volume({}, 1e300, { 1, 1, 1 }, { 2, 2, 2 }), 1);
  EXPECT_EQ(sphere_box_volume({ 1e300, 0, 0 }, 1e299, { 1, 1, 1 }, { 2, 2, 2 }), 0);
  EXPECT_EQ(sphere_box_volume({ 1e308, 1e308, 0 }, 1, { -1e308, -1e308, -1 }, { 0, 0, 1 }), 0);
}
}
