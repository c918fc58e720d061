// SPDX-License-Identifier: BSD-3-Clause
// Kernels against mpmath (make_kernels.py) and against their definitions with 113 bits.
#include "exact_kernel.h"
#include "kernel_reference.h"

#include "granular/averages/smooth_cells.h"

#include "../support/error_of.h"
#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>

using namespace granular;

namespace
{
constexpr KernelShape shapes[] = { KernelShape::Gaussian, KernelShape::Lucy,
  KernelShape::Heaviside };
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Vector3 times_power(const Vector3& vector, int power)
{
  return { std::ldexp(vector[0], power), std::ldexp(vector[1], power),
    std::ldexp(vector[2], power) };
}

Vector3 turned_round(const Vector3& vector)
{
  return { -vector[0], -vector[1], -vector[2] };
}

/// a - b, and whether no bit of it is lost.
bool subtract(const Vector3& a, const Vector3& b, Vector3& difference)
{
  bool exact = true;
  for (std::size_t k = 0; k < 3; ++k)
  {
    difference[k] = a[k] - b[k];
    exact = exact && Quad(difference[k]) == Quad(a[k]) - Quad(b[k]);
  }
  return exact;
}

std::string error_of(double width)
{
  return ::error_of([&] { check_width(width); });
}
}

TEST(Kernel, MeansOverLinesAreThoseOfMpmath)
{
  HardCase hard("kernels",
    "means over lines that touch or graze the support, 1e-324 to 1e6 widths long: error", "1",
    1e-14);
  for (const LineCase& one : read_reference().lines)
  {
    const double mean = Kernel(one.shape, one.width).line_mean(one.point, one.branch);
    EXPECT_NEAR(mean, one.mean, 1e-14);
    hard.add(std::abs(mean - one.mean));
  }
}

/// Where the exact mean is 0 or 1 there is nothing to round.
TEST(Kernel, LinesThatOnlyTouchTheSupportHaveNoPart)
{
  int outside = 0;
  int whole = 0;
  for (const LineCase& one : read_reference().lines)
  {
    const double mean = Kernel(one.shape, one.width).line_mean(one.point, one.branch);
    if (one.mean == 0)
    {
      ++outside;
      EXPECT_EQ(mean, 0) << std::hexfloat << one.width << " " << one.point[0] << " " << one.point[1]
                         << " " << one.point[2];
    }
    if (one.mean == 1 && one.shape == KernelShape::Heaviside)
    {
      ++whole;
      EXPECT_EQ(mean, 1);
    }
  }
  EXPECT_GT(outside, 100);
  EXPECT_GT(whole, 100);
}

TEST(Kernel, IntegralsOverSpaceAreThoseOfMpmath)
{
  HardCase hard(
    "kernels", "integral over all space, widths of 1e-6 to 1e3: relative error", "1", 1e-14);
  for (const NormCase& one : read_reference().norms)
  {
    const double volume = Kernel(one.shape, one.width).volume();
    EXPECT_NEAR(volume / one.volume, 1, 1e-14);
    hard.add(std::abs(volume / one.volume - 1));
  }
}

TEST(Kernel, AgreesWithQuadratureOnLinesOfAnyLength)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const KernelShape shape : shapes)
  {
    for (int i = 0; i < 1000; ++i)
    {
      const double width = std::pow(10, 3 * unit(random));
      const double power = unit(random);
      const double length = width * std::pow(10, 16 * power * std::abs(power));
      const Vector3 branch = { length * unit(random), length * unit(random),
        length * unit(random) };
      const double part = 0.6 * unit(random) + 0.5; // where it passes
      Vector3 point;
      for (std::size_t k = 0; k < 3; ++k)
      {
        point[k] = part * branch[k] + static_cast<double>(3 - k) * width * unit(random);
      }
      const Quad exact = exact_line_mean(shape, width, to_quad(point), to_quad(branch));
      EXPECT_NEAR(Kernel(shape, width).line_mean(point, branch), static_cast<double>(exact), 1e-14)
        << length / width;
    }
  }
}

TEST(Kernel, MeansDoNotDependOnTheDirectionOfALine)
{
  int reversed = 0;
  for (const LineCase& one : read_reference().lines)
  {
    const Kernel kernel(one.shape, one.width);
    const double mean = kernel.line_mean(one.point, one.branch);
    // seen in a mirror: to the bit
    EXPECT_EQ(kernel.line_mean(turned_round(one.point), turned_round(one.branch)), mean);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Vector3 point = one.point;
      Vector3 branch = one.branch;
      point[axis] = -point[axis];
      branch[axis] = -branch[axis];
      EXPECT_EQ(kernel.line_mean(point, branch), mean);
    }
    // from the other end, where that is a double
    Vector3 other;
    if (subtract(one.point, one.branch, other))
    {
      ++reversed;
      EXPECT_NEAR(kernel.line_mean(other, turned_round(one.branch)), mean, 1e-14);
    }
  }
  EXPECT_GT(reversed, 600);
}

/// Units of length do not matter, down to the last bit if they differ by a power of two, up to both ends of the range of widths:
/// what is squared and multiplied on the way stays a number with all of its digits.
TEST(Kernel, ScalingByPowersOfTwoIsExact)
{
  int scaled = 0;
  for (const LineCase& one : read_reference().lines)
  {
    const double mean = Kernel(one.shape, one.width).line_mean(one.point, one.branch);
    const int width = std::ilogb(one.width);
    for (const int power :
      { -150, -1, 1, 20, 150, std::ilogb(1e-60) - width + 1, std::ilogb(1e60) - width - 1 })
    {
      const Vector3 point = times_power(one.point, power);
      const Vector3 branch = times_power(one.branch, power);
      if (times_power(point, -power) == one.point && times_power(branch, -power) == one.branch)
      {
        ++scaled;
        const Kernel kernel(one.shape, std::ldexp(one.width, power));
        EXPECT_EQ(error_of(kernel.width()), "");
        EXPECT_EQ(kernel.line_mean(point, branch), mean) << power << " " << one.width;
      }
    }
  }
  EXPECT_GT(scaled, 12500);
}

TEST(Kernel, ValuesAreThoseOfTheDefinitions)
{
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const KernelShape shape : shapes)
  {
    for (const double width : { 1e-6, 0.37, 1.0, 2.5e3 })
    {
      const Kernel kernel(shape, width);
      EXPECT_EQ(kernel.shape(), shape);
      EXPECT_EQ(kernel.width(), width);
      EXPECT_EQ(kernel.support(), widths_of_support(shape) * width);
      EXPECT_EQ(kernel.value(0), 1);
      for (int i = 0; i < 2000; ++i)
      {
        const double r = 1.1 * kernel.support() * unit(random);
        const Quad exact = exact_value(shape, width, Quad(r * r));
        EXPECT_NEAR(kernel.value(r * r), static_cast<double>(exact), 1e-15) << r / width;
      }
      const double edge = kernel.support() * kernel.support();
      for (const double square : { edge * (1 + 1e-15), 2 * edge, 1e300, infinity, not_a_number })
      {
        EXPECT_EQ(kernel.value(square), 0) << square;
      }
      const double inside = kernel.value(edge * (1 - 1e-15));
      EXPECT_NEAR(
        inside, static_cast<double>(exact_value(shape, width, Quad(edge) * (1 - 1e-15))), 1e-15);
      EXPECT_EQ(inside == 0, false) << static_cast<int>(shape);
    }
  }
}

TEST(Kernel, PointsHaveTheValueAtTheirPlace)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const KernelShape shape : shapes)
  {
    const Kernel kernel(shape, 0.25);
    for (int i = 0; i < 500; ++i)
    {
      const Vector3 point = { unit(random), unit(random) / 2, unit(random) / 4 };
      EXPECT_EQ(kernel.line_mean(point, {}), kernel.value(dot(point, point)));
      // a line that is much shorter than the width has nearly the same
      EXPECT_NEAR(
        kernel.line_mean(point, { 0, 1e-300, 0 }), kernel.value(dot(point, point)), 1e-15);
    }
  }
}

/// Far away, long, or both: the mean is a number, at most 1, and not more than the part of the line that the support is.
TEST(Kernel, AnyFiniteNumbersGiveANumber)
{
  std::mt19937_64 random(4);
  std::uniform_int_distribution<int> power(-1074, 1023);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] { return std::ldexp(unit(random), power(random)); };
  for (int i = 0; i < 100000; ++i)
  {
    const KernelShape shape = shapes[i % 3];
    const Kernel kernel(shape, std::pow(10, 60 * unit(random)));
    const Vector3 point = { any(), any(), any() };
    const Vector3 branch = { any(), any(), any() };
    const double mean = kernel.line_mean(point, branch);
    ASSERT_TRUE(mean >= 0 && mean <= 1) << mean;
    const double longest =
      std::max({ std::abs(branch[0]), std::abs(branch[1]), std::abs(branch[2]) });
    ASSERT_LE(mean, 2 * kernel.support() / longest + 1e-14);
  }
}

TEST(Kernel, WidthsThatAreNoneAreErrors)
{
  const std::pair<double, const char*> wrong[] = { { 0, "0" }, { -0.0, "-0" }, { -0.01, "-0.01" },
    { 1e-61, "1e-61" }, { 5e-324, "5e-324" }, { 1e61, "1e+61" }, { infinity, "inf" },
    { -infinity, "-inf" }, { not_a_number, "nan" } };
  for (const auto& [width, text] : wrong)
  {
    EXPECT_EQ(
      error_of(width), std::string("expected a KernelWidth from 1e-60 to 1e60, got ") + text);
  }
  for (const double width : { 1e-60, 1e-9, 0.001, 1.0, 1e9, 1e60 })
  {
    EXPECT_EQ(error_of(width), "");
  }
}
