// SPDX-License-Identifier: BSD-3-Clause
// What rounding takes from points and values is told, in writing and reading: against snprintf, strtod and float, which do
// the rounding here, and against what comes back.
#include "../support/dump_writing.h"
#include "../support/dumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace granular;

std::string printed(double value, int digits)
{
  std::array<char, 64> word;
  std::snprintf(word.data(), word.size(), "%.*g", digits, value);
  return word.data();
}

double read_back(double value, int digits)
{
  return std::strtod(printed(value, digits).c_str(), nullptr);
}

/// Particles in a cube with its corner at the same coordinate along each axis.
struct Cube
{
  Cube(double corner, double length, double radius, unsigned seed = 1)
    : box(Box::from_bounds(
        { corner, corner, corner }, { corner + length, corner + length, corner + length }))
    , radii(count, radius)
  {
    box.boundary = "pp pp pp";
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0, length);
    for (std::size_t i = 0; i < 3 * count; ++i)
    {
      points.push_back(corner + place(random));
      velocities.push_back(place(random) - length / 2);
    }
  }

  FrameView view(bool with_radii = true) const
  {
    FrameView view;
    view.header.box = box;
    view.rows = count;
    view.points = view_rows("points", ValueType::Float64, points.data(), 3);
    view.arrays = { view_rows("v", ValueType::Float64, velocities.data(), 3) };
    if (with_radii)
    {
      view.arrays.push_back(view_rows("radius", ValueType::Float64, radii.data()));
    }
    return view;
  }

  /// How far a point moves at most, if each coordinate becomes another.
  template <class Rounded>
  double moved(const Rounded& rounded) const
  {
    double most = 0;
    for (const double x : points)
    {
      most = std::max(most, std::abs(rounded(x) - x));
    }
    return most;
  }

  static constexpr std::int64_t count = 700; // some lots of rows
  Box box;
  std::vector<double> points;
  std::vector<double> velocities;
  std::vector<double> radii;
};

DumpFormat format_with(int digits, std::vector<std::string> columns, Dialect dialect)
{
  DumpFormat format;
  format.numbers = { digits };
  format.columns = std::move(columns);
  format.dialect = dialect;
  return format;
}

const std::vector<std::string> places = { "x", "y", "z", "radius" };
const std::vector<std::string> scaled_places = { "xs", "ys", "zs", "radius" };

/// The line that says so, without which axis it was.
std::string without_axis(std::string text)
{
  const std::size_t along = text.find(" along ");
  return along == text.npos ? text : text.erase(along + 7, 1);
}

/// How far points that were read are from those that were written.
double distance(const std::string& bytes, const Cube& cube)
{
  const std::vector<double> points = Dump(bytes).read().points();
  double most = points.size() == cube.points.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    most = std::max(most, std::abs(points[i] - cube.points[i]));
  }
  return most;
}

/// The cube as a text dump with all digits.
std::string text_of(const Cube& cube, const char* columns = "x y z radius")
{
  std::string rows;
  for (std::size_t i = 0; i < cube.points.size(); i += 3)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      rows += printed(cube.points[i + axis], 17) + " ";
    }
    rows += std::string(columns).size() > 5 ? printed(cube.radii[i / 3], 17) + "\n" : "\n";
  }
  const BoxBounds b = cube.box.bounds();
  const std::string bounds = printed(b.lo[0], 17) + " " + printed(b.hi[0], 17) + "\n";
  return one_frame(columns, rows, " pp pp pp\n" + bounds + bounds + bounds);
}

Request single_at(double origin)
{
  Request request;
  request.single_precision = true;
  request.point_origin = { origin, origin, origin };
  return request;
}
}

// ---- writing ------------------------------------------------------------------------------------

/// A box of a centimetre at 10^6 m, and the same at the origin: told where a particle moves by more than a hundredth
/// of the radius.
TEST(RoundingInWriting, MovedParticlesAreTold)
{
  const Folder folder;
  for (const double corner : { 0.0, 1.0, -3.7, 1e6 })
  {
    for (const double radius : { 1e-3, 2e-5 })
    {
      const Cube cube(corner, 1e-2, radius);
      for (int digits = 4; digits <= 17; ++digits)
      {
        const double moved = cube.moved([&](double x) { return read_back(x, digits); });
        const std::string format = digits == 6 ? "%g" : "%." + std::to_string(digits) + "g";
        const std::string expected = moved <= 0.01 * radius
          ? ""
          : "rounding to " + format + " moves particles by up to " + printed(moved, 3) +
            " along , where the smallest radius is " + printed(radius, 3) +
            "; NumberFormat=%.17g keeps all digits; scaled coordinates (Style=Atom) need fewer far "
            "from the origin\n";
        const Written written = write_dump(
          folder.path("a"), Frames{ cube.view() }, format_with(digits, places, Dialect::Lammps));
        EXPECT_EQ(without_axis(written.said), expected) << corner << " " << digits;
      }
      const Written shortest = write_dump(
        folder.path("a"), Frames{ cube.view() }, format_with(0, places, Dialect::Lammps));
      EXPECT_EQ(shortest.said, "");
      EXPECT_EQ(distance(shortest.bytes, cube), 0);
    }
  }
}

/// Without radii 1e-4 of the box counts.
TEST(RoundingInWriting, WithoutRadiiTheBoxCounts)
{
  const Folder folder;
  for (const double corner : { 0.0, 10.0, 100.0, 1e4 })
  {
    const Cube cube(corner, 1, 1);
    const double moved = cube.moved([](double x) { return read_back(x, 6); });
    const Written written = write_dump(folder.path("a"), Frames{ cube.view(false) },
      format_with(6, { "x", "y", "z" }, Dialect::Lammps));
    const std::string expected = "rounding to %g moves particles by up to " + printed(moved, 3) +
      " along , where the box is 1 long;";
    EXPECT_EQ(without_axis(written.said).substr(0, expected.size()), moved > 1e-4 ? expected : "")
      << corner;
  }
}

/// Scaled coordinates help where they are off, and by the setting that turns them on.
TEST(RoundingInWriting, ScaledCoordinatesAreAdvisedWhereTheyAreOff)
{
  const Folder folder;
  const Cube cube(1e6, 1e-2, 1e-4);
  const auto said = [&](DumpStyle style, bool scaled, const std::vector<std::string>& columns)
  {
    DumpFormat format = format_with(3, columns, Dialect::Lammps);
    format.style = style;
    format.atom.scaled = scaled;
    const std::string text = write_dump(folder.path("a"), Frames{ cube.view() }, format).said;
    return text.substr(std::min(text.find("; "), text.size()));
  };
  const std::string digits = "; NumberFormat=%.17g keeps all digits";
  const std::string far = ") need fewer far from the origin\n";
  EXPECT_EQ(
    said(DumpStyle::Custom, false, places), digits + "; scaled coordinates (Style=Atom" + far);
  EXPECT_EQ(said(DumpStyle::Atom, false, {}), digits + "; scaled coordinates (Scaled=1" + far);
  EXPECT_EQ(said(DumpStyle::Atom, true, {}), digits + "\n");
  EXPECT_EQ(said(DumpStyle::Custom, false, scaled_places), digits + "\n");
}

/// Numbers that the digits hold are as they were, however far away.
TEST(RoundingInWriting, WhatLosesNothingIsNotTold)
{
  Cube cube(1e6, 1e-2, 1e-6);
  const Folder folder;
  for (double& x : cube.points)
  {
    x = read_back(x, 6);
  }
  EXPECT_EQ(
    write_dump(folder.path("a"), Frames{ cube.view() }, format_with(6, places, Dialect::Lammps))
      .said,
    "");
}

/// The same for all threads and ranks, once a file, of the frame that loses first.
TEST(RoundingInWriting, OnceAFileAndTheSameOnAllRanks)
{
  const Folder folder;
  const Cube near(0, 1e-2, 1e-3);
  const Cube far(1e6, 1e-2, 1e-3);
  const Cube farther(1e8, 1e-2, 1e-3);
  Frames frames = { near.view(), far.view(), farther.view() };
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    frames[i].header.timestep = static_cast<std::int64_t>(i);
  }
  const DumpFormat format = format_with(6, places, Dialect::Lammps);
  const Written one = write_dump(folder.path("a"), frames, format);
  const double moved = far.moved([](double x) { return read_back(x, 6); });
  EXPECT_NE(one.said.find("by up to " + printed(moved, 3) + " along"), one.said.npos) << one.said;
  EXPECT_EQ(one.said.find("rounding", 1), one.said.npos) << one.said;
  for (const int threads : { 1, 3 })
  {
    for (const std::vector<std::int64_t>& shares :
      { std::vector<std::int64_t>{ 100, 0, 5 }, { 699, 1 }, { 0, 0, 3 } })
    {
      const Written many = write_dump(
        folder.path("b"), cut(frames, shares), format, { ParallelMode::Gather, threads });
      EXPECT_EQ(many.said, one.said);
      EXPECT_EQ(many.bytes, one.bytes);
    }
  }
}

/// Few digits change values by more than a thousandth of themselves.
TEST(RoundingInWriting, ChangedValuesAreTold)
{
  const Folder folder;
  const Cube cube(0, 1, 0.125);
  for (int digits = 1; digits <= 6; ++digits)
  {
    double most = 0;
    for (std::size_t i = 0; i < cube.velocities.size(); i += 3)
    {
      const double v = cube.velocities[i];
      most = std::max(most, std::abs((read_back(v, digits) - v) / v));
    }
    const Written written = write_dump(
      folder.path("a"), Frames{ cube.view() }, format_with(digits, { "vx" }, Dialect::Lammps));
    EXPECT_EQ(written.said,
      most <= 1e-3 ? ""
                   : "rounding to %." + std::to_string(digits) + "g changes 'vx' by up to " +
          printed(100 * most, 3) +
          " % of itself; NumberFormat=%.17g keeps all digits; scaled coordinates (Style=Atom) "
          "need fewer far from the origin\n");
  }
}

/// LIGGGHTS prints its box with six digits; where these are too few the frame must be readable all the same.
TEST(RoundingInWriting, TheBoxOfLiggghtsKeepsTheParticles)
{
  const Folder folder;
  const DumpFormat format = format_with(17, scaled_places, Dialect::Liggghts);
  for (const double corner : { 1e6, -1e9, 1.0 / 3, 123456.7 })
  {
    const Cube cube(corner, 1e-2, 1e-4);
    const Written written = write_dump(folder.path("a"), Frames{ cube.view() }, format);
    EXPECT_EQ(written.said, "") << corner;
    EXPECT_LE(distance(written.bytes, cube), 1e-6) << corner;
    const DumpFormat absolute = format_with(17, places, Dialect::Liggghts);
    const Written other = write_dump(folder.path("a"), Frames{ cube.view() }, absolute);
    const Box box = Dump(other.bytes).header().box;
    EXPECT_NEAR(box.vectors[0][0].value(), 1e-2, 1e-5) << corner;
  }
  // what six digits hold well enough has the bytes of LIGGGHTS
  const Cube cube(0, 1.0 / 3, 1e-3);
  const Written written = write_dump(folder.path("a"), Frames{ cube.view() }, format);
  EXPECT_EQ(written.said, "");
  EXPECT_NE(written.bytes.find("\n0 0.333333\n0 0.333333\n0 0.333333\n"), written.bytes.npos);
  EXPECT_LE(distance(written.bytes, cube), 1e-5);
  // a tilted one, whose corner is far from its bounds
  Cube tilted(1e6, 1e-2, 1e-4);
  tilted.box = Box::from_tilted_bounds(
    { 1e6, 1e6, 1e6 }, { 1e6 + 0.02, 1e6 + 0.015, 1e6 + 0.01 }, 0.004, 0.006, 0.005);
  tilted.box.boundary = "pp pp pp";
  const Written of_tilted = write_dump(folder.path("a"), Frames{ tilted.view() }, format);
  EXPECT_EQ(of_tilted.said, "");
  EXPECT_LE(distance(of_tilted.bytes, tilted), 1e-6);
}

// ---- reading ------------------------------------------------------------------------------------

/// A box of a centimetre at 10^6 m in single precision, with no origin, the right one and a bad one.
TEST(RoundingInReading, SinglePrecisionIsTold)
{
  const Cube cube(1e6, 1e-2, 1e-4);
  const Dump dump(text_of(cube));
  for (const double origin : { 0.0, 1e6, -1e6, 1e6 + 1e-2, 999000.0 })
  {
    double moved = 0;
    for (const double x : cube.points)
    {
      const double place = x - origin;
      moved = std::max(moved, std::abs(static_cast<double>(static_cast<float>(place)) - place));
    }
    const std::string expected = moved <= 1e-6
      ? ""
      : "memory:1: rounding to single precision moves points by up to " + printed(moved, 3) +
        " along , where the smallest radius is 0.0001; set PointOrigin near the particles, or "
        "PointPrecision=Double\n";
    EXPECT_EQ(without_axis(dump.read(single_at(origin)).said()), expected) << origin;
    Request twofold = single_at(origin);
    twofold.single_precision = false;
    EXPECT_EQ(dump.read(twofold).said(), "") << origin;
  }
}

/// The rule of the box, other forms of the columns, and rows that are not wanted.
TEST(RoundingInReading, FormsAndFilters)
{
  const Cube cube(1e6, 1e-2, 1e-4);
  const std::string box_rule = Dump(text_of(cube, "x y z")).read(single_at(0)).said();
  EXPECT_NE(box_rule.find("where the box is 0.01 long"), box_rule.npos) << box_rule;
  const Folder folder;
  for (const bool binary : { false, true })
  {
    DumpFormat format = format_with(17, scaled_places, Dialect::Lammps);
    format.binary = binary;
    const Dump dump(write_dump(folder.path("a"), Frames{ cube.view() }, format).bytes);
    const std::string said = dump.read(single_at(0)).said();
    EXPECT_NE(said.find("rounding to single precision moves points"), said.npos) << binary;
    EXPECT_EQ(dump.read(single_at(1e6)).said(), "");
    Request units = single_at(0);
    units.coordinates = Coordinates::Scaled;
    EXPECT_EQ(dump.read(units).said(), "");
  }
  // one row loses, and is not wanted
  const std::string far = "1 0.5 0.5 0.5 0.001\n2 1000000.3 0.5 0.5 0.001\n";
  const Dump rows(one_frame("id x y z radius", far));
  EXPECT_NE(rows.read(single_at(0)).said(), "");
  Request filtered = single_at(0);
  filtered.region = { 0, 1, 1, -1, 1, -1 };
  EXPECT_EQ(rows.read(filtered).said(), "");
}

/// Floats that are the numbers of the file lose nothing, however far away.
TEST(RoundingInReading, WhatLosesNothingIsNotTold)
{
  Cube cube(1048576, 64, 1e-3);
  for (double& x : cube.points)
  {
    x = std::floor(8 * x) / 8;
  }
  EXPECT_EQ(Dump(text_of(cube)).read(single_at(0)).said(), "");
}

/// A box of no length cannot scale coordinates; those that it does not scale can be read.
TEST(RoundingInReading, ABoxOfNoLength)
{
  const std::string box = " pp pp pp\n1e+06 1e+06\n0 1\n0 1\n";
  const std::string rows = "0.1 0.2 0.3\n0.4 0.5 0.6\n";
  EXPECT_EQ(Dump(one_frame("xs ys zs", rows, box)).error(),
    "memory:1: expected a box with a length along x to scale coordinates by, got one of length 0");
  EXPECT_EQ(Dump(one_frame("x y z", rows, box)).error(), "");
  EXPECT_EQ(Dump(one_frame("xs ys zs", "", box)).error(), "") << "no particles, nothing to scale";
  Request scaled;
  scaled.coordinates = Coordinates::Scaled;
  EXPECT_NE(Dump(one_frame("x y z", rows, box)).error(scaled), "");
}
