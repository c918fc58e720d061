// SPDX-License-Identifier: BSD-3-Clause
// Lines joined with the particles at their ends: what a std::map finds, in exact numbers.
#include "granular/lines/join.h"

#include "granular/lines/id_finder.h"

#include "../support/error_of.h"
#include "../support/stop.h"
#include "../support/thread_ranks.h"
#include "join_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

using namespace granular;
using namespace join_checks;

namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double most = std::numeric_limits<double>::max();
constexpr double least = std::numeric_limits<double>::denorm_min();

/// On one process, and on two to four.
void on_ranks(const std::function<void(Communicator& ranks)>& check)
{
  SerialCommunicator alone;
  check(alone);
  for (const int ranks : { 1, 2, 3, 4 })
  {
    SCOPED_TRACE(ranks);
    run_ranks(ranks, check);
  }
}

/// Three particles with ids 4, 5, 6, in places (0, 0, 0), (1, 10, 100), (2, 20, 200).
struct Three
{
  Three()
  {
    view.rows = 3;
    view.has_box = false;
    view.points = view_rows("points", ValueType::Float64, points.data(), 3);
    view.arrays = { view_rows("id", ValueType::Int64, ids.data()) };
  }

  std::vector<Id> ids = { 4, 5, 6 };
  std::vector<double> points = { 0, 0, 0, 1, 10, 100, 2, 20, 200 };
  FrameView view;
};

std::vector<double> numbers(const Block& block)
{
  const auto* const first = static_cast<const double*>(block.data());
  return { first, first + block.bytes() / sizeof(double) };
}

JoinedLines join_alone(
  const FrameView& view, const std::vector<Line>& lines, const JoinRequest& request = {})
{
  SerialCommunicator alone;
  return join(view, lines, request, alone);
}

template <class Value>
void expect_ids_of(ValueType type)
{
  Three three;
  const std::vector<Value> ids = { 4, 5, 6 };
  three.view.arrays = { view_rows("id", type, ids.data()) };
  const JoinedLines joined = join_alone(three.view, { { 7, 4 }, { 6, 5 } });
  EXPECT_EQ(joined.count, 1);
  EXPECT_EQ(joined.rows, std::vector<Id>{ 1 });
  EXPECT_EQ(numbers(joined.first), (std::vector<double>{ 2, 20, 200 }));
  EXPECT_EQ(numbers(joined.second), (std::vector<double>{ 1, 10, 100 }));
}

/// The message for an id of that type.
template <class Value>
std::string refusal(ValueType type, Value value)
{
  Three three;
  const std::vector<Value> ids = { 4, 5, value };
  three.view.arrays = { view_rows("id", type, ids.data()) };
  return error_of([&] { join_alone(three.view, { { 4, 5 } }); });
}
}

TEST(LocalJoin, AnyIdsAnywhere)
{
  on_ranks(check_joins);
}

TEST(LocalJoin, GhostsAreLeftOut)
{
  on_ranks(check_ghosts);
}

TEST(LocalJoin, OfRepeatedIdsTheFirstCounts)
{
  on_ranks(check_repeated);
}

TEST(LocalJoin, OneTouchesAll)
{
  on_ranks(check_hub);
}

/// A particle with a million partners, on one process and on three, of which the last has all rows.
TEST(LocalJoin, AMillionPartners)
{
  constexpr std::int64_t partners = 1'000'000;
  constexpr std::int64_t hub = 500'000;
  const auto id_of = [](std::int64_t number) { return number * 7919 - 5; };
  for (const int size : { 1, 3 })
  {
    run_ranks(size,
      [&](Communicator& ranks)
      {
        std::vector<std::int64_t> ids;
        std::vector<double> points;
        for (std::int64_t i = ranks.rank(); i <= partners; i += size)
        {
          ids.push_back(id_of(i));
          points.insert(points.end(), { static_cast<double>(i), 1, 2 });
        }
        FrameView view;
        view.rows = std::ssize(ids);
        view.has_box = false;
        view.points = view_rows("points", ValueType::Float64, points.data(), 3);
        view.arrays = { view_rows("id", ValueType::Int64, ids.data()) };
        const std::int64_t rows = ranks.rank() == size - 1 ? partners + 1 : 0;
        const std::vector<std::int64_t> id1(static_cast<std::size_t>(rows), id_of(hub));
        std::vector<std::int64_t> id2;
        for (std::int64_t i = 0; i < rows; ++i)
        {
          id2.push_back(id_of(i));
        }
        Progress progress;
        const JoinedLines lines = join_lines(view, id1, id2, {}, ranks, progress);
        ASSERT_EQ(lines.count, rows);
        EXPECT_EQ(lines.missing, 0);
        EXPECT_EQ(lines.repeated, 0);
        const auto* const first = static_cast<const double*>(lines.first.data());
        const auto* const second = static_cast<const double*>(lines.second.data());
        std::int64_t wrong = 0;
        for (std::int64_t i = 0; i < rows; ++i)
        {
          wrong +=
            first[3 * i] != static_cast<double>(hub) || second[3 * i] != static_cast<double>(i);
        }
        EXPECT_EQ(wrong, 0);
      });
  }
}

/// More than one chunk of rows, of which some are left out.
TEST(LocalJoin, ManyRows)
{
  std::mt19937_64 random(3);
  const auto particles = make_particles(id_kinds()[1], 2000, random);
  SerialCommunicator alone;
  check_spread(alone, particles, first_rank, make_lines(particles, 200'000, random), first_rank);
}

TEST(LocalJoin, ToItself)
{
  const Three three;
  const JoinedLines joined = join_alone(three.view, { { 5, 5 } });
  EXPECT_EQ(numbers(joined.first), numbers(joined.second));
  EXPECT_EQ(joined.count, 1);
  EXPECT_TRUE(joined.rows.empty()); // all
}

TEST(LocalJoin, IdsOfAnyType)
{
  expect_ids_of<std::int8_t>(ValueType::Int8);
  expect_ids_of<std::uint8_t>(ValueType::UInt8);
  expect_ids_of<std::int16_t>(ValueType::Int16);
  expect_ids_of<std::uint16_t>(ValueType::UInt16);
  expect_ids_of<std::int32_t>(ValueType::Int32);
  expect_ids_of<std::uint32_t>(ValueType::UInt32);
  expect_ids_of<std::int64_t>(ValueType::Int64);
  expect_ids_of<std::uint64_t>(ValueType::UInt64);
  expect_ids_of<float>(ValueType::Float32);
  expect_ids_of<double>(ValueType::Float64);
}

TEST(LocalJoin, IdsThatAreNone)
{
  const auto text = [](const std::string& value)
  {
    return "column 'id': expected a 64-bit integer as id, got " + value +
      " in row 2 (the first is 0)";
  };
  EXPECT_EQ(refusal(ValueType::Float64, 6.5), text("6.5"));
  EXPECT_EQ(refusal(ValueType::Float32, 0.25F), text("0.25"));
  EXPECT_EQ(refusal(ValueType::Float64, no_number), text("nan"));
  EXPECT_EQ(refusal(ValueType::Float64, -infinity), text("-inf"));
  EXPECT_EQ(refusal(ValueType::Float64, 0x1p63), text("9223372036854775808"));
  EXPECT_EQ(refusal(ValueType::UInt64, ~std::uint64_t{ 0 }), text("18446744073709551615"));
  EXPECT_EQ(refusal(ValueType::Float64, -0x1p63), "");
}

TEST(LocalJoin, MeansAndDifferences)
{
  Three three;
  const std::vector<double> values = { most, most, -most };
  const std::vector<double> small = { least, least, 3 * least };
  const std::vector<double> odd = { infinity, no_number, infinity };
  const std::vector<std::uint8_t> bytes = { 250, 255, 0 };
  three.view.arrays.push_back(view_rows("large", ValueType::Float64, values.data()));
  three.view.arrays.push_back(view_rows("small", ValueType::Float64, small.data()));
  three.view.arrays.push_back(view_rows("odd", ValueType::Float64, odd.data()));
  three.view.arrays.push_back(view_rows("bytes", ValueType::UInt8, bytes.data()));
  const JoinedLines joined = join_alone(three.view, { { 4, 5 }, { 5, 6 }, { 4, 6 } },
    { { "large", "small", "odd", "bytes" }, { "large", "bytes" }, 1, nullptr });
  ASSERT_EQ(joined.arrays.size(), 6U);
  EXPECT_EQ(numbers(joined.arrays[0].values), (std::vector<double>{ most, 0, 0 }));
  EXPECT_EQ(numbers(joined.arrays[1].values), (std::vector<double>{ least, 2 * least, 2 * least }));
  const std::vector<double> means = numbers(joined.arrays[2].values);
  EXPECT_TRUE(std::isnan(means[0]) && std::isnan(means[1]) && means[2] == infinity);
  EXPECT_EQ(numbers(joined.arrays[3].values), (std::vector<double>{ 252.5, 127.5, 125 }));
  EXPECT_EQ(numbers(joined.arrays[4].values), (std::vector<double>{ 0, -infinity, -infinity }));
  EXPECT_EQ(joined.arrays[5].name, "bytes_difference");
  EXPECT_EQ(numbers(joined.arrays[5].values), (std::vector<double>{ 5, -255, -250 }));
}

/// Whatever the points are, ends are absolute; what is unwrapped stays where it is shown.
TEST(LocalJoin, PointsOfAllKinds)
{
  const std::vector<Line> lines = { { 4, 6 }, { 5, 5 } };
  Three three;
  three.view.point_origin = { 1000, 0, -1 };
  JoinedLines joined = join_alone(three.view, lines);
  EXPECT_EQ(numbers(joined.first), (std::vector<double>{ 1000, 0, -1, 1001, 10, 99 }));
  EXPECT_EQ(numbers(joined.second), (std::vector<double>{ 1002, 20, 199, 1001, 10, 99 }));

  three.view.has_box = true;
  three.view.header.box = Box::from_bounds({ 10, 20, 30 }, { 12, 24, 38 });
  three.view.header.box.boundary = "pp pp pp";
  three.view.point_origin = {};
  three.view.coordinates = Coordinates::Unwrapped;
  EXPECT_EQ(
    numbers(join_alone(three.view, lines).second), (std::vector<double>{ 2, 20, 200, 1, 10, 100 }));
  three.view.coordinates = Coordinates::Scaled;
  EXPECT_EQ(numbers(join_alone(three.view, lines).second),
    (std::vector<double>{ 14, 100, 1630, 12, 60, 830 }));

  const std::vector<float> floats(three.points.begin(), three.points.end());
  three.view.coordinates = Coordinates::Absolute;
  three.view.points = view_rows("points", ValueType::Float32, floats.data(), 3);
  EXPECT_EQ(
    numbers(join_alone(three.view, lines).second), (std::vector<double>{ 2, 20, 200, 1, 10, 100 }));
}

TEST(LocalJoin, Errors)
{
  const auto message = [](const FrameView& view, const std::vector<std::string>& means = {}) {
    return error_of([&] { join_alone(view, { { 4, 5 } }, { means, {}, 1, nullptr }); });
  };
  Three three;
  const std::vector<std::string> texts(3);
  EXPECT_EQ(message(three.view, { "v" }), "expected an array 'v' of the particles, got none");
  three.view.arrays.push_back(view_rows("element", ValueType::Text, texts.data()));
  EXPECT_EQ(message(three.view, { "element" }),
    "expected numbers in array 'element' of the particles, got texts");
  three.view.arrays = { view_rows("id", ValueType::Text, texts.data()) };
  EXPECT_EQ(message(three.view), "column 'id': expected one number a row, got texts");
  three.view.arrays = { view_rows("id", ValueType::Float64, three.points.data(), 3) };
  EXPECT_EQ(message(three.view), "column 'id': expected one number a row, got 3");
  three.view.arrays.clear();
  EXPECT_EQ(message(three.view), "expected an array 'id' of the particles, got none");
  Three bare;
  bare.view.points.reset();
  EXPECT_EQ(message(bare.view), "expected points of the particles, got none");
  Three scaled;
  scaled.view.coordinates = Coordinates::Scaled;
  EXPECT_EQ(message(scaled.view),
    "expected the box of scaled points in the field data (BoxOrigin, BoxVectors), got none");
}

/// What fails on one rank fails on all, and nobody waits.
TEST(LocalJoin, ErrorsOfOneRank)
{
  run_ranks(3,
    [](Communicator& ranks)
    {
      Three three;
      if (ranks.rank() == 1)
      {
        three.view.arrays.clear();
      }
      EXPECT_EQ(error_of([&] { join(three.view, {}, {}, ranks); }),
        "expected an array 'id' of the particles, got none (on rank 1 of 3)");

      Three sizes;
      sizes.view.arrays.push_back(
        view_rows("v", ValueType::Float64, sizes.points.data(), ranks.rank() == 2 ? 1 : 3));
      EXPECT_EQ(error_of(
                  [&] {
                    join(sizes.view, {}, { { "v" }, {}, 1, nullptr }, ranks);
                  }),
        "expected as many numbers a particle in array 'v' on all processes, got 3 and 1");
    });
}

TEST(LocalJoin, Cancelled)
{
  run_ranks(2,
    [](Communicator& ranks)
    {
      const Three three;
      const std::vector<Id> ids = { 4, 5 };
      Progress go;
      Stop stop(0);
      EXPECT_THROW(
        join_lines(three.view, ids, ids, {}, ranks, ranks.rank() == 0 ? stop : go), Cancelled);
    });
}

/// However regular ids are, few share a place.
TEST(LocalJoin, HashesSpread)
{
  for (int shift = 0; shift < 50; ++shift)
  {
    std::vector<int> hits(1 << 14);
    std::vector<int> keepers(7);
    for (Id i = 0; i < 1 << 13; ++i)
    {
      const std::uint64_t hash = hash_of_id(i * (Id{ 1 } << shift));
      ++hits[hash & (hits.size() - 1)];
      ++keepers[(hash >> 32) % 7];
    }
    // at random 39 % of the places would have at least one, the fullest of them 5 to 7
    EXPECT_GT(hits.size() - static_cast<std::size_t>(std::ranges::count(hits, 0)), 6000U) << shift;
    EXPECT_LT(*std::ranges::max_element(hits), 12) << shift;
    EXPECT_LT(*std::ranges::max_element(keepers), 1500) << shift;
  }
}
