// SPDX-License-Identifier: BSD-3-Clause
// Images of coordinates within ulps of a periodic face, against integers of 128 bits.
#include "granular/particles/absolute_positions.h"
#include "granular/particles/point_forms.h"

#include "../support/exact_units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using namespace granular;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

double moved(double x, int ulps)
{
  for (int i = 0; i < std::abs(ulps); ++i)
  {
    x = std::nextafter(x, ulps < 0 ? -infinity : infinity);
  }
  return x;
}

/// A coordinate, given as it is, or as a sum.
struct Given
{
  double point = 0;
  double origin = 0;
};

/// Loads points with these x, wrapped into [lo, hi).
std::vector<double> wrapped(
  const std::vector<double>& xs, double lo, double hi, double origin, Coordinates coordinates)
{
  std::vector<double> points;
  for (const double x : xs)
  {
    points.insert(points.end(), { x, 0, 0 });
  }
  FrameView view;
  view.rows = static_cast<std::int64_t>(xs.size());
  view.points = view_rows("points", ValueType::Float64, points.data(), 3);
  view.header.box = Box::from_bounds({ lo, -1, -1 }, { hi, 1, 1 });
  view.header.box.boundary = "pp ff ff";
  view.point_origin = { origin, 0, 0 };
  view.coordinates = coordinates;
  const AbsolutePositions positions(view, true);
  std::vector<double> buffer(3 * AbsolutePositions::most_rows);
  std::vector<double> result;
  for (std::int64_t first = 0; first < view.rows;)
  {
    const auto count = std::min<std::int64_t>(
      static_cast<std::int64_t>(AbsolutePositions::most_rows), view.rows - first);
    const double* const at = positions.load(first, static_cast<std::size_t>(count), buffer.data());
    for (std::int64_t i = 0; i < count; ++i)
    {
      result.push_back(at[3 * i]);
    }
    first += count;
  }
  return result;
}

/// Whether a double is the largest one that is not above a number of units.
bool is_floor(double x, Int128 units)
{
  const bool has_all_units = std::abs(x) < std::ldexp(1., 52 - unit_bits);
  return has_all_units ? to_units(x) == units
                       : to_units(x) <= units && to_units(moved(x, 1)) > units;
}

struct Bounds
{
  double lo;
  double hi;
};

constexpr Bounds boxes[] = { { 0, 0.1 }, { -0.1, 0.2 }, { 0.3, 0.7 }, { -1. / 3, 1e-3 }, { 1, 4 },
  { 1e3, 1000.1 }, { -0.7, 1e-4 } };

/// Coordinates within three ulps of images of a place.
std::vector<double> beside_images(
  const Bounds& box, double place, int count, std::mt19937_64& random)
{
  std::vector<double> xs;
  while (static_cast<int>(xs.size()) < count)
  {
    const auto periods =
      static_cast<double>(static_cast<std::int64_t>(random()) >> (44 + random() % 20));
    xs.push_back(moved(place + periods * (box.hi - box.lo), static_cast<int>(random() % 7) - 3));
    if (std::abs(xs.back()) < 0x1p-20)
    {
      xs.back() = 0; // no whole number of units
    }
  }
  return xs;
}
}

TEST(PeriodicWrap, ByHand)
{
  const double below = std::nextafter(0.1, 0.0);
  // 7 x 0.1 is 0.70000000000000003886 and -0.7000000000000001 is -0.70000000000000006661: two ulps below an image of 0
  EXPECT_EQ(wrapped({ -0.7000000000000001, -1e-300, 0.1, -0.0 }, 0, 0.1, 0, Coordinates::Absolute),
    (std::vector<double>{ std::nextafter(below, 0.0), below, 0, 0 }));
  EXPECT_EQ(wrapped({ -1e-20, 0, 1, 1e300 }, 1, 4, 0, Coordinates::Scaled),
    (std::vector<double>{ std::nextafter(4.0, 0.0), 1, 1, 3e300 }));
  EXPECT_EQ(wrapped({ 0, 1 }, 1, 4, -1e-20, Coordinates::Scaled),
    (std::vector<double>{ std::nextafter(4.0, 0.0), std::nextafter(4.0, 0.0) }));
  EXPECT_EQ(wrapped({ 1, 4, 0.5 }, 1, 4, -1e-20, Coordinates::Absolute),
    (std::vector<double>{
      std::nextafter(4.0, 0.0), std::nextafter(4.0, 0.0), std::nextafter(3.5, 0.0) }));
}

TEST(PeriodicWrap, BesideFacesAndCuts)
{
  std::mt19937_64 random(3);
  for (const Bounds& box : boxes)
  {
    for (const double part : { 0., 0.25, 0.5, 1. / 3 })
    {
      const double place = box.lo + part * (box.hi - box.lo);
      for (const Coordinates coordinates : { Coordinates::Absolute, Coordinates::Unwrapped })
      {
        const std::vector<double> xs = beside_images(box, place, 4000, random);
        const std::vector<double> found = wrapped(xs, box.lo, box.hi, 0, coordinates);
        for (std::size_t i = 0; i < xs.size(); ++i)
        {
          ASSERT_TRUE(found[i] >= box.lo && found[i] < box.hi) << xs[i];
          ASSERT_TRUE(is_floor(found[i], image_in(xs[i], box.lo, box.hi)))
            << found[i] << " of " << xs[i] << " in " << box.lo << " " << box.hi;
        }
      }
    }
  }
}

/// An origin that was subtracted: the sum is not rounded before it is wrapped.
TEST(PeriodicWrap, OfSumsWithTheOrigin)
{
  std::mt19937_64 random(4);
  for (const Bounds& box : boxes)
  {
    const double origin = 0.1 * static_cast<double>(random() % 5) - 0.2;
    std::vector<double> xs = beside_images(box, box.lo, 4000, random);
    std::ranges::for_each(xs,
      [origin](double& x)
      {
        x -= origin;
        x = std::abs(x) < 0x1p-20 ? 0 : x;
      });
    const std::vector<double> found = wrapped(xs, box.lo, box.hi, origin, Coordinates::Absolute);
    const Int128 period = to_units(box.hi) - to_units(box.lo);
    for (std::size_t i = 0; i < xs.size(); ++i)
    {
      const Int128 sum = to_units(xs[i]) + to_units(origin);
      const Int128 image = sum - floor_quotient(sum - to_units(box.lo), period) * period;
      const double rounded = xs[i] + origin; // once, where it is in the box
      ASSERT_TRUE(
        rounded > box.lo && rounded < box.hi ? found[i] == rounded : is_floor(found[i], image))
        << found[i] << " of " << xs[i] << " + " << origin << " in " << box.lo << " " << box.hi;
    }
  }
}

namespace
{
using Vectors = std::array<std::array<std::int64_t, 3>, 3>;
using Point = std::array<std::int64_t, 3>;

Int128 determinant(const Point& a, const Point& b, const Point& c)
{
  const auto minor = [&](std::size_t i, std::size_t j)
  { return static_cast<Int128>(b[i]) * c[j] - static_cast<Int128>(b[j]) * c[i]; };
  return a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1);
}

/// How often a point in a box from the origin has crossed it, by Cramer's rule.
Point crossings(const Vectors& v, const Point& x)
{
  const Int128 volume = determinant(v[0], v[1], v[2]);
  return { static_cast<std::int64_t>(floor_quotient(determinant(x, v[1], v[2]), volume)),
    static_cast<std::int64_t>(floor_quotient(determinant(v[0], x, v[2]), volume)),
    static_cast<std::int64_t>(floor_quotient(determinant(v[0], v[1], x), volume)) };
}

Vector3 scaled(const Point& x, int power)
{
  return { std::ldexp(static_cast<double>(x[0]), power),
    std::ldexp(static_cast<double>(x[1]), power), std::ldexp(static_cast<double>(x[2]), power) };
}

/// Vectors and points in units of 2^power, at an origin that moves both.
Box box_of(const Vectors& v, bool general, int power, const Vector3& origin)
{
  Box box =
    Box::from_vectors(origin, { scaled(v[0], power), scaled(v[1], power), scaled(v[2], power) });
  box.general = general;
  box.boundary = "pp pp pp";
  return box;
}

/// Random vectors of integers; those that are not general form an upper triangle. Some are flat within 1e-6.
Vectors random_vectors(bool general, std::int64_t most, std::mt19937_64& random)
{
  const auto any = [&] {
    return static_cast<std::int64_t>(random() % (2 * static_cast<std::uint64_t>(most) + 1)) - most;
  };
  const auto length = [&]
  { return 1 + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(most)); };
  Vectors v;
  do
  {
    v = general
      ? Vectors{ { { any(), any(), any() }, { any(), any(), any() }, { any(), any(), any() } } }
      : Vectors{ { { length(), 0, 0 }, { any(), length(), 0 }, { any(), any(), length() } } };
  } while (determinant(v[0], v[1], v[2]) == 0);
  return v;
}

/// Compares the crossings of points.
void expect_crossings(const Vectors& v, bool general, int power, const std::vector<Point>& points)
{
  std::vector<double> coordinates;
  for (const Point& x : points)
  {
    const Vector3 point = scaled(x, power);
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
  std::vector<double> images;
  count_crossings(box_of(v, general, power, {}), coordinates, images);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Point expected = crossings(v, points[i]);
    const Vector3 found = { images[3 * i], images[3 * i + 1], images[3 * i + 2] };
    const Vector3 counts = scaled(expected, 0);
    ASSERT_EQ(found, counts) << i;
  }
}
}

/// Small integers: many points lie on faces, at thirds and sevenths of the others.
TEST(PeriodicWrap, CrossingsOfTiltedBoxesOnFaces)
{
  std::mt19937_64 random(5);
  for (int turn = 0; turn < 400; ++turn)
  {
    const bool general = turn % 2 == 0;
    std::vector<Point> points(300);
    for (Point& x : points)
    {
      std::ranges::generate(x, [&] { return static_cast<std::int64_t>(random() % 101) - 50; });
    }
    expect_crossings(random_vectors(general, 7, random), general, 0, points);
  }
}

/// Vectors of 22 bits, points of 50 within some last bits of a face, up to 2^20 periods away.
TEST(PeriodicWrap, CrossingsOfTiltedBoxesBesideFaces)
{
  std::mt19937_64 random(6);
  for (int turn = 0; turn < 400; ++turn)
  {
    const bool general = turn % 2 == 0;
    Vectors v = random_vectors(general, std::int64_t{ 1 } << 22, random);
    std::vector<Point> points(300);
    const std::int64_t far = std::int64_t{ 1 } << (random() % 21);
    for (Point& x : points)
    {
      for (const auto& vector : v)
      {
        const std::int64_t times =
          static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * far)) - far;
        // whole numbers of vectors, and 2^-6 of them
        const std::int64_t part = random() % 2 == 0 ? 0 : static_cast<std::int64_t>(random() % 64);
        for (std::size_t k = 0; k < 3; ++k)
        {
          x[k] += (64 * times + part) * vector[k];
        }
      }
      std::ranges::for_each(
        x, [&](std::int64_t& k) { k += static_cast<std::int64_t>(random() % 5) - 2; });
    }
    for (auto& vector : v)
    {
      std::ranges::for_each(vector, [](std::int64_t& k) { k *= 64; });
    }
    expect_crossings(v, general, -40, points);
  }
}
