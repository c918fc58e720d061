// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/path_frame.h"

#include "granular/common/pass.h"
#include "granular/common/shares.h"
#include "granular/frames/header_archive.h"
#include "granular/parallel/trade.h"
#include "granular/sorting/sort_rows.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>

namespace granular
{
namespace
{
using Numbers = std::vector<std::int64_t>;

/// Facts that a rank has of a frame.
struct FrameKnown
{
  std::int64_t particles = 0;
  bool loaded = false;
  FrameHeader header = {};
  Coordinates coordinates = Coordinates::Absolute;
  bool images = false;
  bool rows = false;
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<FrameKnown>& known)
{
  archive.number(known.particles);
  archive.number(known.loaded);
  if (known.loaded)
  {
    pass(archive, known.header);
    archive.number(known.coordinates);
    archive.number(known.images);
    archive.number(known.rows);
  }
}

void share_headers(std::vector<PathFrame>& frames, Communicator& ranks)
{
  std::vector<FrameKnown> own;
  for (const PathFrame& frame : frames)
  {
    own.push_back({ static_cast<std::int64_t>(frame.ids.size()), frame.loaded, frame.header,
      frame.coordinates, frame.has_images, frame.has_rows });
  }
  const std::vector<std::vector<FrameKnown>> all = gather(ranks, own);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    // who has particles knows what they have
    const FrameKnown* best = nullptr;
    bool images = true; // of all particles
    bool rows = true;
    for (const std::vector<FrameKnown>& known : all)
    {
      images = images && (known[i].images || known[i].particles == 0);
      rows = rows && (known[i].rows || known[i].particles == 0);
      const bool better = !best || (best->particles == 0 && known[i].particles > 0);
      best = known[i].loaded && better ? &known[i] : best;
    }
    if (best)
    {
      PathFrame& frame = frames[i];
      frame.loaded = true;
      frame.header = best->header;
      frame.coordinates = best->coordinates;
      frame.has_images = best->images && images;
      frame.has_rows = best->rows && rows;
      frame.images.resize(frame.has_images ? frame.images.size() : 0);
      frame.rows.resize(frame.has_rows ? frame.rows.size() : 0);
    }
  }
}

/// Facts that a rank has of an array in all its frames.
struct ArrayKnown
{
  int smallest = std::numeric_limits<int>::max();
  int largest = 0;
  bool integers = true;
  bool particles = false; ///< there are some that could have it
};

std::vector<ArrayKnown> know_arrays(const std::vector<PathFrame>& frames)
{
  std::vector<ArrayKnown> known(frames.empty() ? 0 : frames.front().arrays.size());
  for (const PathFrame& frame : frames)
  {
    for (std::size_t i = 0; i < known.size() && !frame.ids.empty(); ++i)
    {
      const PathArray& array = frame.arrays[i];
      known[i].particles = true;
      if (array.size > 0)
      {
        known[i].smallest = std::min(known[i].smallest, array.size);
        known[i].largest = std::max(known[i].largest, array.size);
        known[i].integers = known[i].integers && array.integers;
      }
    }
  }
  return known;
}

/// Fills an array that a frame lacks with nan, or 0 among integers; makes doubles of integers where other frames have
/// doubles.
void fit_array(PathArray& array, std::size_t particles, int size, bool integers)
{
  if (array.size == 0)
  {
    const std::int64_t nothing =
      integers ? 0 : std::bit_cast<std::int64_t>(std::numeric_limits<double>::quiet_NaN());
    array.words.assign(particles * static_cast<std::size_t>(size), nothing);
  }
  else if (array.integers && !integers)
  {
    std::ranges::transform(array.words, array.words.begin(),
      [](std::int64_t word) { return std::bit_cast<std::int64_t>(static_cast<double>(word)); });
  }
  array.size = size;
  array.integers = integers;
}

std::vector<std::string> share_arrays(std::vector<PathFrame>& frames, Communicator& ranks)
{
  std::vector<std::string> lacking;
  const std::vector<std::vector<ArrayKnown>> all = gather(ranks, know_arrays(frames));
  for (std::size_t i = 0; i < all.front().size(); ++i)
  {
    ArrayKnown whole;
    for (const std::vector<ArrayKnown>& known : all)
    {
      whole.smallest = std::min(whole.smallest, known[i].smallest);
      whole.largest = std::max(whole.largest, known[i].largest);
      whole.integers = whole.integers && known[i].integers;
      whole.particles = whole.particles || known[i].particles;
    }
    const std::string& name = frames.front().arrays[i].name;
    if (whole.largest == 0 && whole.particles)
    {
      lacking.push_back(name);
    }
    if (whole.largest > 0 && whole.smallest != whole.largest)
    {
      throw Error("expected as many numbers a particle in array '" + name +
        "' in all frames, got " + std::to_string(whole.smallest) + " and " +
        std::to_string(whole.largest));
    }
    for (PathFrame& frame : frames)
    {
      fit_array(frame.arrays[i], frame.ids.size(), std::max(whole.largest, 1),
        whole.integers && whole.largest > 0);
    }
  }
  return lacking;
}
}

std::vector<std::string> share_kinds(std::vector<PathFrame>& frames, Communicator& ranks)
{
  if (ranks.size() > 1)
  {
    share_headers(frames, ranks);
  }
  return share_arrays(frames, ranks);
}

void expect_none(const std::vector<std::string>& lacking)
{
  if (!lacking.empty())
  {
    throw Error(
      "expected an array '" + lacking.front() + "' of the particles, got none in any frame");
  }
}

std::vector<std::int64_t> share_out(const std::vector<PathFrame>& frames, Communicator& ranks)
{
  if (ranks.size() == 1)
  {
    return {};
  }
  if (frames.empty())
  {
    return Numbers(static_cast<std::size_t>(ranks.size() - 1));
  }
  // the ids of one frame tell well enough: of that with most particles, wherever these are
  Numbers counts;
  for (const PathFrame& frame : frames)
  {
    counts.push_back(std::ssize(frame.ids));
  }
  ranks.sum(counts);
  const auto largest = std::ranges::max_element(counts);
  Numbers ids = frames[static_cast<std::size_t>(largest - counts.begin())].ids;
  std::ranges::sort(ids);
  Numbers places;
  for (int rank = 1; rank < ranks.size(); ++rank)
  {
    places.push_back(begin_of_part(*largest, rank, ranks.size()));
  }
  return find_ids_at(places, ids, ranks);
}

void exchange_frames(
  std::vector<PathFrame>& frames, const std::vector<std::int64_t>& first_ids, Communicator& ranks)
{
  if (ranks.size() == 1)
  {
    return;
  }
  const auto owner_of = [&](std::int64_t id)
  {
    return static_cast<std::size_t>(
      std::upper_bound(first_ids.begin(), first_ids.end(), id) - first_ids.begin());
  };
  // for each rank, of each frame how many
  const auto size = static_cast<std::size_t>(ranks.size());
  const std::size_t all = size * frames.size();
  std::vector<ByRank> sorted;
  Numbers counts(all);
  for (const PathFrame& frame : frames)
  {
    sorted.push_back(
      sort_by_rank(frame.ids.size(), size, [&](std::size_t i) { return owner_of(frame.ids[i]); }));
    for (std::size_t rank = 0; rank < size; ++rank)
    {
      counts[rank * frames.size() + sorted.size() - 1] = sorted.back().counts[rank];
    }
  }
  const Numbers of_rank(size, std::ssize(frames));
  const Numbers came_counts = trade(counts, of_rank, of_rank, ranks);
  // one message for a column of all frames
  const auto move = [&](const auto& values_of, const auto& width_of)
  {
    Numbers out(size);
    Numbers in(size);
    std::vector<std::size_t> next(frames.size());
    std::remove_cvref_t<decltype(values_of(frames[0]))> column;
    for (std::size_t i = 0; i < all; ++i)
    {
      const std::size_t f = i % frames.size();
      const auto width = static_cast<std::int64_t>(width_of(frames[f]));
      out[i / frames.size()] += counts[i] * width;
      in[i / frames.size()] += came_counts[i] * width;
      for (std::int64_t n = 0; n < counts[i]; ++n)
      {
        const auto first = values_of(frames[f]).begin() + sorted[f].places[next[f]++] * width;
        column.insert(column.end(), first, first + width);
      }
    }
    std::ranges::for_each(frames, [&](PathFrame& frame) { values_of(frame) = {}; });
    column = trade(column, out, in, ranks);
    auto from = column.begin();
    for (std::size_t i = 0; i < all; ++i)
    {
      PathFrame& frame = frames[i % frames.size()];
      const auto end = from + came_counts[i] * static_cast<std::int64_t>(width_of(frame));
      values_of(frame).insert(values_of(frame).end(), from, end);
      from = end;
    }
  };
  move(std::mem_fn(&PathFrame::points), [](const PathFrame&) { return 3; });
  move(std::mem_fn(&PathFrame::images),
    [](const PathFrame& frame) { return frame.has_images ? 3 : 0; });
  move(
    std::mem_fn(&PathFrame::rows), [](const PathFrame& frame) { return frame.has_rows ? 1 : 0; });
  for (std::size_t a = 0; !frames.empty() && a < frames.front().arrays.size(); ++a)
  {
    move(
      [a](PathFrame & frame) -> auto& { return frame.arrays[a].words; },
      [a](const PathFrame& frame) { return frame.arrays[a].size; });
  }
  move(std::mem_fn(&PathFrame::ids), [](const PathFrame&) { return 1; });
}
}
