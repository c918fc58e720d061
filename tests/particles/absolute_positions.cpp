// SPDX-License-Identifier: BSD-3-Clause
// Absolute positions of whatever the points are, and the images of those beside a periodic box.
#include "granular/particles/absolute_positions.h"

#include "granular/common/error.h"
#include "granular/particles/point_forms.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace granular;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

FrameView view_of(const std::vector<double>& points)
{
  FrameView view;
  view.rows = static_cast<std::int64_t>(points.size() / 3);
  view.points = view_rows("points", ValueType::Float64, points.data(), 3);
  view.header.box = Box::from_bounds({ -1, 0, 2 }, { 3, 8, 4 });
  view.header.box.boundary = "pp pp ff";
  return view;
}

std::vector<double> load(const FrameView& view, bool wrap)
{
  const AbsolutePositions positions(view, wrap);
  std::array<double, 3 * AbsolutePositions::most_rows> buffer;
  const auto rows = static_cast<std::size_t>(view.rows);
  const double* const at = positions.load(0, rows, buffer.data());
  return { at, at + 3 * rows };
}
}

TEST(AbsolutePositions, PlainPointsStayWhereTheyAre)
{
  const std::vector<double> points = { 1, 2, 3, 4, 5, 6 };
  const FrameView view = view_of(points);
  const AbsolutePositions positions(view, false);
  EXPECT_EQ(positions.load(1, 1, nullptr), points.data() + 3);
}

TEST(AbsolutePositions, WrapsAlongPeriodicAxesOnly)
{
  const std::vector<double> points = { 3, 8, 4, -1, 0, 2, -1.5, -0.25, 1, 7.5, 16.5, 9, 0, 0, 3 };
  EXPECT_EQ(load(view_of(points), true),
    (std::vector<double>{ -1, 0, 4, -1, 0, 2, 2.5, 7.75, 1, -0.5, 0.5, 9, 0, 0, 3 }));
}

TEST(AbsolutePositions, WhatLiesJustBelowTheBoxIsTheLastOfIt)
{
  const double below = std::nextafter(3.0, 0.0);
  const std::vector<double> points = { std::nextafter(-1.0, -2.0), -1e-300, 3, 1e300, 1, 1,
    -infinity, infinity, 1 };
  const std::vector<double> wrapped = load(view_of(points), true);
  EXPECT_EQ(wrapped[0], below);
  EXPECT_EQ(wrapped[1], std::nextafter(8.0, 0.0));
  EXPECT_EQ(wrapped[3], 1e300); // its last bit is many periods
  EXPECT_EQ(wrapped[6], -infinity);
  EXPECT_EQ(wrapped[7], infinity);
}

TEST(AbsolutePositions, FarImagesAreWithinAnUlp)
{
  for (int n = -40; n <= 40; ++n)
  {
    const double far = std::ldexp(n, 30) * 4 + 0.5; // exact
    const std::vector<double> points = { far, 1, 3 };
    EXPECT_EQ(load(view_of(points), true)[0], 0.5) << n;
  }
}

TEST(AbsolutePositions, AddsWhatWasSubtracted)
{
  const std::vector<double> points = { 1, 2, 3 };
  FrameView view = view_of(points);
  view.point_origin = { 0.5, 0.25, -1 };
  EXPECT_EQ(load(view, false), (std::vector<double>{ 1.5, 2.25, 2 }));
}

TEST(AbsolutePositions, ScaledPointsAreMultipliedByTheBox)
{
  const std::vector<double> points = { 0.5, 0.25, 1, -0.25, 1.25, 0.5 };
  FrameView view = view_of(points);
  view.coordinates = Coordinates::Scaled;
  EXPECT_EQ(load(view, false), (std::vector<double>{ 1, 2, 4, -2, 10, 3 }));
  EXPECT_EQ(load(view, true), (std::vector<double>{ 1, 2, 4, 2, 2, 3 }));
  view.has_box = false;
  EXPECT_THROW(AbsolutePositions(view, false), Error);
}

TEST(AbsolutePositions, UnwrappedPointsLoseTheirCounts)
{
  const std::vector<double> points = { 9, 2, 3, -5, 10, 3 };
  FrameView view = view_of(points);
  view.coordinates = Coordinates::Unwrapped;
  EXPECT_EQ(load(view, false), (std::vector<double>{ 1, 2, 3, -1, 2, 3 })); // wrapped
  const std::vector<std::int32_t> image = { 2, 0, 0, -1, 1, 0 };
  view.arrays.push_back(view_rows("image", ValueType::Int32, image.data(), 3));
  EXPECT_EQ(load(view, false), (std::vector<double>{ 1, 2, 3, -1, 2, 3 }));
}

TEST(AbsolutePositions, FloatsAndStridedRows)
{
  const std::vector<float> points = { 1, 2, 3, 99, 4, 5, 6, 99 };
  FrameView view = view_of({});
  view.rows = 2;
  view.points = view_rows("points", ValueType::Float32, points.data(), 4);
  EXPECT_EQ(load(view, false), (std::vector<double>{ 1, 2, 3, 4, 5, 6 }));
  const std::vector<double> doubles = { 1, 2, 3, 99, 4, 5, 6, 99 };
  view.points = view_rows("points", ValueType::Float64, doubles.data(), 4);
  EXPECT_EQ(load(view, false), (std::vector<double>{ 1, 2, 3, 4, 5, 6 }));
}

// Rows whose first and last are as far apart as if all lay between them, but others do.
TEST(AbsolutePositions, RowsInAnyOrder)
{
  std::vector<double> points;
  for (int i = 0; i < 24; ++i)
  {
    points.push_back(i);
  }
  const FrameView view = view_of(points);
  const AbsolutePositions positions(view, false);
  std::array<double, 3 * AbsolutePositions::most_rows> buffer;
  for (const std::vector<std::int64_t>& rows : { std::vector<std::int64_t>{ 0, 5, 2 },
         std::vector<std::int64_t>{ 3, 7, 6, 6 }, std::vector<std::int64_t>{ 1, 2, 3 } })
  {
    positions.load(rows, buffer.data());
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      EXPECT_EQ(buffer[3 * i], 3 * static_cast<double>(rows[i]));
    }
    double loaded[4];
    load_numbers(point_values(view, 1), rows, loaded);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      EXPECT_EQ(loaded[i], 3 * static_cast<double>(rows[i]) + 1);
    }
  }
}

TEST(AbsolutePositions, TiltedBoxesAreNotWrapped)
{
  const std::vector<double> points = { 5, 2, 3 };
  FrameView view = view_of(points);
  view.header.box = Box::from_tilted_bounds({ 0, 0, 0 }, { 5, 4, 4 }, 1, 0, 0);
  view.header.box.boundary = "pp pp pp";
  EXPECT_EQ(load(view, true), points);
}
