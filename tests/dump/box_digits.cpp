// SPDX-License-Identifier: BSD-3-Clause
// Scaled coordinates in boxes that LIGGGHTS prints, with the six digits of %g: what these move is told.
#include "../support/dumps.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace
{
using granular::Coordinates;
using granular::Request;

std::string printed(const char* format, double value)
{
  std::array<char, 64> word;
  std::snprintf(word.data(), word.size(), format, value);
  return word.data();
}

/// A cube from lo to hi as a program prints it, with particles of a radius in its middle and near two corners.
Dump dump_of(const char* format, double lo, double hi,
  const std::string& columns = "xs ys zs radius", const std::string& radius = " 0.001")
{
  const std::string bounds = printed(format, lo) + ' ' + printed(format, hi) + '\n';
  std::string rows;
  for (const char* place : { "0.5 0.5 0.5", "0.01 0.01 0.01", "0.99 0.99 0.99" })
  {
    rows += place + radius + '\n';
  }
  return Dump(one_frame(columns, rows, " pp pp pp\n" + bounds + bounds + bounds));
}

constexpr double lo = 1000.1249;
constexpr double hi = 1000.3151;
}

TEST(BoxDigits, FarBoxesOfLiggghtsAreTold)
{
  const Decoded got = dump_of("%g", lo, hi).read();
  double most = 0; // the largest error along an axis
  const double places[] = { 0.5, 0.01, 0.99 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    most = std::max(most, std::abs(got.points()[3 * i] - (lo + places[i] * (hi - lo))));
  }
  EXPECT_NEAR(most, 4.9e-3, 1e-4); // the upper bound is printed as 1000.32
  EXPECT_EQ(got.said(),
    "memory:1: the last digit of the bounds of the box, which scale the coordinates, moves points "
    "by up to 0.005 along x, "
    "where the smallest radius is 0.001; dump x y z with more digits (dump_modify ID format \"%d "
    "%d %.12g ...\", a format "
    "for each column), or a binary file\n");
}

TEST(BoxDigits, EveryFormOfScaledCoordinates)
{
  const auto tells = [](const Dump& dump, Coordinates coordinates = Coordinates::Absolute)
  {
    Request request;
    request.coordinates = coordinates;
    return dump.read(request).said().find("by up to 0.005 along") != std::string::npos;
  };
  EXPECT_TRUE(tells(dump_of("%g", lo, hi, "xsu ysu zsu radius"), Coordinates::Unwrapped));
  EXPECT_TRUE(tells(dump_of("%g", -hi, -lo)));
  EXPECT_TRUE(tells(dump_of("%g", lo, hi, "xs ys zs", ""))); // 2.6 % of the box
  EXPECT_FALSE(tells(dump_of("%g", lo, hi), Coordinates::Scaled));
  EXPECT_FALSE(tells(dump_of("%g", lo, hi, "x y z radius")));
  // a tilt counts, too
  const Dump tilted(one_frame("xs ys zs radius", "0.5 0.5 0.5 0.001\n",
    " xy xz yz pp pp pp\n0 3000 0\n0 2000 1000.12\n0 2000 0\n"));
  EXPECT_TRUE(tells(tilted));
}

TEST(BoxDigits, EnoughDigitsAndRoundNumbersAreNotTold)
{
  EXPECT_EQ(dump_of("%.9g", 1000.12491, 1000.31507).read().said(), "");
  EXPECT_EQ(dump_of("%-1.16e", lo, hi).read().said(), "");
  EXPECT_EQ(dump_of("%g", lo - 1000, hi - 1000).read().said(), "");
  EXPECT_EQ(dump_of("%g", 1000, 1001).read().said(), "");
  EXPECT_EQ(dump_of("%g", 100000, 100100).read().said(), "");
  EXPECT_EQ(dump_of("%.17g", 1e9, 1e9 + 1).read().said(), "");
  EXPECT_EQ(dump_of("%.12g", 999999.5, 1000008.4).read().said(), "");
  EXPECT_EQ(dump_of("%g", lo, hi, "xs ys zs radius", " 10").read().said(), "");
  const Dump empty(one_frame("xs ys zs radius", "", " pp pp pp\n1000.12 1000.32\n0 1\n0 1\n"));
  EXPECT_EQ(empty.read().said(), "");
}
