// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/grain_rows.h"

#include "granular/packing/random_numbers.h"

#include <vector>

namespace granular
{
namespace
{
/// Of the points, and of each array in turn.
using Ranges = std::vector<ValueRange>;

Ranges empty_ranges(const DumpFrame& frame)
{
  Ranges ranges = { ValueRange(3) };
  for (const DumpArray& array : frame.arrays)
  {
    ranges.emplace_back(static_cast<std::size_t>(array.info.components()));
  }
  return ranges;
}

template <typename T>
void add(ValueRange& range, const Block& block, std::int64_t begin, std::int64_t end)
{
  const auto components = static_cast<std::int64_t>(range.components().size());
  range.add(static_cast<const T*>(block.data()) + begin * components,
    static_cast<std::size_t>(end - begin));
}

void add(Ranges& ranges, const DumpFrame& frame, std::int64_t begin, std::int64_t end)
{
  add<double>(ranges[0], frame.points, begin, end);
  for (std::size_t i = 0; i < frame.arrays.size(); ++i)
  {
    const DumpArray& array = frame.arrays[i];
    switch (array.info.type)
    {
      case ValueType::Int32:
        add<std::int32_t>(ranges[i + 1], array.block, begin, end);
        break;
      case ValueType::Int64:
        add<std::int64_t>(ranges[i + 1], array.block, begin, end);
        break;
      default:
        add<double>(ranges[i + 1], array.block, begin, end);
    }
  }
}

void keep(DumpFrame& frame, const std::vector<Ranges>& of_workers)
{
  Ranges all = empty_ranges(frame);
  for (const Ranges& ranges : of_workers)
  {
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i].add(ranges[i]);
    }
  }
  frame.points_range = all[0];
  for (std::size_t i = 0; i < frame.arrays.size(); ++i)
  {
    frame.arrays[i].range = all[i + 1];
  }
}
}

void fill_arrays(
  DumpFrame& frame, const RowRange& rows, const PackingRequest& request, Progress& progress)
{
  auto* const ids = array_of<std::int64_t>(frame, "id");
  auto* const velocities = array_of<double>(frame, "v");
  std::vector<Ranges> ranges(static_cast<std::size_t>(request.threads), empty_ranges(frame));
  for_row_chunks(rows.count(), request.threads, progress,
    [&](std::int64_t begin, std::int64_t end, std::size_t worker)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t grain = rows.first + i;
        RandomNumbers numbers(request.seed, Stream::Velocities, grain);
        for (std::int64_t axis = 0; axis < 3; ++axis)
        {
          velocities[3 * i + axis] = request.speed > 0 ? request.speed * numbers.normal() : 0;
        }
        ids[i] = grain + 1;
      }
      if (request.ranges)
      {
        add(ranges[worker], frame, begin, end);
      }
    });
  if (request.ranges)
  {
    keep(frame, ranges);
  }
}
}
