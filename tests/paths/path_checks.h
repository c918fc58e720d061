// SPDX-License-Identifier: BSD-3-Clause
// What holds of paths on any ranks: they are those of the walks, and those of one rank bit for bit.
#ifndef granular_tests_paths_path_checks_h
#define granular_tests_paths_path_checks_h

#include "../support/thread_ranks.h"
#include "walks.h"

#include "granular/parallel/trade.h"
#include "granular/paths/paths.h"
#include "granular/paths/statistics.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace path_checks
{
using granular::Communicator;
using granular::PathFrame;
using granular::Paths;

inline std::vector<std::uint64_t> bits_of(std::span<const double> numbers)
{
  std::vector<std::uint64_t> bits;
  for (const double number : numbers)
  {
    bits.push_back(std::bit_cast<std::uint64_t>(number));
  }
  return bits;
}

/// On one process, and on one to five.
inline void on_ranks(const std::function<void(Communicator& ranks)>& check)
{
  granular::SerialCommunicator alone;
  check(alone);
  for (const int ranks : { 1, 2, 3, 5 })
  {
    SCOPED_TRACE(ranks);
    run_ranks(ranks, check);
  }
}

/// A frame in the box from 0 to 10, periodic along x: ids with places on the x axis.
inline PathFrame simple_frame(const std::vector<std::int64_t>& ids, const std::vector<double>& xs)
{
  PathFrame frame;
  frame.loaded = true;
  frame.header.timestep = 50;
  frame.header.box = granular::Box::from_bounds({ 0, 0, 0 }, { 10, 10, 10 });
  frame.header.box.boundary = "pp ff ff";
  frame.ids = ids;
  for (const double x : xs)
  {
    frame.points.insert(frame.points.end(), { x, 1, 2 });
  }
  frame.has_rows = true;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    frame.rows.push_back(10 * static_cast<std::int64_t>(i));
  }
  return frame;
}

inline Paths join(std::vector<PathFrame> frames, const granular::PathJoin& options,
  Communicator& ranks, granular::Notices* notices = nullptr)
{
  granular::Notices said;
  granular::Progress progress;
  return join_frames(std::move(frames), options, ranks, notices ? *notices : said, progress);
}

template <class Values>
void expect_part(const Values& found, const Values& all, std::int64_t first, std::int64_t count,
  std::size_t size, const char* name)
{
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(size) * first;
  const Values expected(begin, begin + static_cast<std::ptrdiff_t>(size) * count);
  ASSERT_EQ(found.size(), expected.size()) << name;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const bool same = std::bit_cast<std::uint64_t>(static_cast<double>(found[i])) ==
        std::bit_cast<std::uint64_t>(static_cast<double>(expected[i])) &&
      found[i] == expected[i];
    const bool none = std::bit_cast<std::uint64_t>(static_cast<double>(found[i])) ==
        std::bit_cast<std::uint64_t>(static_cast<double>(expected[i])) &&
      !(found[i] == found[i]);
    ASSERT_TRUE(same || none) << name << " " << i << ": " << found[i] << ", not " << expected[i];
  }
}

/// The paths of this rank are those of its ids among all, which are on the ranks in their order.
inline void expect_paths(const Paths& found, const Paths& all, Communicator& ranks)
{
  const std::vector<std::int64_t> counts = granular::gather(ranks, std::ssize(found.ids));
  std::int64_t first = 0;
  std::int64_t total = 0;
  for (int rank = 0; rank < ranks.size(); ++rank)
  {
    first += rank < ranks.rank() ? counts[static_cast<std::size_t>(rank)] : 0;
    total += counts[static_cast<std::size_t>(rank)];
  }
  ASSERT_EQ(total, std::ssize(all.ids));
  const std::int64_t count = std::ssize(found.ids);
  expect_part(found.ids, all.ids, first, count, 1, "ids");
  const std::int64_t begin = all.begins[static_cast<std::size_t>(first)];
  const std::int64_t places = all.begins[static_cast<std::size_t>(first + count)] - begin;
  ASSERT_EQ(found.begins.size(), found.ids.size() + 1);
  for (std::size_t i = 0; i < found.begins.size(); ++i)
  {
    ASSERT_EQ(found.begins[i], all.begins[static_cast<std::size_t>(first) + i] - begin);
  }
  expect_part(found.frames, all.frames, begin, places, 1, "frames");
  expect_part(found.points, all.points, begin, places, 3, "points");
  ASSERT_EQ(found.arrays.size(), all.arrays.size());
  for (std::size_t i = 0; total > 0 && i < found.arrays.size();
       ++i) // without particles nobody knows more
  {
    EXPECT_EQ(found.arrays[i].name, all.arrays[i].name);
    EXPECT_EQ(found.arrays[i].integers, all.arrays[i].integers);
    ASSERT_EQ(found.arrays[i].size, all.arrays[i].size);
    const std::string& name = found.arrays[i].name;
    expect_part(found.arrays[i].words, all.arrays[i].words, begin, places,
      static_cast<std::size_t>(found.arrays[i].size), name.c_str());
  }
  ASSERT_EQ(found.crossings.empty() && places > 0, all.crossings.empty() && places > 0);
  if (!all.crossings.empty())
  {
    expect_part(found.shown, all.shown, begin, places, 3, "shown");
    expect_part(found.crossings, all.crossings, begin, places, 3, "crossings");
  }
}

/// Ways to give each rank some of the rows.
using Deal = std::function<int(std::size_t frame, std::size_t row, int ranks)>;

inline int by_frames(std::size_t frame, std::size_t, int ranks)
{
  return static_cast<int>(frame % static_cast<std::size_t>(ranks));
}

inline int by_rows(std::size_t frame, std::size_t row, int ranks)
{
  return static_cast<int>((frame * 5 + row * 7919 / 3) % static_cast<std::size_t>(ranks));
}

inline int all_on_last(std::size_t, std::size_t, int ranks)
{
  return ranks - 1;
}

/// Leaves what this rank has; without any of them it does not know what a frame is.
inline PathFrame dealt(
  const PathFrame& frame, std::size_t number, const Deal& deal, Communicator& ranks)
{
  PathFrame own;
  for (const granular::PathArray& array : frame.arrays)
  {
    own.arrays.push_back({ array.name });
  }
  for (std::size_t i = 0; i < frame.ids.size(); ++i)
  {
    if (deal(number, i, ranks.size()) != ranks.rank())
    {
      continue;
    }
    if (!own.loaded)
    {
      own = frame;
      own.ids.clear();
      own.points.clear();
      own.images.clear();
      own.rows.clear();
      for (granular::PathArray& array : own.arrays)
      {
        array.words.clear();
      }
    }
    const auto take = [i](const auto& from, std::size_t size, auto& to)
    {
      const auto first = from.begin() + static_cast<std::ptrdiff_t>(i * size);
      to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(size));
    };
    take(frame.ids, 1, own.ids);
    take(frame.points, 3, own.points);
    take(frame.images, frame.has_images ? 3 : 0, own.images);
    take(frame.rows, frame.has_rows ? 1 : 0, own.rows);
    for (std::size_t a = 0; a < frame.arrays.size(); ++a)
    {
      take(
        frame.arrays[a].words, static_cast<std::size_t>(frame.arrays[a].size), own.arrays[a].words);
    }
  }
  if (frame.ids.empty() && (ranks.rank() == 0 || number % 2 == 0))
  {
    own = frame; // of a frame without particles some ranks or all know the header
  }
  return own;
}

inline std::vector<PathFrame> dealt(
  const std::vector<PathFrame>& frames, const Deal& deal, Communicator& ranks)
{
  std::vector<PathFrame> own;
  for (std::size_t f = 0; f < frames.size(); ++f)
  {
    own.push_back(dealt(frames[f], f, deal, ranks));
  }
  return own;
}

/// Joins frames, however they are dealt, and compares with the exact paths.
inline void check_run(Communicator& ranks, const walks::Run& run, const walks::Shown& shown,
  bool crossings, const walks::Place& origin = {})
{
  const Paths expected = walks::paths_of(run, origin, crossings);
  granular::PathJoin options;
  options.crossings = crossings;
  options.origin = walks::lengths_of(origin);
  for (const Deal& deal : { Deal(by_frames), Deal(by_rows), Deal(all_on_last) })
  {
    const Paths found = join(dealt(walks::frames_of(run, shown), deal, ranks), options, ranks);
    ASSERT_EQ(found.headers.size(), run.frames.size());
    for (std::size_t f = 0; f < found.headers.size(); ++f)
    {
      EXPECT_EQ(found.headers[f].timestep, 100 * static_cast<std::int64_t>(f));
    }
    ASSERT_NO_FATAL_FAILURE(expect_paths(found, expected, ranks));
  }
}

/// Walks through boxes of all kinds, with image counts and without.
inline void check_walks(Communicator& ranks)
{
  for (const walks::GridBox& box :
    { walks::straight_box(), walks::tilted_box(), walks::leaning_box() })
  {
    walks::Run run = walks::make_run({ box }, {}, 11);
    check_run(ranks, run, { .images = false }, true);
    check_run(ranks, run, { .images = true, .rows = false }, true);
    // frames without particles, and particles that come and go
    run =
      walks::make_run({ box }, { .longest = walks::grid * 100, .images = 1000, .absent = 40 }, 12);
    run.frames[0].clear();
    run.frames[7].clear();
    check_run(ranks, run, {}, true);
    run = walks::make_run({ box }, { .longest = walks::grid / 200, .absent = 40 }, 13);
    check_run(ranks, run, { .images = false }, true);
  }
}

/// Walks in boxes that change.
inline void check_deformed(Communicator& ranks)
{
  const auto boxes = walks::deformed_boxes(60);
  check_run(ranks, walks::make_run(boxes, { .frames = 60 }, 21), { .images = false }, true);
  check_run(ranks,
    walks::make_run(boxes, { .frames = 60, .longest = walks::grid * 3, .images = 50 }, 22), {},
    true);
  check_run(ranks,
    walks::make_run(
      boxes, { .frames = 60, .longest = walks::grid * 3, .images = 50, .absent = 50 }, 23),
    {}, false);
}

/// Fewer particles than ranks, one and none.
inline void check_few(Communicator& ranks)
{
  for (const std::int64_t particles : { 0, 1, 2, 4 })
  {
    check_run(ranks,
      walks::make_run({ walks::tilted_box() }, { .particles = particles, .frames = 3 }, 31), {},
      true);
    check_run(ranks,
      walks::make_run({ walks::tilted_box() }, { .particles = particles, .frames = 1 }, 32),
      { .images = false }, false);
  }
}
}
#endif
