// SPDX-License-Identifier: BSD-3-Clause
// The bounds of the particles of processes, on one rank and on several.
#include "../grid/made_subdomains.h"
#include "../support/error_of.h"
#include "../support/thread_ranks.h"
#include "counted_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr int most = std::numeric_limits<std::int32_t>::max();

Subdomains bounds(const FrameView& frame, const ArrayView& process, int threads = 1)
{
  Progress progress;
  return bounds_by_process(frame, process, Executor(threads), progress).subdomains;
}

Subdomains bounds(const FrameView& frame, int threads = 1)
{
  Progress progress;
  return bounds_of_particles(frame, Executor(threads), progress).subdomains;
}

/// By the scalar type and one after the other.
template <class Value>
ArrayView processes(ValueType type, const std::vector<Value>& values)
{
  return view_rows("proc", type, values.data());
}

template <class Value>
std::string error_of(ValueType type, const std::vector<Value>& values, int size = 1)
{
  const Points points(values.size() / static_cast<std::size_t>(size));
  return ::error_of(
    [&] { bounds(frame_of(points), view_rows("proc", type, values.data(), size)); });
}
}

TEST(ParticleBounds, OfEachProcessByRank)
{
  const Points points = { { 1, 2, 3 }, { 4, -1, 0 }, { 0, 0, 0 }, { -1, 5, 3 }, { 7, 7, 7 } };
  const Subdomains expected = { made_subdomain({ 0, 0, 0 }, { 0, 0, 0 }, 1, 0),
    made_subdomain({ -1, -1, 0 }, { 4, 5, 3 }, 3, 5),
    made_subdomain({ 7, 7, 7 }, { 7, 7, 7 }, 1, 90) };
  const FrameView frame = frame_of(points);
  const std::vector<std::int8_t> bytes = { 5, 5, 0, 5, 90 };
  const std::vector<std::uint64_t> unsigned_ones = { 5, 5, 0, 5, 90 };
  const std::vector<double> doubles = { 5, 5, -0.0, 5, 90 };
  EXPECT_EQ(bounds(frame, processes(ValueType::Int8, bytes)), expected);
  EXPECT_EQ(bounds(frame, processes(ValueType::UInt64, unsigned_ones)), expected);
  EXPECT_EQ(bounds(frame, processes(ValueType::Float64, doubles)), expected);
  EXPECT_EQ(bounds(frame), (Subdomains{ made_subdomain({ -1, -1, 0 }, { 7, 7, 7 }, 5, 0) }));
}

TEST(ParticleBounds, WhatHasNoPlaceAndDuplicatesAreLeftOut)
{
  const Points points = { { 1, 2, 3 }, { no_number, 0, 0 }, { 9, 9, infinity }, { 0, -infinity, 0 },
    { 100, 100, 100 }, { 3, 2, 1 } };
  const std::vector<int> proc = { 1, 1, 2, 3, -7, 1 };
  const std::vector<unsigned char> ghosts = { 0, 0, 0, 2, 1, 0 };
  FrameView frame = frame_of(points);
  frame.ghosts = ghosts.data();
  const Subdomain one = made_subdomain({ 1, 2, 1 }, { 3, 2, 3 }, 2, 1);
  EXPECT_EQ(bounds(frame, processes(ValueType::Int32, proc)), Subdomains{ one });
  EXPECT_EQ(bounds(frame), (Subdomains{ made_subdomain(one.lo, one.hi, 2, 0) }));
  EXPECT_EQ(bounds(frame_of({})), Subdomains{});
  EXPECT_EQ(bounds(frame_of({}), processes(ValueType::Int32, std::vector<int>{})), Subdomains{});
  Progress progress;
  EXPECT_EQ(bounds_of_particles(frame, Executor(2), progress).outside, 3);
  EXPECT_EQ(
    bounds_by_process(frame, processes(ValueType::Int32, proc), Executor(1), progress).outside, 3);
}

TEST(ParticleBounds, PositionsAreAbsoluteAndNotWrapped)
{
  const Points points = { { -3, 0, 0 }, { 9, 0.5, 1 } };
  FrameView frame = frame_of(points);
  frame.has_box = true;
  frame.header.box = Box::from_bounds({ 0, 0, 0 }, { 4, 1, 1 });
  frame.header.box.boundary = "pp pp pp";
  frame.point_origin = { 10, 0, 0 };
  EXPECT_EQ(bounds(frame), (Subdomains{ made_subdomain({ 7, 0, 0 }, { 19, 0.5, 1 }, 2, 0) }));
}

TEST(ParticleBounds, ThreadsDoNotShow)
{
  std::mt19937_64 random(1);
  const Points points =
    chosen_points(300'000, { { { -0.0, 0.0 }, { -0.0, 0.0 }, {} } }, {}, { 1, -1, 1 }, random);
  std::vector<std::int64_t> proc(points.size());
  for (std::int64_t& process : proc)
  {
    process = static_cast<std::int64_t>(random() % 1000) * (most / 1000);
  }
  const FrameView frame = frame_of(points);
  const Subdomains one = bounds(frame, processes(ValueType::Int64, proc), 1);
  ASSERT_EQ(one.size(), 1000u);
  Subdomains expected;
  for (int rank = 0; rank < 1000; ++rank)
  {
    Subdomain of_rank = made_subdomain({ infinity, infinity, infinity },
      { -infinity, -infinity, -infinity }, 0, rank * (most / 1000));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (proc[i] == of_rank.rank)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          of_rank.lo[axis] = std::min(of_rank.lo[axis], points[i][axis]);
          of_rank.hi[axis] = std::max(of_rank.hi[axis], points[i][axis]);
        }
        ++of_rank.particles;
      }
    }
    expected.push_back(of_rank);
  }
  EXPECT_EQ(one, expected);
  for (const int threads : { 2, 3 })
  {
    const Subdomains more = bounds(frame, processes(ValueType::Int64, proc), threads);
    ASSERT_EQ(more, one);
    for (std::size_t i = 0; i < one.size(); ++i)
    {
      EXPECT_EQ(std::signbit(more[i].lo[0]), std::signbit(one[i].lo[0])); // -0 is 0
      EXPECT_EQ(std::signbit(more[i].hi[1]), std::signbit(one[i].hi[1]));
    }
  }
}

TEST(ParticleBounds, SaysWhatIsNoProcess)
{
  const std::string expected =
    "column 'proc': expected whole numbers of processes, from 0 to 2147483647, got ";
  EXPECT_EQ(error_of<int>(ValueType::Int32, { 0, most, -1, -2 }), expected + "-1");
  EXPECT_EQ(error_of<std::int64_t>(ValueType::Int64, { 0, std::int64_t{ most } + 1 }),
    expected + "2147483648");
  EXPECT_EQ(error_of<double>(ValueType::Float64, { 0, 1.5 }), expected + "1.5");
  EXPECT_EQ(error_of<double>(ValueType::Float64, { no_number }), expected + "nan");
  EXPECT_EQ(error_of<float>(ValueType::Float32, { HUGE_VALF }), expected + "inf");
  EXPECT_EQ(error_of<int>(ValueType::Int32, { 0, most }), "");
  EXPECT_EQ(error_of<int>(ValueType::Int32, { 0, 1, 2 }, 3),
    "column 'proc': expected one whole number a row, got 3 values");
  EXPECT_EQ(error_of<std::string>(ValueType::Text, { "0" }),
    "column 'proc': expected one whole number a row, got texts");
  FrameView frame;
  frame.rows = 1;
  frame.has_box = false;
  EXPECT_THROW(bounds(frame), Error);
}

/// The first row that is wrong, whoever gets to see it first.
TEST(ParticleBounds, TheFirstErrorIsTold)
{
  std::vector<int> proc(300'000, 3);
  for (std::size_t i = 70'000; i < proc.size(); ++i)
  {
    proc[i] = -static_cast<int>(i);
  }
  const Points points(proc.size());
  for (const int threads : { 1, 3 })
  {
    const std::string error =
      ::error_of([&] { bounds(frame_of(points), processes(ValueType::Int32, proc), threads); });
    EXPECT_NE(error.find("got -70000"), std::string::npos) << error;
  }
}

TEST(JoinByProcess, AllRanksKnowWhatAnyKnows)
{
  const std::vector<Subdomains> own = {
    { made_subdomain({ 0, 0, 0 }, { 1, 1, 1 }, 10, 7),
      made_subdomain({ 5, 5, 5 }, { 6, 6, 6 }, 2, 1) },
    {},
    { made_subdomain({ -1, 0.5, 0 }, { 0, 2, 1 }, std::int64_t{ 1 } << 40, 7),
      made_subdomain({ 3, 3, 3 }, { 3, 3, 3 }, 1, most) },
  };
  const Subdomains joined = { made_subdomain({ 5, 5, 5 }, { 6, 6, 6 }, 2, 1),
    made_subdomain({ -1, 0, 0 }, { 1, 2, 1 }, (std::int64_t{ 1 } << 40) + 10, 7),
    made_subdomain({ 3, 3, 3 }, { 3, 3, 3 }, 1, most) };
  run_ranks(3,
    [&](Communicator& ranks)
    {
      const Subdomains& mine = own[static_cast<std::size_t>(ranks.rank())];
      EXPECT_EQ(join_by_process(mine, ranks), joined);
      EXPECT_EQ(join_by_process({}, ranks), Subdomains{});
    });
  SerialCommunicator alone;
  EXPECT_EQ(join_by_process(joined, alone), joined);
}

/// However the rows are spread over ranks.
TEST(JoinByProcess, RanksDoNotShow)
{
  std::mt19937_64 random(2);
  const Points points = chosen_points(5000, {}, { 0, 0, 0 }, { 1, 2, 3 }, random);
  std::vector<int> proc(points.size());
  for (int& process : proc)
  {
    process = static_cast<int>(random() % 50);
  }
  const Subdomains expected = bounds(frame_of(points), processes(ValueType::Int32, proc));
  ASSERT_EQ(expected.size(), 50u);
  for (const int size : { 1, 2, 3 })
  {
    run_ranks(size,
      [&](Communicator& ranks)
      {
        const std::size_t first =
          5000 * static_cast<std::size_t>(ranks.rank()) / static_cast<std::size_t>(size);
        const std::size_t last =
          5000 * static_cast<std::size_t>(ranks.rank() + 1) / static_cast<std::size_t>(size);
        FrameView frame = frame_of(points);
        frame.rows = static_cast<std::int64_t>(last - first);
        frame.points = view_rows("points", ValueType::Float64, points[first].data(), 3);
        const Subdomains own =
          bounds(frame, view_rows("proc", ValueType::Int32, proc.data() + first));
        EXPECT_EQ(join_by_process(own, ranks), expected);
      });
  }
}
