// SPDX-License-Identifier: BSD-3-Clause
// Principal values, held against known spectra, and in 113 bits against Sylvester's law of inertia, which asks for no
// eigenvalues; equivalent stresses, held against the formula in 113 bits.
#include "granular/contacts/contact_sums.h"

#include "../support/hard_case.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace
{
using granular::principal_values;
using granular::SymmetricTensor;
using granular::Vector3;
using granular::von_mises;
using Quad3 = std::array<Quad, 3>;
using QuadTensor = std::array<Quad, 6>; // xx yy zz xy xz yz

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

double largest_of(const SymmetricTensor& tensor)
{
  double largest = 0;
  for (const double value : tensor)
  {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// How many principal values are above a bound: the positive pivots of the tensor minus the bound.
int count_above(const SymmetricTensor& tensor, Quad bound)
{
  const Quad tiny = static_cast<Quad>(largest_of(tensor)) * static_cast<Quad>(0x1p-108);
  const auto nonzero = [&](Quad pivot) { return absolute(pivot) < tiny ? tiny : pivot; };
  const Quad xy = tensor[3];
  const Quad xz = tensor[4];
  const Quad first = nonzero(static_cast<Quad>(tensor[0]) - bound);
  const Quad yy = static_cast<Quad>(tensor[1]) - bound - xy * xy / first;
  const Quad yz = static_cast<Quad>(tensor[5]) - xy * xz / first;
  const Quad second = nonzero(yy);
  const Quad third =
    nonzero(static_cast<Quad>(tensor[2]) - bound - xz * xz / first - yz * yz / second);
  return (first > 0 ? 1 : 0) + (second > 0 ? 1 : 0) + (third > 0 ? 1 : 0);
}

/// The i-th largest principal value, by halving.
Quad true_value(const SymmetricTensor& tensor, int i)
{
  Quad high = 4 * static_cast<Quad>(largest_of(tensor));
  Quad low = -high;
  for (int step = 0; step < 90; ++step)
  {
    const Quad middle = (low + high) / 2;
    (count_above(tensor, middle) > i ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// The largest error, in ulps of the value that is largest in magnitude.
double error_of(const SymmetricTensor& tensor)
{
  const Vector3 found = principal_values(tensor);
  EXPECT_TRUE(std::ranges::is_sorted(found, std::greater<>()));
  Quad3 expected;
  Quad largest = 0;
  for (int i = 0; i < 3; ++i)
  {
    expected[static_cast<std::size_t>(i)] = true_value(tensor, i);
    largest = std::max(largest, absolute(expected[static_cast<std::size_t>(i)]));
  }
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Quad error = absolute(static_cast<Quad>(found[i]) - expected[i]);
    const double error_in_ulps = static_cast<double>(error / static_cast<Quad>(ulp(largest)));
    worst = std::isnan(error_in_ulps) ? infinity : std::max(worst, error_in_ulps);
  }
  return worst;
}

double random_number(std::mt19937_64& random)
{
  return static_cast<double>(static_cast<std::int64_t>(random())) * 0x1p-63;
}

/// A diagonal tensor, turned by a quaternion of integers: its matrix is exact in fractions, and here in 113 bits.
SymmetricTensor turned(const Quad3& values, std::mt19937_64& random)
{
  std::array<Quad, 4> q;
  Quad square = 0;
  while (square == 0)
  {
    square = 0;
    for (Quad& part : q)
    {
      part = static_cast<int>(random() % 201) - 100;
      square += part * part;
    }
  }
  const auto& [w, x, y, z] = q;
  const std::array<Quad3, 3> matrix = { {
    { w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y) },
    { 2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x) },
    { 2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z },
  } };
  constexpr std::array<std::array<std::size_t, 2>, 6> places = { { { 0, 0 }, { 1, 1 }, { 2, 2 },
    { 0, 1 }, { 0, 2 }, { 1, 2 } } };
  SymmetricTensor tensor;
  for (std::size_t n = 0; n < 6; ++n)
  {
    const auto [i, j] = places[n];
    Quad sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      sum += matrix[i][k] * values[k] * matrix[j][k];
    }
    tensor[n] = static_cast<double>(sum / (square * square));
  }
  return tensor;
}

SymmetricTensor times(SymmetricTensor tensor, double factor)
{
  for (double& value : tensor)
  {
    value *= factor;
  }
  return tensor;
}

Quad root_of(Quad square)
{
  Quad root = std::sqrt(static_cast<double>(square));
  for (int i = 0; i < 3 && root != 0; ++i)
  {
    root = (root + square / root) / 2;
  }
  return root;
}

/// sqrt(3/2 s:s) with the deviator s, as it is defined.
Quad true_von_mises(const SymmetricTensor& tensor)
{
  Quad3 s = { tensor[0], tensor[1], tensor[2] };
  const Quad mean = (s[0] + s[1] + s[2]) / 3;
  Quad sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Quad shear = tensor[3 + i];
    sum += (s[i] - mean) * (s[i] - mean) + 2 * shear * shear;
  }
  return root_of(sum * 3 / 2);
}
}

TEST(PrincipalValues, RandomTensors)
{
  HardCase hard("stresses", "contacts: principal values of random tensors of any size: error",
    "ulp of the largest", 6);
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 3000; ++trial)
  {
    SymmetricTensor tensor;
    for (double& value : tensor)
    {
      // as large as each other, or not at all
      const int power = trial % 2 == 0 ? 0 : static_cast<int>(random() % 60) - 30;
      value = std::ldexp(random_number(random), power);
    }
    hard.add(error_of(times(tensor, std::ldexp(1, static_cast<int>(random() % 1000) - 500))));
  }
}

TEST(PrincipalValues, DoubleAndTripleOnes)
{
  HardCase hard("stresses",
    "contacts: principal values two or three of which are alike or nearly so: error",
    "ulp of the largest", 6);
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 3000; ++trial)
  {
    const double first = random_number(random);
    const double near = trial % 3 == 0 ? 0 : std::ldexp(first, -static_cast<int>(random() % 54));
    const double last = trial % 4 == 0 ? first : random_number(random);
    const SymmetricTensor tensor = turned({ first, static_cast<Quad>(first) + near, last }, random);
    hard.add(error_of(tensor));
  }
}

/// Rounding of the six numbers moves values by no more than their norm does.
TEST(PrincipalValues, KnownSpectra)
{
  HardCase hard("stresses",
    "contacts: principal values of turned tensors of known ones, numbers rounded to doubles: error",
    "ulp of the largest", 8);
  std::mt19937_64 random(3);
  for (const Vector3& values : { Vector3{ 3, 2, 1 }, Vector3{ 1, 0, 0 }, Vector3{ 0, 0, -1 },
         Vector3{ 1, 0, -1 }, Vector3{ -1, -1, -3 }, Vector3{ 5, 5, 5 }, Vector3{ 1e9, 1, 1e-9 },
         Vector3{ 7, 7, -7 }, Vector3{ 1e-300, 0, -1e-300 }, Vector3{ 3e300, 2e300, -1e300 } })
  {
    for (int trial = 0; trial < 200; ++trial)
    {
      const SymmetricTensor tensor = turned({ values[2], values[0], values[1] }, random);
      const Vector3 found = principal_values(tensor);
      const double unit = ulp(std::max(std::abs(values[0]), std::abs(values[2])));
      for (std::size_t i = 0; i < 3; ++i)
      {
        hard.add(std::abs(found[i] - values[i]) / unit);
      }
    }
  }
}

/// By hand; exact, as nothing has to be turned, or by a square root that is none.
TEST(PrincipalValues, ByHand)
{
  EXPECT_EQ(principal_values({}), Vector3{});
  EXPECT_EQ(principal_values({ 1, 3, 2 }), (Vector3{ 3, 2, 1 }));
  EXPECT_EQ(principal_values({ -1, -3, -2 }), (Vector3{ -1, -2, -3 }));
  EXPECT_EQ(principal_values({ 0, 0, 0, 1, 0, 0 }), (Vector3{ 1, 0, -1 }));
  EXPECT_EQ(principal_values({ 2, 2, 5, -3, 0, 0 }), (Vector3{ 5, 5, -1 }));
  // of a vector's product with itself its square and twice zero
  for (const Vector3& v :
    { Vector3{ 1, 2, 2 }, Vector3{ 2, -3, 6 }, Vector3{ 1e-160, 0, -1e-160 } })
  {
    const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const Vector3 found = principal_values(
      { v[0] * v[0], v[1] * v[1], v[2] * v[2], v[0] * v[1], v[0] * v[2], v[1] * v[2] });
    EXPECT_NEAR(found[0] / square, 1, 1e-15);
    EXPECT_NEAR(found[1] / square, 0, 1e-15);
    EXPECT_NEAR(found[2] / square, 0, 1e-15);
  }
  // shear that is far smaller than the difference of two others
  EXPECT_EQ(principal_values({ 1, 2, 3, 1e-200, -1e-200, 1e-310 }), (Vector3{ 3, 2, 1 }));
}

TEST(PrincipalValues, SmallestAndLargestNumbers)
{
  constexpr double least = std::numeric_limits<double>::denorm_min();
  constexpr double most = std::numeric_limits<double>::max();
  EXPECT_EQ(principal_values({ least, 3 * least, 0 }), (Vector3{ 3 * least, least, 0 }));
  EXPECT_EQ(principal_values({ 0, 0, 0, 8 * least, 0, 0 }), (Vector3{ 8 * least, 0, -8 * least }));
  EXPECT_EQ(principal_values({ most, -most, 0 }), (Vector3{ most, 0, -most }));
  EXPECT_EQ(principal_values({ 0, 0, 0, 0, most, 0 }), (Vector3{ most, 0, -most }));
  EXPECT_EQ(von_mises({ 0, 0, 8 * least }), 8 * least);
  EXPECT_EQ(von_mises({ 0, -most, 0 }), most);
  EXPECT_EQ(von_mises({ most, most, most }), 0);
}

TEST(PrincipalValues, NoNumbers)
{
  for (std::size_t i = 0; i < 6; ++i)
  {
    for (const double wrong : { no_number, -no_number, infinity, -infinity })
    {
      SymmetricTensor tensor = { 1, 2, 3, 4, 5, 6 };
      tensor[i] = wrong;
      for (const double value : principal_values(tensor))
      {
        EXPECT_TRUE(std::isnan(value)) << i << ' ' << wrong;
      }
      EXPECT_TRUE(std::isnan(von_mises(tensor))) << i << ' ' << wrong;
    }
  }
}

TEST(VonMises, RandomTensors)
{
  HardCase hard("stresses",
    "contacts: equivalent stress, also where pressure is up to 2^40 times as large: error", "ulp",
    3);
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 20000; ++trial)
  {
    SymmetricTensor tensor;
    // whole numbers, so that pressure can be added without rounding, or any
    const double pressure = trial % 3 == 0 ? 0 : std::ldexp(1, static_cast<int>(random() % 41));
    for (std::size_t i = 0; i < 6; ++i)
    {
      const double number = 4096 * random_number(random);
      tensor[i] = trial % 3 == 2 ? number : std::round(number) + (i < 3 ? pressure : 0);
    }
    const SymmetricTensor scaled =
      times(tensor, std::ldexp(1, static_cast<int>(random() % 1800) - 900));
    const double factor = tensor[0] != 0 ? scaled[0] / tensor[0] : 1;
    const Quad expected = true_von_mises(tensor);
    const double found = von_mises(tensor);
    hard.add(static_cast<double>(
      absolute(static_cast<Quad>(found) - expected) / static_cast<Quad>(ulp(expected))));
    if (tensor[0] != 0)
    {
      EXPECT_EQ(von_mises(scaled), found * factor); // powers of two change nothing
    }
  }
}

/// What the books say: tension, pure shear, and that pressure is no matter.
TEST(VonMises, Identities)
{
  for (const double s : { 1.0, -3.0, 1e-200, 7e200 })
  {
    EXPECT_DOUBLE_EQ(von_mises({ s, 0, 0 }), std::abs(s));
    EXPECT_DOUBLE_EQ(von_mises({ 0, 0, s }), std::abs(s));
    for (std::size_t i = 3; i < 6; ++i)
    {
      SymmetricTensor shear = {};
      shear[i] = s;
      EXPECT_DOUBLE_EQ(von_mises(shear), std::sqrt(3) * std::abs(s));
    }
    EXPECT_EQ(von_mises({ s, s, s }), 0);
  }
  EXPECT_EQ(von_mises({ 4, 1, 1 }), 3);
  EXPECT_EQ(von_mises({ 4 + 0x1p50, 1 + 0x1p50, 1 + 0x1p50 }), 3);
  // by the principal values
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 200; ++trial)
  {
    const double a = random_number(random);
    const double b = random_number(random);
    const double c = random_number(random);
    const double square = ((a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a)) / 2;
    EXPECT_NEAR(von_mises(turned({ a, b, c }, random)), std::sqrt(square), 1e-14);
  }
}
