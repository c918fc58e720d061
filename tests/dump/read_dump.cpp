// SPDX-License-Identifier: BSD-3-Clause
// What a frame becomes: arrays, points, rows chosen, rows sorted.
#include "granular/formats/dump/read/dump_reader.h"

#include "../support/dumps.h"
#include "../support/frame_content.h"
#include "../support/hard_case.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace
{
using granular::ArrayInfo;
using granular::Coordinates;
using granular::Request;
using granular::ValueType;
using Doubles = std::vector<double>;
using Integers = std::vector<std::int64_t>;
using Texts = std::vector<std::string>;

Request with_coordinates(Coordinates coordinates)
{
  Request request;
  request.coordinates = coordinates;
  return request;
}

Request with_stride(std::int64_t stride)
{
  Request request;
  request.stride = stride;
  return request;
}

Request with_region(const std::array<double, 6>& region)
{
  Request request;
  request.region = region;
  return request;
}

Request sorted()
{
  Request request;
  request.sort_by_id = true;
  return request;
}

Request wanting(const std::vector<std::string>& names)
{
  Request request;
  request.wanted = [names](std::string_view name, bool)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  return request;
}

std::int64_t id_of(std::int64_t row)
{
  return row * 7919 % 10007; // a permutation of 0 to 10006
}

/// Some rows with all kinds of columns: x is the row, q the id.
std::string many_rows(
  std::int64_t count, const std::string& columns = "id x y z q ix iy iz element")
{
  std::string rows;
  for (std::int64_t row = 0; row < count; ++row)
  {
    const std::string id = std::to_string(id_of(row));
    rows += columns.starts_with("id") ? id + " " : "";
    rows += std::to_string(row) + " 0.5 " + std::to_string(row % 10) + " " + id + " " +
      std::to_string(row % 3) + " 0 -1 E" + std::to_string(row) + "\n";
  }
  return one_frame(columns, rows);
}

/// Whether a frame of many_rows holds exactly the rows that keep says yes to, in their order.
void expect_rows(
  const Decoded& got, std::int64_t count, const std::function<bool(std::int64_t)>& keep)
{
  Doubles points;
  Integers ids;
  Doubles charges;
  Integers images;
  Texts elements;
  for (std::int64_t row = 0; row < count; ++row)
  {
    if (keep(row))
    {
      points.insert(points.end(), { static_cast<double>(row), 0.5, static_cast<double>(row % 10) });
      ids.push_back(id_of(row));
      charges.push_back(static_cast<double>(id_of(row)));
      images.insert(images.end(), { row % 3, 0, -1 });
      elements.push_back("E" + std::to_string(row));
    }
  }
  EXPECT_EQ(got.rows(), static_cast<std::int64_t>(charges.size()));
  EXPECT_TRUE(got.points() == points);
  EXPECT_TRUE(got.values("q") == charges);
  EXPECT_TRUE(got.integers("image") == images);
  EXPECT_TRUE(got.texts("element") == elements);
  if (got.has("id"))
  {
    EXPECT_TRUE(got.integers("id") == ids);
  }
}
}

// ---- arrays ------------------------------------------------------------------------------------

TEST(ReadDump, EveryKindOfArray)
{
  const Dump dump(
    one_frame("id type mol x y z ix iy iz vx vy vz quat1 quat2 quat3 quat4 c_a[1] c_a[2] "
              "element i_flag d_heat radius proc",
      "9007199254740993 -1 12 0.1 0.2 0.3 1 -2 0 1e-3 -4e5 +6 0.5 0.25 0.125 1 7 8 Si 3 nan 0.0025 "
      "0\n"
      "2 2147483647 1e3 0 0 0 0 0 0 0 0 0 1 0 0 0 9 -10 1.5 -3 -inf 1 3\n"));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.said(), "");
  EXPECT_EQ(frame.names(), "id type mol image v quat c_a element i_flag d_heat radius proc");
  EXPECT_EQ(frame.type("id"), ValueType::Int64);
  EXPECT_EQ(frame.integers("id"), (Integers{ 9007199254740993, 2 }));
  EXPECT_EQ(frame.type("type"), ValueType::Int32);
  EXPECT_EQ(frame.integers("type"), (Integers{ -1, 2147483647 }));
  EXPECT_EQ(frame.integers("mol"), (Integers{ 12, 1000 }));
  EXPECT_EQ(frame.type("image"), ValueType::Int32);
  EXPECT_EQ(frame.integers("image"), (Integers{ 1, -2, 0, 0, 0, 0 }));
  EXPECT_EQ(frame.values("v"), (Doubles{ 1e-3, -4e5, 6, 0, 0, 0 }));
  EXPECT_EQ(frame.values("quat"), (Doubles{ 0.5, 0.25, 0.125, 1, 1, 0, 0, 0 }));
  EXPECT_EQ(frame.values("c_a"), (Doubles{ 7, 8, 9, -10 }));
  EXPECT_EQ(frame.texts("element"), (Texts{ "Si", "1.5" }));
  EXPECT_EQ(frame.integers("i_flag"), (Integers{ 3, -3 }));
  EXPECT_TRUE(std::isnan(frame.values("d_heat")[0]));
  EXPECT_EQ(frame.values("d_heat")[1], -HUGE_VAL);
  EXPECT_EQ(frame.values("radius"), (Doubles{ 0.0025, 1 }));
  EXPECT_EQ(frame.integers("proc"), (Integers{ 0, 3 }));
  EXPECT_EQ(frame.points(), (Doubles{ 0.1, 0.2, 0.3, 0, 0, 0 }));
  EXPECT_EQ(dump.read(everything()).names(),
    "id type mol x y z image v quat c_a element i_flag d_heat radius proc");
}

TEST(ReadDump, VectorsWhoseColumnsStandInAnotherOrder)
{
  const Dump dump(one_frame("vz z id vx y vy x", "3 30 1 1 20 2 10\n"));
  EXPECT_EQ(dump.read().values("v"), (Doubles{ 1, 2, 3 }));
  EXPECT_EQ(dump.read().points(), (Doubles{ 10, 20, 30 }));
}

TEST(ReadDump, TrapDuplicateColumns)
{
  const Dump dump(one_frame("id id x x y z c_b[1] c_b[1] c_b[3]", "1 2 3 4 5 6 7 8 9\n"));
  const Decoded frame = dump.read(everything());
  EXPECT_EQ(frame.names(), "id id_2 x x_2 y z c_b[1] c_b[1]_2 c_b[3]");
  EXPECT_EQ(frame.integers("id_2"), Integers{ 2 });
  EXPECT_EQ(frame.values("x_2"), Doubles{ 4 });
  EXPECT_EQ(frame.values("c_b[1]_2"), Doubles{ 8 });
  EXPECT_EQ(frame.points(), (Doubles{ 3, 5, 6 }));
}

TEST(ReadDump, RadiusFromDiameter)
{
  const Dump dump(one_frame("id x y z diameter", "1 0 0 0 0.3\n2 0 0 0 5e-324\n"));
  EXPECT_EQ(dump.read().values("radius"), (Doubles{ 0.15, 0 }));
  EXPECT_EQ(dump.read().values("diameter"), (Doubles{ 0.3, 5e-324 }));
  const Decoded only = dump.read(wanting({ "radius" }));
  EXPECT_EQ(only.names(), "radius");
  EXPECT_EQ(only.values("radius"), (Doubles{ 0.15, 0 }));

  HardCase hard("radii",
    "from diameters of 1e-300 to 1e300 in text: not half of the nearest double", "radii", 0);
  std::mt19937_64 random(1);
  std::string rows;
  Doubles halves;
  for (int i = 1; i <= 10000; ++i)
  {
    const std::string word =
      std::to_string(random()) + "e" + std::to_string(static_cast<int>(random() % 600) - 320);
    rows += std::to_string(i) + " 0 0 0 " + word + "\n";
    halves.push_back(std::strtod(word.c_str(), nullptr) / 2);
  }
  const Dump many(one_frame("id x y z diameter", rows));
  const Doubles radii = many.read().values("radius");
  ASSERT_EQ(radii.size(), halves.size());
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    hard.add(radii[i] == halves[i] ? 0 : 1);
  }
}

TEST(ReadDump, ArraysThatNobodyWantsAreNeitherThereNorParsed)
{
  const Dump dump(one_frame("id mol x y z q element", "1 zwei 0.5 0.5 0.5 !? Si\n"));
  const Decoded frame = dump.read(wanting({ "id", "element" }));
  EXPECT_EQ(frame.names(), "id element");
  EXPECT_EQ(frame.texts("element"), Texts{ "Si" });
  const Decoded none = dump.read(wanting({}));
  EXPECT_EQ(none.names(), "");
  EXPECT_EQ(none.points(), (Doubles{ 0.5, 0.5, 0.5 }));
  // q holds texts: the first one is no number
  EXPECT_EQ(
    dump.error(wanting({ "mol" })), "memory:10: column 'mol': expected a number, got 'zwei'");
}

TEST(ReadDump, CoordinateColumnsAsArraysAndAsPoints)
{
  const Dump dump(
    one_frame("id x y z xs ys zs", "1 5 10 20 0.5 0.25 0.125\n", " pp pp pp\n0 10\n0 40\n0 160\n"));
  Request request = everything();
  request.coordinates = Coordinates::Absolute;
  request.point_origin = { 1, 2, 3 };
  const Decoded frame = dump.read(request);
  EXPECT_EQ(frame.points(), (Doubles{ 4, 8, 17 }));
  EXPECT_EQ(frame.values("x"), Doubles{ 5 });
  EXPECT_EQ(frame.values("zs"), Doubles{ 0.125 });
}

TEST(ReadDump, TrapHundredsOfColumns)
{
  std::string columns = "id x y z";
  std::string row = "1 0.1 0.2 0.3";
  for (int i = 1; i <= 700; ++i)
  {
    columns += " c_wide[" + std::to_string(i) + "]";
    row += " " + std::to_string(i) + ".5";
  }
  const Dump dump(one_frame(columns, row + "\n" + row + " \n"));
  const Decoded frame = dump.read();
  ASSERT_EQ(frame.names(), "id c_wide");
  const Doubles values = frame.values("c_wide");
  ASSERT_EQ(values.size(), 1400u);
  EXPECT_EQ(values[0], 1.5);
  EXPECT_EQ(values[699], 700.5);
  EXPECT_EQ(values[1399], 700.5);
}

TEST(ReadDump, ManyBatches)
{
  for (const std::int64_t count : { 1, 2047, 2048, 2049, 4096, 10'007 })
  {
    expect_rows(Dump(many_rows(count)).read(), count, [](std::int64_t) { return true; });
  }
}

// ---- coordinates -------------------------------------------------------------------------------

namespace
{
const char* const wide_box = " pp pp pp\n10 20\n-4 4\n0 16\n";
}

TEST(ReadDump, CoordinatesFromEveryForm)
{
  // the same particle: absolute (15, 2, 4), images (1, -1, 2)
  const std::string images = " 1 -1 2\n";
  const std::vector<std::string> dumps = {
    one_frame("x y z ix iy iz", "15 2 4" + images, wide_box),
    one_frame("xs ys zs ix iy iz", "0.5 0.75 0.25" + images, wide_box),
    one_frame("xu yu zu ix iy iz", "25 -6 36" + images, wide_box),
    one_frame("xsu ysu zsu ix iy iz", "1.5 -0.25 2.25" + images, wide_box),
  };
  for (const std::string& text : dumps)
  {
    const Dump dump(text);
    const Decoded absolute = dump.read(with_coordinates(Coordinates::Absolute));
    const Decoded unwrapped = dump.read(with_coordinates(Coordinates::Unwrapped));
    const Decoded scaled = dump.read(with_coordinates(Coordinates::Scaled));
    EXPECT_EQ(absolute.points(), (Doubles{ 15, 2, 4 })) << text;
    EXPECT_EQ(unwrapped.points(), (Doubles{ 25, -6, 36 })) << text;
    EXPECT_EQ(scaled.points(), (Doubles{ 0.5, 0.75, 0.25 })) << text;
    EXPECT_EQ(absolute.frame.coordinates, Coordinates::Absolute);
    EXPECT_EQ(unwrapped.frame.coordinates, Coordinates::Unwrapped);
    EXPECT_EQ(scaled.frame.coordinates, Coordinates::Scaled);
    EXPECT_EQ(absolute.said() + unwrapped.said() + scaled.said(), "");
    EXPECT_EQ(absolute.integers("image"), (Integers{ 1, -1, 2 }));
  }
}

TEST(ReadDump, MissingImagesAreSaidOnce)
{
  const Dump dump(one_frame("id xu yu zu", "1 25 -6 36\n2 25 -6 36\n", wide_box));
  const Decoded frame = dump.read(with_coordinates(Coordinates::Absolute));
  EXPECT_EQ(frame.frame.coordinates, Coordinates::Unwrapped);
  EXPECT_EQ(frame.points(), (Doubles{ 25, -6, 36, 25, -6, 36 }));
  EXPECT_EQ(frame.said(),
    "memory:1: expected image counts ix iy iz to make Absolute coordinates, got none; the points "
    "are "
    "Unwrapped\n");
}

TEST(ReadDump, TrapAMissingCoordinateIsZero)
{
  const Dump dump(one_frame("id x y", "1 15 2\n", wide_box));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.points(), (Doubles{ 15, 2, 0 }));
  EXPECT_EQ(frame.said(), "memory:1: no column for the coordinate z; it is set to 0\n");
}

TEST(ReadDump, PointOriginIsSubtractedBeforeRounding)
{
  const Dump dump(
    one_frame("x y z", "1000000.0123456789 -1e6 0.1\n", " ff ff ff\n0 2e6\n-2e6 0\n0 1\n"));
  Request request;
  request.single_precision = true;
  request.point_origin = { 1e6, -1e6, 0.1 };
  const std::vector<float> points = dump.read(request).single_points();
  // the double nearest to 1000000.0123456789 is that far from 1e6
  EXPECT_EQ(points[0], static_cast<float>(1000000.0123456789 - 1e6));
  EXPECT_NEAR(static_cast<double>(points[0]), 0.0123456789, 1e-9);
  EXPECT_EQ(points[1], 0.0f);
  EXPECT_EQ(points[2], 0.0f);
  request.point_origin = {};
  EXPECT_EQ(dump.read(request).single_points()[0], 1000000.0f);
}

// ---- stride ------------------------------------------------------------------------------------

TEST(ReadDump, StrideById)
{
  const Dump dump(many_rows(7000));
  for (const std::int64_t stride : { 2, 3, 10, 2048, 5000, 100'000 })
  {
    expect_rows(dump.read(with_stride(stride)), 7000,
      [stride](std::int64_t row) { return id_of(row) % stride == 0; });
  }
}

/// Where many rows are wanted all are decoded, but words of the others are nobody's business.
TEST(ReadDump, StrideReadsNothingElseOfOtherRows)
{
  constexpr std::int64_t count = 9000; // more than are decoded at a time
  constexpr std::int64_t lines_before = 9;
  const auto text = [](std::int64_t bad_row)
  {
    std::string rows;
    for (std::int64_t row = 0; row < count; ++row)
    {
      rows += std::to_string(row) + " " + std::to_string(row) +
        (row == bad_row ? " half " : " 0.5 ") + std::to_string(row % 10) + " 1e" +
        std::to_string(row % 7) + "\n";
    }
    return one_frame("id x y z q", rows);
  };
  for (const std::int64_t stride : { 2, 3, 4, 5, 1000 })
  {
    Doubles points;
    Doubles charges;
    Integers ids;
    for (std::int64_t row = 0; row < count; row += stride)
    {
      points.insert(points.end(), { static_cast<double>(row), 0.5, static_cast<double>(row % 10) });
      charges.push_back(std::pow(10.0, static_cast<double>(row % 7)));
      ids.push_back(row);
    }
    for (const std::int64_t bad_row : { std::int64_t{ -1 }, std::int64_t{ 1 }, stride - 1,
           7 * stride + 1, count / stride * stride - 1 })
    {
      for (const int threads : { 1, 2 })
      {
        const std::string bad = text(bad_row);
        const Decoded frame = Dump(bad).read(in_chunks(with_stride(stride), threads, 20'000));
        EXPECT_TRUE(frame.points() == points) << "stride " << stride << ", row " << bad_row;
        EXPECT_TRUE(frame.values("q") == charges);
        EXPECT_TRUE(frame.integers("id") == ids);
      }
    }
    const std::int64_t bad_row = 6000 / stride * stride;
    const std::string bad = text(bad_row);
    EXPECT_EQ(error_of([&] { Dump(bad).read(with_stride(stride)); }),
      "memory:" + std::to_string(lines_before + bad_row + 1) +
        ": column 'y': expected a number, got 'half'");
  }
}

/// More or fewer words than columns are what they are without Stride, also behind the rows that are decoded first.
TEST(ReadDump, StrideSeesLinesOfOtherLengths)
{
  constexpr std::int64_t count = 9000;
  const auto text = [](std::int64_t bad_row, const std::string& bad)
  {
    std::string rows;
    for (std::int64_t row = 0; row < count; ++row)
    {
      const std::string id = std::to_string(row);
      rows += id + (row == bad_row ? bad : " 1 2 3") + "\n";
    }
    return one_frame("id x y z", rows);
  };
  for (const std::int64_t row : { 1, 5001, 8999, 5000 })
  {
    const std::string more = text(row, " 1 2 3 4");
    EXPECT_EQ(Dump(more).error(with_stride(2)), Dump(more).error()) << row;
    EXPECT_NE(Dump(more).error(with_stride(2)), "") << row;
    const std::string fewer = text(row, " 1 2");
    const auto error = [&](const Request& request)
    { return error_of([&] { Dump(fewer).read(request); }); };
    EXPECT_EQ(error(with_stride(2)), error({})) << row;
    EXPECT_NE(error({}), "") << row;
  }
}

TEST(ReadDump, StrideByRowWhereThereAreNoIds)
{
  const Dump dump(many_rows(7000, "x y z q ix iy iz element"));
  for (const std::int64_t stride : { 2, 3, 7, 2047, 2048, 2049, 6999, 7000 })
  {
    expect_rows(dump.read(with_stride(stride)), 7000,
      [stride](std::int64_t row) { return row % stride == 0; });
  }
}

TEST(ReadDump, StrideByIdThatIsNoArray)
{
  const Dump dump(many_rows(7000));
  Request request = with_stride(5);
  request.wanted = [](std::string_view name, bool is_usual) { return name != "id" && is_usual; };
  const Decoded frame = dump.read(request);
  EXPECT_FALSE(frame.has("id"));
  expect_rows(frame, 7000, [](std::int64_t row) { return id_of(row) % 5 == 0; });
}

TEST(ReadDump, TrapIdsThatAreZeroNegativeOrLarge)
{
  const Dump dump(one_frame("id x y z",
    "0 1 0 0\n-4 2 0 0\n-3 3 0 0\n9223372036854775806 4 0 0\n4294967296 5 0 0\n9223372036854775807 "
    "6 0 0\n"));
  EXPECT_EQ(
    dump.read(with_stride(2)).integers("id"), (Integers{ 0, -4, 9223372036854775806, 4294967296 }));
  EXPECT_EQ(dump.read(sorted()).integers("id"),
    (Integers{ -4, -3, 0, 4294967296, 9223372036854775806, 9223372036854775807 }));
}

TEST(ReadDump, StrideMustBePositive)
{
  const Dump dump(many_rows(3));
  EXPECT_EQ(dump.error(with_stride(0)), "expected a stride >= 1, got 0");
  EXPECT_EQ(dump.error(with_stride(-2)), "expected a stride >= 1, got -2");
}

// ---- region ------------------------------------------------------------------------------------

TEST(ReadDump, RegionIsClosedAndPerAxis)
{
  const Dump dump(one_frame("id x y z",
    "1 0 0 0\n2 1 1 1\n3 1.0000000000000002 1 1\n4 -1e-300 0 0\n5 0.5 2 0.5\n6 0.5 0.5 -9\n"));
  EXPECT_EQ(dump.read(with_region({ 0, 1, 0, 1, 0, 1 })).integers("id"), (Integers{ 1, 2 }));
  EXPECT_EQ(
    dump.read(with_region({ 0, 1, 1, -1, 1, -1 })).integers("id"), (Integers{ 1, 2, 5, 6 }));
  EXPECT_EQ(dump.read(with_region({ 1, -1, 2, 2, 1, -1 })).integers("id"), Integers{ 5 });
  EXPECT_EQ(dump.read(with_region({ 1, -1, 1, -1, 1, -1 })).rows(), 6);
  EXPECT_EQ(dump.read(with_region({ 50, 60, 0, 1, 0, 1 })).rows(), 0);
}

TEST(ReadDump, NanIsInNoRegion)
{
  const Dump dump(
    one_frame("id x y z", "1 nan 0.5 0.5\n2 0.5 nan 0.5\n3 0.5 0.5 0.5\n4 inf 0.5 0.5\n"));
  const double inf = HUGE_VAL;
  EXPECT_EQ(dump.read(with_region({ 0, 1, 1, -1, 1, -1 })).integers("id"), (Integers{ 2, 3 }));
  EXPECT_EQ(
    dump.read(with_region({ -inf, inf, 1, -1, 1, -1 })).integers("id"), (Integers{ 2, 3, 4 }));
  EXPECT_EQ(dump.read(with_region({ 1, -1, 1, -1, 1, -1 })).rows(), 4);
  // no region at all
  EXPECT_EQ(dump.read(with_region({ std::nan(""), 1, 1, -1, 1, -1 })).rows(), 4);
}

TEST(ReadDump, RegionIsInAbsoluteCoordinatesBeforeThePointOrigin)
{
  const Dump dump(
    one_frame("id xs ys zs ix iy iz", "1 0.5 0.5 0.5 3 0 0\n2 0.1 0.5 0.5 0 0 0\n", wide_box));
  Request request = with_region({ 14, 16, 1, -1, 1, -1 });
  request.point_origin = { 100, 100, 100 };
  for (const Coordinates coordinates :
    { Coordinates::Absolute, Coordinates::Unwrapped, Coordinates::Scaled })
  {
    request.coordinates = coordinates;
    EXPECT_EQ(dump.read(request).integers("id"), Integers{ 1 }) << to_string(coordinates);
  }
}

TEST(ReadDump, RegionWhereThereAreNoAbsoluteCoordinatesIsSaid)
{
  const Dump dump(one_frame("id xu yu zu", "1 45 0 1\n2 15 0 1\n", wide_box));
  Request request = with_region({ 40, 50, 1, -1, 1, -1 });
  request.coordinates = Coordinates::Unwrapped;
  const Decoded frame = dump.read(request);
  EXPECT_EQ(frame.integers("id"), Integers{ 1 });
  EXPECT_EQ(frame.said(),
    "memory:1: expected image counts ix iy iz to make Absolute coordinates for the region, got "
    "none; "
    "the region is in Unwrapped coordinates\n");
  // asked for absolute points, that was said already
  request.coordinates = Coordinates::Absolute;
  EXPECT_EQ(dump.read(request).notices.size(), 1u);
}

TEST(ReadDump, RegionAcrossBatches)
{
  const Dump dump(many_rows(7000));
  expect_rows(dump.read(with_region({ 1000, 5000.5, 1, -1, 3, 4 })), 7000,
    [](std::int64_t row)
    { return row >= 1000 && row <= 5000 && (row % 10 == 3 || row % 10 == 4); });
}

TEST(ReadDump, StrideAndRegionAndSort)
{
  const std::int64_t count = 7000;
  const Dump dump(many_rows(count));
  Request request = with_region({ 100, 6000, 1, -1, 1, -1 });
  request.stride = 3;
  request.sort_by_id = true;
  request.coordinates = Coordinates::Unwrapped;
  const Decoded frame = dump.read(request);
  std::vector<std::pair<std::int64_t, std::int64_t>> expected;
  for (std::int64_t row = 100; row <= 6000; ++row)
  {
    if (id_of(row) % 3 == 0)
    {
      expected.emplace_back(id_of(row), row);
    }
  }
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(frame.rows(), static_cast<std::int64_t>(expected.size()));
  const Doubles points = frame.points();
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const auto [id, row] = expected[i];
    ASSERT_EQ(frame.integers("id")[i], id);
    ASSERT_EQ(frame.values("q")[i], static_cast<double>(id));
    ASSERT_EQ(points[3 * i], static_cast<double>(row + row % 3)); // the box is 1 wide
    ASSERT_EQ(frame.texts("element")[i], "E" + std::to_string(row));
  }
}

// ---- order -------------------------------------------------------------------------------------

TEST(ReadDump, SortsEverythingById)
{
  const Dump dump(one_frame("id x y z vx vy vz element type",
    "30 3 0 0 3 3.5 0 C 3\n10 1 0 0 1 1.5 0 A 1\n20 2 0 0 2 2.5 0 B 2\n"));
  const Decoded frame = dump.read(sorted());
  EXPECT_EQ(frame.integers("id"), (Integers{ 10, 20, 30 }));
  EXPECT_EQ(frame.points(), (Doubles{ 1, 0, 0, 2, 0, 0, 3, 0, 0 }));
  EXPECT_EQ(frame.values("v"), (Doubles{ 1, 1.5, 0, 2, 2.5, 0, 3, 3.5, 0 }));
  EXPECT_EQ(frame.texts("element"), (Texts{ "A", "B", "C" }));
  EXPECT_EQ(frame.integers("type"), (Integers{ 1, 2, 3 }));
  EXPECT_EQ(dump.read().integers("id"), (Integers{ 30, 10, 20 })) << "else the order is the file's";
}

TEST(ReadDump, RowsOfTheSameIdKeepTheirOrder)
{
  std::string rows;
  for (int row = 0; row < 3000; ++row)
  {
    rows += std::to_string(row % 7) + " " + std::to_string(row) + " 0 0\n";
  }
  const Decoded frame = Dump(one_frame("id x y z", rows)).read(sorted());
  const Doubles points = frame.points();
  const Integers ids = frame.integers("id");
  for (std::size_t i = 1; i < 3000; ++i)
  {
    ASSERT_LE(ids[i - 1], ids[i]);
    ASSERT_TRUE(ids[i - 1] < ids[i] || points[3 * (i - 1)] < points[3 * i]);
  }
}

TEST(ReadDump, SortsByAnIdThatIsNoArray)
{
  Request request = wanting({ "q" });
  request.sort_by_id = true;
  const Decoded frame =
    Dump(one_frame("id x y z q", "3 0 0 0 30\n1 0 0 0 10\n2 0 0 0 20\n")).read(request);
  EXPECT_EQ(frame.names(), "q");
  EXPECT_EQ(frame.values("q"), (Doubles{ 10, 20, 30 }));
}

TEST(ReadDump, TrapNoIdsToSortBy)
{
  const Decoded frame = Dump(one_frame("x y z", "3 0 0\n1 0 0\n")).read(sorted());
  EXPECT_EQ(frame.points(), (Doubles{ 3, 0, 0, 1, 0, 0 }));
  EXPECT_EQ(
    frame.said(), "memory:1: expected a column id to sort by, got none; the order is the file's\n");
}

// ---- numbers that are no integers --------------------------------------------------------------

TEST(ReadDump, IntegerColumnsThatHoldOtherNumbersBecomeDoubles)
{
  const Dump dump(one_frame("id type x y z ix iy iz mol",
    "1 1 0 0 0 1 2 3 7\n2 1.5 0 0 0 1 2147483648 3 9223372036854775808\n"));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.type("type"), ValueType::Float64);
  EXPECT_EQ(frame.values("type"), (Doubles{ 1, 1.5 }));
  EXPECT_EQ(frame.type("image"), ValueType::Float64);
  EXPECT_EQ(frame.values("image"), (Doubles{ 1, 2, 3, 1, 2147483648.0, 3 }));
  EXPECT_EQ(frame.values("mol"), (Doubles{ 7, 9223372036854775808.0 }));
  EXPECT_EQ(frame.type("id"), ValueType::Int64);
  EXPECT_EQ(frame.said(),
    "memory:11: column 'type': expected an integer, got '1.5'; the column is kept as doubles\n"
    "memory:11: column 'iy': expected an integer, got '2147483648'; the column is kept as doubles\n"
    "memory:11: column 'mol': expected an integer, got '9223372036854775808'; the column is kept "
    "as "
    "doubles\n");
  EXPECT_EQ(dump.entry().kind->schema.arrays()[1].type, ValueType::Int32)
    << "the index stays as it was";
}

// They are found together, and said in the order of the file; a word that must be a number is the error that it is alone.
TEST(ReadDump, MisfitsOfSeveralRows)
{
  const auto dump = [](const std::string& last)
  {
    return Dump(replaced(one_frame("id type x y z ix iy iz mol word",
                           "1 1 0 0 0 1 2 3 7 0\n \n2 1.5 0 0 0 1 2 3 7 0\n"
                           "3 1 0 0 0 1 2 3 0.5 a # comment\n4 2.5 0 0 0 1.5 0.5 3 1.5 b\n" +
                             last),
      "ATOMS\n6\n", "ATOMS\n5\n"));
  };
  const Decoded frame = dump("5 1 0 0 0 1 2 3 4 5\n").read();
  EXPECT_EQ(frame.values("type"), (Doubles{ 1, 1.5, 1, 2.5, 1 }));
  EXPECT_EQ(frame.values("image")[9], 1.5);
  EXPECT_EQ(frame.values("mol"), (Doubles{ 7, 7, 0.5, 1.5, 4 }));
  EXPECT_EQ(frame.texts("word"), (std::vector<std::string>{ "0", "0", "a", "b", "5" }));
  EXPECT_EQ(frame.said(),
    "memory:12: column 'type': expected an integer, got '1.5'; the column is kept as doubles\n"
    "memory:13: column 'mol': expected an integer, got '0.5'; the column is kept as doubles\n"
    "memory:13: column 'word': expected a number, got 'a'; the column is kept as texts\n"
    "memory:14: column 'ix': expected an integer, got '1.5'; the column is kept as doubles\n");
  EXPECT_EQ(
    dump("5 1 0 0 0 1 2 ? 4 5\n").error(), "memory:15: column 'iz': expected a number, got '?'");
  EXPECT_EQ(dump("5.5 1 0 0 0 1 2 3 4 5\n").error(),
    "memory:15: column 'id': expected an integer, got '5.5'");
}

TEST(ReadDump, WidenedImagesStillMoveThePoints)
{
  const Dump dump(
    one_frame("id x y z ix iy iz", "1 15 0 0 3000000000 0 0\n2 15 0 0 0.5 0 0\n", wide_box));
  const Decoded frame = dump.read(with_coordinates(Coordinates::Unwrapped));
  EXPECT_EQ(frame.points()[0], 15 + 10 * 3e9);
  EXPECT_EQ(frame.points()[3], 20);
}

TEST(ReadDump, MisfitsDeepInTheFrameWithFilters)
{
  std::string rows;
  for (int row = 0; row < 5000; ++row)
  {
    rows +=
      std::to_string(row) + (row == 4500 ? " 2.5" : " 2") + " 0 0 0 e" + std::to_string(row) + "\n";
  }
  Request request = with_stride(4);
  const Decoded frame = Dump(one_frame("id type x y z element", rows)).read(request);
  EXPECT_EQ(frame.rows(), 1250);
  EXPECT_EQ(frame.values("type")[1125], 2.5);
  EXPECT_EQ(frame.values("type")[1124], 2);
  EXPECT_EQ(frame.texts("element")[1125], "e4500");
  EXPECT_EQ(frame.said(),
    "memory:4510: column 'type': expected an integer, got '2.5'; the column is kept as doubles\n");
}

TEST(ReadDump, IdsMustBeIntegers)
{
  EXPECT_EQ(Dump(one_frame("id x y z", "9223372036854775808 0 0 0\n")).error(),
    "memory:10: column 'id': expected an integer, got '9223372036854775808'");
  EXPECT_EQ(Dump(one_frame("id x y z", "nan 0 0 0\n")).error(sorted()),
    "memory:10: column 'id': expected an integer, got 'nan'");
  // as "%g" prints 1000000: fine as long as it is one
  EXPECT_EQ(
    Dump(one_frame("id x y z", "1e+06 0 0 0\n")).read().integers("id"), Integers{ 1000000 });
  // and who does not ask for it does not hear of it
  EXPECT_EQ(Dump(one_frame("id x y z", "2.5 0 0 0\n")).error(wanting({})), "");
}

// ---- rows that are not as they should be -------------------------------------------------------

TEST(ReadDump, TrapMoreWordsThanColumns)
{
  const Dump dump(one_frame("id x y z", "1 0 0 0\n2 0 0 1\n3 0 0 2 18\n"));
  for (const Request& request : { Request{}, with_stride(2) })
  {
    EXPECT_EQ(dump.error(request), "memory:12: expected 4 words in a row, got 5");
  }
}

TEST(ReadDump, TrapFewerWordsThanColumns)
{
  EXPECT_EQ(Dump(one_frame("id x y z", "1 0 0 0\n2 0 0\n")).error(),
    "memory:11: expected 4 words in a row, got 3");
  std::string rows;
  for (int row = 0; row < 5000; ++row)
  {
    rows += row == 4321 ? "1 2\n" : "1 0 0 0\n";
  }
  EXPECT_EQ(
    Dump(one_frame("id x y z", rows)).error(), "memory:4331: expected 4 words in a row, got 2");
}

TEST(ReadDump, WordsThatAreNoNumbers)
{
  EXPECT_EQ(
    Dump(one_frame("id x y z q", "1 0 0 0 1\n2 0 0 0 " + std::string(100, 'x') + "\n")).error(),
    "memory:11: column 'q': expected a number, got '" + std::string(40, 'x') + "...'");
  EXPECT_EQ(Dump(one_frame("id x y z q", "1 0 0 0 1\n2 0 0 0 \xff\x7f\n")).error(),
    "memory:11: column 'q': expected a number, got '?"
    "?'");
}

TEST(ReadDump, LineNumbersCountBlankLinesAndFramesBefore)
{
  const Dump dump("\n" + one_frame("id x y z", "1 0 0 0\n") + "\n\n" +
    one_frame("id x y z", "1 0 0 0\n2 0 bad 0\n"));
  EXPECT_EQ(dump.error({}, 1), "memory:24: column 'y': expected a number, got 'bad'");
}

// ---- files that change between index and read --------------------------------------------------

/// Another frame where the ends of the file, by which the index knows it, are as they were.
TEST(ReadDump, AFileThatChangedSinceItWasIndexed)
{
  const Folder folder;
  const std::string large = particles(0, ids_from(0, 1000));
  const std::string path = folder.write("a.dump", large + particles(100, ids_from(0, 3)) + large);
  Series run;
  run.update({ path });
  ASSERT_EQ(run.index.size(), 2u);
  EXPECT_EQ(error_of([&] { run.read(1); }), "");
  folder.write("a.dump", large + particles(101, ids_from(0, 3)) + large);
  EXPECT_EQ(error_of([&] { run.read(1); }),
    path +
      ":1010: the file changed since it was indexed: expected the frame of timestep 100; reload "
      "the "
      "files");
}

TEST(ReadDump, TrapFramesWithoutAtomsWithEveryRequest)
{
  const Dump dump(one_frame("id x y z element vx vy vz", ""));
  Request request = with_region({ 0, 1, 0, 1, 0, 1 });
  request.stride = 3;
  request.sort_by_id = true;
  request.single_precision = true;
  request.coordinates = Coordinates::Scaled;
  const Decoded frame = dump.read(request);
  EXPECT_EQ(frame.rows(), 0);
  EXPECT_EQ(frame.names(), "id element v");
  EXPECT_TRUE(frame.single_points().empty());
  EXPECT_NE(frame.frame.points.data(), nullptr);
}
