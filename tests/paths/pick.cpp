// SPDX-License-Identifier: BSD-3-Clause
// The particles of a frame in memory: all types of arrays and all forms of points.
#include "granular/paths/path_frame.h"

#include "../support/dumps.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace granular;

namespace
{
using Numbers = std::vector<std::int64_t>;

/// Four particles with ids 8, -3, 5, 6 in the box from (10, 20, 30) to (12, 24, 38).
struct Four
{
  Four()
  {
    view.rows = 4;
    view.points = view_rows("points", ValueType::Float64, points.data(), 3);
    view.arrays = { view_rows("id", ValueType::Int64, ids.data()) };
    view.header.timestep = 70;
    view.header.box = Box::from_bounds({ 10, 20, 30 }, { 12, 24, 38 });
    view.header.box.boundary = "pp pp pp";
  }

  Numbers ids = { 8, -3, 5, 6 };
  std::vector<double> points = { 0, 0, 0, 1, 10, 100, 2, 20, 200, 0.5, 0.25, 0.125 };
  FrameView view;
};

PathFrame pick(const FrameView& view, const PathRequest& request = {}, std::int64_t first_row = 0)
{
  Progress progress;
  return pick_particles(view, request, first_row, Executor(3), progress);
}

std::string refusal(const FrameView& view, const PathRequest& request = {})
{
  return error_of([&] { pick(view, request); });
}

template <class Value>
void expect_picked(ValueType type, const std::vector<Value>& values, bool integers)
{
  SCOPED_TRACE(static_cast<int>(type));
  Four four;
  four.view.arrays.push_back(view_rows("a", type, values.data()));
  four.view.arrays.push_back(view_rows("pairs", type, values.data(), 2));
  four.view.arrays.back().step = 1; // of values that overlap: rows i and i + 1
  const PathFrame picked = pick(four.view, { IdSelection("8 5"), { "pairs", "none", "a", "a" } });
  ASSERT_EQ(picked.arrays.size(), 4U);
  const auto word = [&](std::size_t i)
  {
    return integers ? static_cast<std::int64_t>(values[i])
                    : std::bit_cast<std::int64_t>(static_cast<double>(values[i]));
  };
  EXPECT_EQ(picked.arrays[0].size, 2);
  EXPECT_EQ(picked.arrays[0].integers, integers);
  EXPECT_EQ(picked.arrays[0].words, (Numbers{ word(0), word(1), word(2), word(3) }));
  EXPECT_EQ(picked.arrays[1].size, 0);
  EXPECT_EQ(picked.arrays[2].words, (Numbers{ word(0), word(2) }));
  EXPECT_EQ(picked.arrays[3].words, picked.arrays[2].words);
}
}

TEST(PickParticles, ChosenOnes)
{
  Four four;
  const PathFrame all = pick(four.view, {}, 1000);
  EXPECT_TRUE(all.loaded && all.has_rows && !all.has_images);
  EXPECT_EQ(all.header.timestep, 70);
  EXPECT_EQ(all.ids, four.ids);
  EXPECT_EQ(all.rows, (Numbers{ 1000, 1001, 1002, 1003 }));
  EXPECT_EQ(all.points, four.points);
  const PathFrame some = pick(four.view, { IdSelection("5-8"), {} }, 7);
  EXPECT_EQ(some.ids, (Numbers{ 8, 5, 6 }));
  EXPECT_EQ(some.rows, (Numbers{ 7, 9, 10 }));
  EXPECT_EQ(some.points, (std::vector<double>{ 0, 0, 0, 2, 20, 200, 0.5, 0.25, 0.125 }));
  EXPECT_TRUE(pick(four.view, { IdSelection("1000"), {} }).ids.empty());
}

TEST(PickParticles, GhostsAreLeftOut)
{
  Four four;
  const std::vector<unsigned char> ghosts = { 0, 1, 2, 3 };
  four.view.ghosts = ghosts.data();
  EXPECT_EQ(pick(four.view).ids, (Numbers{ 8, 5 }));
  EXPECT_EQ(pick(four.view).rows, (Numbers{ 0, 2 }));
  EXPECT_EQ(pick(four.view, { IdSelection("-3 5"), {} }).ids, (Numbers{ 5 }));
}

TEST(PickParticles, ArraysOfAllTypes)
{
  expect_picked<std::int8_t>(ValueType::Int8, { -128, 127, 0, 5 }, true);
  expect_picked<std::uint8_t>(ValueType::UInt8, { 255, 0, 3, 5 }, true);
  expect_picked<std::int16_t>(ValueType::Int16, { -32768, 1, 2, 3 }, true);
  expect_picked<std::uint16_t>(ValueType::UInt16, { 65535, 1, 2, 3 }, true);
  expect_picked<std::int32_t>(ValueType::Int32, { -1, 1 << 30, 2, 3 }, true);
  expect_picked<std::uint32_t>(ValueType::UInt32, { ~0U, 1, 2, 3 }, true);
  expect_picked<std::int64_t>(ValueType::Int64,
    { std::numeric_limits<std::int64_t>::min(), 1, (std::int64_t{ 1 } << 53) + 1, 3 }, true);
  expect_picked<std::uint64_t>(ValueType::UInt64, { ~std::uint64_t{ 0 }, 1, 2, 3 }, false);
  expect_picked<float>(
    ValueType::Float32, { 0.1F, -0.0F, std::numeric_limits<float>::infinity(), 3 }, false);
  expect_picked<double>(
    ValueType::Float64, { 0.1, -0.0, 5e-324, std::numeric_limits<double>::quiet_NaN() }, false);
}

/// Points are absolute, whatever is shown; unwrapped ones stay as they are.
TEST(PickParticles, PointsOfAllForms)
{
  const IdSelection two("-3, 6");
  Four four;
  four.view.point_origin = { 1000, 0, -1 };
  EXPECT_EQ(pick(four.view, { two, {} }).points,
    (std::vector<double>{ 1001, 10, 99, 1000.5, 0.25, -0.875 }));
  four.view.point_origin = {};
  four.view.coordinates = Coordinates::Scaled;
  PathFrame frame = pick(four.view, { two, {} });
  EXPECT_EQ(frame.points, (std::vector<double>{ 12, 60, 830, 11, 21, 31 }));
  EXPECT_EQ(frame.coordinates, Coordinates::Absolute);
  const std::vector<std::int32_t> images = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, -12 };
  four.view.arrays.push_back(view_rows("image", ValueType::Int32, images.data(), 3));
  frame = pick(four.view, { two, {} });
  EXPECT_TRUE(frame.has_images);
  EXPECT_EQ(frame.images, (Numbers{ 4, 5, 6, 10, 11, -12 }));
  four.view.coordinates = Coordinates::Unwrapped;
  four.view.point_origin = { 1, 1, 1 };
  frame = pick(four.view, { two, {} });
  EXPECT_EQ(frame.points, (std::vector<double>{ 2, 11, 101, 1.5, 1.25, 1.125 }));
  EXPECT_EQ(frame.coordinates, Coordinates::Unwrapped);
  EXPECT_FALSE(frame.has_images); // they count nothing more
  const std::vector<float> floats(four.points.begin(), four.points.end());
  four.view.points = view_rows("points", ValueType::Float32, floats.data(), 3);
  EXPECT_EQ(pick(four.view, { two, {} }).points, frame.points);
  EXPECT_TRUE(pick(four.view, { two, {}, false }).points.empty());
}

/// Where points in the box are wanted, unwrapped ones lose their image counts, known or not.
TEST(PickParticles, AbsolutePointsOfUnwrappedOnes)
{
  Four four;
  four.points = { 11, 21, 31, 17, 20, 38.5, 9, 24, 30, 12.5, 19, 30 };
  four.view.coordinates = Coordinates::Unwrapped;
  PathRequest request{ IdSelection("-3 5"), {} };
  request.absolute = true;
  PathFrame frame = pick(four.view, request);
  EXPECT_EQ(frame.coordinates, Coordinates::Absolute);
  EXPECT_EQ(frame.points, (std::vector<double>{ 11, 20, 30.5, 11, 20, 30 }));
  const std::vector<std::int32_t> images = { 0, 0, 0, 3, 0, 1, 0, 1, 0, 0, 0, 0 };
  four.view.arrays.push_back(view_rows("image", ValueType::Int32, images.data(), 3));
  frame = pick(four.view, request);
  EXPECT_EQ(frame.points, (std::vector<double>{ 11, 20, 30.5, 9, 20, 30 }));
  EXPECT_EQ(frame.images, (Numbers{ 3, 0, 1, 0, 1, 0 }));
  four.view.coordinates = Coordinates::Absolute;
  EXPECT_EQ(pick(four.view, request).points, (std::vector<double>{ 17, 20, 38.5, 9, 24, 30 }));
}

/// Counts of crossings are integers, three of them.
TEST(PickParticles, ImagesThatAreNone)
{
  Four four;
  const std::vector<double> doubles(12);
  four.view.arrays.push_back(view_rows("image", ValueType::Float64, doubles.data(), 3));
  EXPECT_FALSE(pick(four.view).has_images);
  four.view.arrays.back() = view_rows("image", ValueType::Int64, four.ids.data());
  EXPECT_FALSE(pick(four.view).has_images);
  const std::vector<std::uint64_t> unsigned_counts(12);
  four.view.arrays.back() = view_rows("image", ValueType::UInt64, unsigned_counts.data(), 3);
  EXPECT_FALSE(pick(four.view).has_images);
}

TEST(PickParticles, NoRows)
{
  FrameView nobody;
  nobody.header.timestep = 3;
  const PathFrame frame = pick(nobody, { IdSelection("5"), { "a", "b" } });
  EXPECT_TRUE(frame.loaded && frame.ids.empty() && frame.points.empty());
  ASSERT_EQ(frame.arrays.size(), 2U);
  EXPECT_EQ(frame.arrays[1].name, "b");
  EXPECT_EQ(frame.arrays[1].size, 0);
}

TEST(PickParticles, Errors)
{
  Four four;
  const std::vector<std::string> texts(4);
  four.view.arrays.push_back(view_rows("element", ValueType::Text, texts.data()));
  EXPECT_EQ(refusal(four.view, { {}, { "element" } }),
    "expected numbers in array 'element' of the particles, got texts");
  EXPECT_EQ(refusal(four.view), "");
  const std::vector<double> halves = { 8, 2.5, 5, 6 };
  four.view.arrays[0] = view_rows("id", ValueType::Float64, halves.data());
  EXPECT_EQ(refusal(four.view),
    "column 'id': expected a 64-bit integer as id, got 2.5 in row 1 (the first is 0)");
  four.view.arrays.clear();
  EXPECT_EQ(
    refusal(four.view), "expected an array 'id' of the particles, got none: paths need ids");
  Four bare;
  bare.view.points.reset();
  EXPECT_EQ(refusal(bare.view), "expected points of the particles, got none");
  EXPECT_EQ(refusal(bare.view, { {}, {}, false }), "");
}

TEST(PickParticles, IdsInARegion)
{
  Four four;
  const PathFrame frame = pick(four.view);
  const auto ids = [&](const std::array<double, 6>& region)
  { return ids_in_region(frame, region); };
  EXPECT_EQ(ids({ 1, -1, 1, -1, 1, -1 }), four.ids);
  EXPECT_EQ(ids({ 1, 2, 1, -1, 1, -1 }), (Numbers{ -3, 5 })); // faces included
  EXPECT_EQ(ids({ 0.5, 2, 0, 10, 0.125, 100 }), (Numbers{ -3, 6 }));
  EXPECT_EQ(ids({ 1, 1, 1, -1, 1, -1 }), (Numbers{ -3 }));
  EXPECT_EQ(ids({ 3, 4, 1, -1, 1, -1 }), Numbers{});
}
