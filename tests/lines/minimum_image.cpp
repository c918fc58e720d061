// SPDX-License-Identifier: BSD-3-Clause
// The shortest image of a vector, held against all images near it, in 113 bits and in integers.
#include "granular/lines/minimum_image.h"

#include "../support/hard_case.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace
{
using granular::Box;
using granular::BoxCounts;
using granular::MinimumImage;
using granular::Vector3;
using Quad3 = std::array<Quad, 3>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Box with_boundary(Box box, const std::string& boundary)
{
  box.boundary = boundary;
  return box;
}

/// The vectors that are to be periodic have a length.
std::array<bool, 3> axes_of(const Box& box)
{
  return { box.boundary[0] == 'p', box.boundary[3] == 'p', box.boundary[6] == 'p' };
}

Quad square(const Quad3& v)
{
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/// The vector and that many box vectors.
Quad3 image_of(const Box& box, const Vector3& vector, const BoxCounts& counts)
{
  Quad3 image;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    image[axis] = vector[axis];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const granular::Twofold& v = box.vectors[i][axis];
      image[axis] +=
        static_cast<Quad>(counts[i]) * (static_cast<Quad>(v.hi) + static_cast<Quad>(v.lo));
    }
  }
  return image;
}

/// The square of the shortest of all images that are no more than `reach` vectors along each axis from a start.
Quad shortest_near(const Box& box, const Vector3& vector, const BoxCounts& start, int reach)
{
  const std::array<bool, 3> periodic = axes_of(box);
  const Quad3 first = image_of(box, vector, start);
  Quad shortest = square(first);
  std::array<Quad3, 3> vectors;
  for (std::size_t i = 0; i < 3; ++i)
  {
    BoxCounts one = {};
    one[i] = 1;
    vectors[i] = image_of(box, {}, one);
  }
  const std::array<int, 3> far = { periodic[0] ? reach : 0, periodic[1] ? reach : 0,
    periodic[2] ? reach : 0 };
  for (int c = -far[2]; c <= far[2]; ++c)
  {
    for (int b = -far[1]; b <= far[1]; ++b)
    {
      for (int a = -far[0]; a <= far[0]; ++a)
      {
        Quad3 image = first;
        for (std::size_t k = 0; k < 3; ++k)
        {
          image[k] += a * vectors[0][k] + b * vectors[1][k] + c * vectors[2][k];
        }
        shortest = std::min(shortest, square(image));
      }
    }
  }
  return shortest;
}

std::string to_text(const Box& box, const Vector3& vector, const BoxCounts& counts)
{
  std::ostringstream out;
  out.precision(17);
  for (const granular::Twofold3& v : box.vectors)
  {
    out << "{ " << v[0].value() << ", " << v[1].value() << ", " << v[2].value() << " } ";
  }
  out << box.boundary << " vector " << vector[0] << ' ' << vector[1] << ' ' << vector[2]
      << " counts " << counts[0] << ' ' << counts[1] << ' ' << counts[2];
  return out.str();
}

/// No image within reach is shorter than what is found, but for the rounding of the vector.
/// Returns how much longer it is than the shortest, in units of that rounding.
double expect_shortest(const Box& box, const MinimumImage& images, const Vector3& vector, int reach)
{
  const BoxCounts counts = images.find(vector);
  const std::array<bool, 3> periodic = axes_of(box);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    EXPECT_TRUE(periodic[axis] || counts[axis] == 0);
  }
  const double found = std::sqrt(static_cast<double>(square(image_of(box, vector, counts))));
  const double best = std::sqrt(static_cast<double>(shortest_near(box, vector, counts, reach)));
  const double size = std::hypot(vector[0], vector[1], vector[2]);
  EXPECT_LE(found, best * (1 + 0x1p-50) + size * 0x1p-46)
    << to_text(box, vector, counts) << ": found " << found << ", there is " << best;
  return (found - best) / (best * 0x1p-50 + size * 0x1p-46);
}

class Numbers
{
public:
  double between(double lo, double hi)
  {
    return std::uniform_real_distribution<double>(lo, hi)(engine_);
  }
  int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  double magnitude(double lo, double hi)
  {
    return std::exp(this->between(std::log(lo), std::log(hi)));
  }
  Vector3 vector(double size)
  {
    return { this->between(-size, size), this->between(-size, size), this->between(-size, size) };
  }

private:
  std::mt19937 engine_{ 20240607 };
};

constexpr const char* all_boundaries[] = { "pp pp pp", "pp pp ff", "pp ff pp", "ff pp pp",
  "pp ff ff", "ff pp mm", "ss ff pp" };

// ---- boxes along the axes ----------------------------------------------------------------------

TEST(MinimumImage, AlongTheAxes)
{
  const Box box = with_boundary(Box::from_bounds({ -5, 0, 1 }, { 5, 4, 3 }), "pp pp ff");
  const MinimumImage images(box);
  EXPECT_TRUE(images.is_periodic());
  EXPECT_EQ(images.find({ 1, 1, 1 }), (BoxCounts{ 0, 0, 0 }));
  EXPECT_EQ(images.find({ 9, 3, 100 }), (BoxCounts{ -1, -1, 0 }));
  EXPECT_EQ(images.find({ -9, -3, -100 }), (BoxCounts{ 1, 1, 0 }));
  EXPECT_EQ(images.find({ 1e7, 5.5, 0 }), (BoxCounts{ -1000000, -1, 0 }));
  EXPECT_EQ(images.shift({ -1, 2, 0 }), (Vector3{ -10, 8, 0 }));
}

TEST(MinimumImage, HalfABoxStaysAsWritten)
{
  const MinimumImage tenth(
    with_boundary(Box::from_bounds({ 0, 0, 0 }, { 0.3, 0.3, 0.3 }), "pp pp pp"));
  EXPECT_EQ(tenth.find({ 0.15, -0.15, 0.25 - 0.1 }), (BoxCounts{ 0, 0, 0 }));
  EXPECT_EQ(tenth.find({ 0.15 + 1e-12, -0.15 - 1e-12, 0.45 }), (BoxCounts{ -1, 1, -1 }));
  const MinimumImage tilted(
    with_boundary(Box::from_tilted_bounds({ 0, 0, 0 }, { 14, 10, 10 }, 4, 0, 0), "pp pp pp"));
  EXPECT_EQ(tilted.find({ 5, 0, 0 }), (BoxCounts{ 0, 0, 0 }));
  EXPECT_EQ(tilted.find({ -5, 0, 5 }), (BoxCounts{ 0, 0, 0 }));
  EXPECT_EQ(tilted.find({ 2, 5, -5 }), (BoxCounts{ 0, 0, 0 }));
  EXPECT_EQ(tilted.find({ 15, 0, 15 }), (BoxCounts{ -1, 0, -1 }));
}

TEST(MinimumImage, NothingIsPeriodic)
{
  const Box bounds = Box::from_bounds({ 0, 0, 0 }, { 1, 1, 1 });
  for (const char* boundary : { "", "ff ff ff", "mm ss ff" })
  {
    const MinimumImage images(with_boundary(bounds, boundary));
    EXPECT_FALSE(images.is_periodic()) << boundary;
    EXPECT_EQ(images.find({ 0.9, 17, -4 }), BoxCounts{}) << boundary;
  }
}

TEST(MinimumImage, AxesWithoutLengthAreNotPeriodic)
{
  const MinimumImage flat(with_boundary(Box::from_bounds({ 0, 0, 5 }, { 1, 1, 5 }), "pp pp pp"));
  EXPECT_TRUE(flat.is_periodic());
  EXPECT_EQ(flat.find({ 0.9, -0.9, 7 }), (BoxCounts{ -1, 1, 0 }));
  for (const double length : { infinity, nan })
  {
    const MinimumImage images(
      with_boundary(Box::from_bounds({ 0, 0, 0 }, { 1, length, 1 }), "pp pp pp"));
    EXPECT_EQ(images.find({ 0.9, 1e9, -0.9 }), (BoxCounts{ -1, 0, 1 }));
  }
  const MinimumImage none(with_boundary(Box::from_bounds({ 1, 1, 1 }, { 1, 1, 1 }), "pp pp pp"));
  EXPECT_FALSE(none.is_periodic());
  const MinimumImage general(with_boundary(
    Box::from_vectors({}, { Vector3{ 1, 0, 0 }, Vector3{ nan, 1, 0 }, Vector3{ 0, 0.5, 1 } }),
    "pp pp pp"));
  EXPECT_EQ(general.find({ 0.9, 0.5, 1 }), (BoxCounts{ -1, 0, -1 }));
}

TEST(MinimumImage, NoNumbersHaveNoImages)
{
  const Box straight = with_boundary(Box::from_bounds({ 0, 0, 0 }, { 1, 1, 1 }), "pp pp pp");
  const Box tilted =
    with_boundary(Box::from_tilted_bounds({ 0, 0, 0 }, { 1, 1, 1 }, 0.3, 0.2, 0.1), "pp pp pp");
  for (const Box& box : { straight, tilted })
  {
    const MinimumImage images(box);
    for (const double odd : { nan, infinity, -infinity, 1e300 })
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        Vector3 vector = { 0.1, 0.2, 0.3 };
        vector[axis] = odd;
        EXPECT_EQ(images.find(vector), BoxCounts{}) << odd;
      }
    }
  }
}

// ---- tilted boxes ------------------------------------------------------------------------------

TEST(MinimumImage, TiltedByHalfTheBoxAndMore)
{
  // b reduced by a is (-1, 10, 0): the rounding of scaled coordinates alone would miss it
  const Box box =
    with_boundary(Box::from_tilted_bounds({ 0, 0, 0 }, { 39, 10, 10 }, 29, 0, 0), "pp pp pp");
  const MinimumImage images(box);
  EXPECT_EQ(images.find({ 29, 10, 0 }), (BoxCounts{ 0, -1, 0 }));
  EXPECT_EQ(images.find({ -1, 10, 0 }), (BoxCounts{ 3, -1, 0 }));
  EXPECT_EQ(images.shift({ 3, -1, 0 }), (Vector3{ 1, -10, 0 }));
}

TEST(MinimumImage, ShortestInRandomTiltedBoxes)
{
  HardCase hard("minimum image",
    "tilts of up to 6 box lengths, vectors of up to 1e13: excess over the shortest of 17^3 images, "
    "by its rounding",
    "bounds", 1);
  Numbers numbers;
  for (int run = 0; run < 700; ++run)
  {
    const Vector3 size = { numbers.between(0.5, 2), numbers.between(0.5, 2),
      numbers.between(0.5, 2) };
    const double tilt = run % 3 == 0 ? 0.5 : 3;
    const Vector3 tilts = numbers.vector(tilt);
    const Vector3 lo = numbers.vector(10);
    const Vector3 hi = { lo[0] + size[0] + std::abs(tilts[0]) + std::abs(tilts[1]),
      lo[1] + size[1] + std::abs(tilts[2]), lo[2] + size[2] };
    const Box box = with_boundary(
      Box::from_tilted_bounds(lo, hi, tilts[0], tilts[1], tilts[2]), all_boundaries[run % 7]);
    const MinimumImage images(box);
    for (const double scale : { 0.5, 2., 30., 1e6, 1e13 })
    {
      hard.add(expect_shortest(box, images, numbers.vector(scale), run % 50 == 0 ? 20 : 8));
    }
  }
}

TEST(MinimumImage, ShortestInRandomGeneralBoxes)
{
  Numbers numbers;
  for (int run = 0; run < 70; ++run)
  {
    const Box box = with_boundary(
      Box::from_vectors({}, { numbers.vector(1), numbers.vector(1), numbers.vector(1) }),
      all_boundaries[run % 7]);
    const MinimumImage images(box);
    for (const double scale : { 1., 20., 1e6, 1e11 })
    {
      expect_shortest(box, images, numbers.vector(scale), 9);
    }
  }
}

/// Any basis of a lattice gives the same images, also one whose vectors are long and nearly parallel.
TEST(MinimumImage, AnyBasisOfALattice)
{
  Numbers numbers;
  for (int run = 0; run < 300; ++run)
  {
    const std::array<Vector3, 3> plain = { Vector3{ 1, 0.25, 0 }, Vector3{ -0.375, 1.25, 0.5 },
      Vector3{ 0.125, -0.5, 0.875 } };
    std::array<Vector3, 3> mixed = plain; // multiples of 1/8: all sums are exact
    for (int step = 0; step < 12; ++step)
    {
      const auto i = static_cast<std::size_t>(numbers.integer(0, 2));
      const std::size_t j = (i + static_cast<std::size_t>(numbers.integer(1, 2))) % 3;
      const int times = numbers.integer(-4, 4);
      for (std::size_t k = 0; k < 3; ++k)
      {
        mixed[i][k] += times * mixed[j][k];
      }
    }
    const Box box = with_boundary(Box::from_vectors({}, plain), "pp pp pp");
    const Box skewed = with_boundary(Box::from_vectors({}, mixed), "pp pp pp");
    const MinimumImage images(box);
    const MinimumImage skewed_images(skewed);
    for (int i = 0; i < 20; ++i)
    {
      const Vector3 vector = numbers.vector(i % 2 == 0 ? 1 : 1000);
      const Quad expected = square(image_of(box, vector, images.find(vector)));
      const Quad found = square(image_of(skewed, vector, skewed_images.find(vector)));
      EXPECT_NEAR(static_cast<double>(found), static_cast<double>(expected), 1e-10)
        << to_text(skewed, vector, skewed_images.find(vector));
    }
  }
}

TEST(MinimumImage, FlatAndNeedleBoxes)
{
  Numbers numbers;
  for (int run = 0; run < 400; ++run)
  {
    const double thin = numbers.magnitude(1e-9, 1);
    const double thick = numbers.magnitude(1e-9, 1);
    // tilts of a few of the vectors they are along, whose images are then within reach
    const double xy = numbers.between(-3, 3) * thin;
    const double xz = numbers.between(-3, 3) * thin;
    const double yz = numbers.between(-3, 3) * thick;
    const Box box =
      with_boundary(Box::from_vectors({ 1, 2, 3 },
                      { Vector3{ thin, 0, 0 }, Vector3{ xy, thick, 0 }, Vector3{ xz, yz, 1 } }),
        all_boundaries[run % 7]);
    const MinimumImage images(box);
    for (const double scale : { 1., 3. })
    {
      Vector3 vector = numbers.vector(scale);
      vector[0] *= thin;
      vector[1] *= thick;
      expect_shortest(box, images, vector, 8);
    }
    const Vector3 far = numbers.vector(1e3);
    expect_shortest(box, images, far, 8);
  }
}

/// A needle that is tilted by many times its width: each image in its own direction is the shortest, too.
TEST(MinimumImage, TiltedNeedle)
{
  const Box box =
    with_boundary(Box::from_vectors(
                    {}, { Vector3{ 1e-9, 0, 0 }, Vector3{ 0.3, 1, 0 }, Vector3{ 0.1, 0.2, 1e-9 } }),
      "pp pp pp");
  const MinimumImage images(box);
  Numbers numbers;
  for (int i = 0; i < 200; ++i)
  {
    const Vector3 vector = { numbers.between(-1, 1), numbers.between(-0.4, 0.4), 0 };
    const Quad3 image = image_of(box, vector, images.find(vector));
    EXPECT_LE(std::abs(static_cast<double>(image[0])), 0.51e-9)
      << to_text(box, vector, images.find(vector));
    expect_shortest(box, images, vector, 8);
  }
}

/// None of the vectors is made shorter by another one, but all three together are short.
TEST(MinimumImage, ThreeVectorsNearlyInAPlane)
{
  Numbers numbers;
  for (const double height : { 0.1, 1e-3, 1e-6 })
  {
    const double y = std::sqrt(0.75);
    const Box box = with_boundary(
      Box::from_vectors(
        {}, { Vector3{ 1, 0, height }, Vector3{ -0.5, y, height }, Vector3{ -0.5, -y, height } }),
      "pp pp pp");
    const MinimumImage images(box);
    EXPECT_TRUE(images.is_periodic());
    EXPECT_EQ(images.find({ height / 2, 0, 2.9 * height }), (BoxCounts{ -1, -1, -1 }));
    for (int i = 0; i < 100; ++i)
    {
      expect_shortest(box, images, numbers.vector(i % 2 == 0 ? 1 : 1e4), 8);
    }
  }
}

TEST(MinimumImage, BoxesInAPlane)
{
  // two vectors along one line have a common measure
  const Box line = with_boundary(
    Box::from_vectors({}, { Vector3{ 4, 0, 0 }, Vector3{ 6, 0, 0 }, Vector3{ 0, 1, 1 } }),
    "pp pp ff");
  const MinimumImage on_line(line);
  EXPECT_EQ(on_line.shift(on_line.find({ 11.5, 7, 0 })), (Vector3{ -12, 0, 0 }));
  EXPECT_EQ(on_line.shift(on_line.find({ 3, 7, 0 })), (Vector3{ -2, 0, 0 }));
  // or they have none
  const Box dense =
    with_boundary(Box::from_vectors(
                    {}, { Vector3{ 1, 0, 0 }, Vector3{ std::sqrt(2), 0, 0 }, Vector3{ 0, 1, 1 } }),
      "pp pp pp");
  EXPECT_FALSE(MinimumImage(dense).is_periodic());
  EXPECT_EQ(MinimumImage(dense).find({ 11.5, 7, 0 }), BoxCounts{});
}

// ---- in integers: which of the images that are as short ----------------------------------------

using Integer3 = std::array<int, 3>;

int length_of(const Integer3& v)
{
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/// The rule of the header: the smallest sum of counts, then of the last axes; positive before negative.
std::tuple<int, int, int, int, Integer3> rank_of(const Integer3& counts)
{
  const auto [a, b, c] = counts;
  return { std::abs(a) + std::abs(b) + std::abs(c), std::abs(c), std::abs(b), std::abs(a),
    { -a, -b, -c } };
}

/// Vectors and boxes are whole numbers: all images within reach are compared without rounding.
TEST(MinimumImage, SmallestCountsOfTies)
{
  const std::array<std::array<Integer3, 3>, 9> lattices = { {
    { { { 4, 0, 0 }, { 2, 4, 0 }, { 0, 0, 4 } } },  // its tilt is half of it
    { { { 2, 2, 0 }, { 2, -2, 0 }, { 2, 0, 2 } } }, // face centred
    { { { 2, 2, 0 }, { 0, 2, 2 }, { 2, 0, 2 } } },
    { { { 2, 2, 0 }, { 2, -2, 0 }, { 2, 0, -2 } } },
    { { { 2, 2, -2 }, { 2, -2, 2 }, { -2, 2, 2 } } }, // body centred
    { { { 4, 0, 0 }, { 0, 4, 0 }, { 2, 2, 2 } } },
    { { { 4, 0, 0 }, { 0, 4, 0 }, { 2, 2, 4 } } },
    { { { 2, -2, 0 }, { 0, 2, -2 }, { 4, 4, 4 } } }, // hexagonal
    { { { 4, 0, 0 }, { -2, 6, 0 }, { 2, 4, 4 } } },
  } };
  for (const std::array<Integer3, 3>& lattice : lattices)
  {
    std::array<Vector3, 3> vectors;
    for (std::size_t i = 0; i < 3; ++i)
    {
      vectors[i] = { 1. * lattice[i][0], 1. * lattice[i][1], 1. * lattice[i][2] };
    }
    const Box box = with_boundary(Box::from_vectors({}, vectors), "pp pp pp");
    const MinimumImage images(box);
    constexpr int size = 11;
    for (int number = 0; number < size * size * size; ++number)
    {
      const Integer3 vector = { number % size - 5, number / size % size - 5,
        number / size / size - 5 };
      Integer3 best = {};
      Integer3 best_counts = {};
      best = vector;
      for (int other = 0; other < 17 * 17 * 17; ++other)
      {
        const Integer3 counts = { other % 17 - 8, other / 17 % 17 - 8, other / 289 - 8 };
        Integer3 image = vector;
        for (std::size_t k = 0; k < 3; ++k)
        {
          image[k] +=
            counts[0] * lattice[0][k] + counts[1] * lattice[1][k] + counts[2] * lattice[2][k];
        }
        const int difference = length_of(image) - length_of(best);
        if (difference < 0 || (difference == 0 && rank_of(counts) < rank_of(best_counts)))
        {
          best = image;
          best_counts = counts;
        }
      }
      const Vector3 asked = { 1. * vector[0], 1. * vector[1], 1. * vector[2] };
      const BoxCounts found = images.find(asked);
      EXPECT_EQ(found, (BoxCounts{ best_counts[0], best_counts[1], best_counts[2] }))
        << to_text(box, asked, found) << ", expected " << best_counts[0] << ' ' << best_counts[1]
        << ' ' << best_counts[2];
    }
  }
}

// ---- rounding ----------------------------------------------------------------------------------

TEST(MinimumImage, ShiftsAreRoundedOnce)
{
  HardCase hard("minimum image", "sums of up to 10^6 box vectors of tilted boxes, 1e9 away: error",
    "ulp", 0.51);
  Numbers numbers;
  for (int run = 0; run < 2000; ++run)
  {
    const double far = numbers.magnitude(1, 1e9);
    const Box box = with_boundary(
      Box::from_tilted_bounds({ far, far, far },
        { far + numbers.between(3, 4), far + numbers.between(3, 4), far + numbers.between(1, 2) },
        numbers.between(-1, 1), numbers.between(-1, 1), numbers.between(-1, 1)),
      "pp pp pp");
    const MinimumImage images(box);
    const BoxCounts counts = { numbers.integer(-1000000, 1000000),
      numbers.integer(-1000000, 1000000), numbers.integer(-1000000, 1000000) };
    const Vector3 shift = images.shift(counts);
    const Quad3 exact = image_of(box, {}, counts);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_LE(static_cast<double>(absolute(static_cast<Quad>(shift[axis]) - exact[axis])),
        0.501 * ulp(exact[axis]) + 1e6 * 4 * 0x1p-100);
      hard.add(static_cast<double>(absolute(static_cast<Quad>(shift[axis]) - exact[axis])) /
        ulp(exact[axis]));
    }
  }
}
}
