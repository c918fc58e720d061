// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing.h"

#include "granular/packing/grain_rows.h"
#include "granular/packing/packing_plan.h"
#include "granular/packing/random_numbers.h"
#include "granular/particles/frame_ranges.h"

#include <string>
#include <vector>

namespace granular
{
namespace
{
/// The frame, with memory for the rows.
DumpFrame empty_frame(const PackingPlan& plan, std::int64_t rows)
{
  std::vector<std::string> columns = { "id", "type", "x", "y", "z", "radius", "vx", "vy", "vz" };
  if (plan.fibres)
  {
    columns.insert(columns.begin() + 2, "mol");
  }
  DumpFrame frame;
  frame.rows = rows;
  frame.header.rows = plan.grains;
  frame.header.box = plan.box;
  frame.schema = ColumnSchema(columns);
  const auto count = static_cast<std::size_t>(rows);
  frame.points = Block(count * 3 * sizeof(double));
  for (const ArrayInfo& info : frame.schema.arrays())
  {
    if (!info.position_form)
    {
      const std::size_t bytes =
        size_of(info.type) * static_cast<std::size_t>(info.components()) * count;
      frame.arrays.push_back({ info, Block(bytes), {}, {} });
    }
  }
  return frame;
}

/// Fills the arrays that need no more than the number of a grain, and finds the ranges if they are wanted.
void fill_arrays(
  DumpFrame& frame, const RowRange& rows, const PackingPlan& plan, Progress& progress)
{
  const PackingRequest& request = plan.request;
  auto* const ids = array_of<std::int64_t>(frame, "id");
  auto* const fibres = plan.fibres ? array_of<std::int64_t>(frame, "mol") : nullptr;
  auto* const velocities = array_of<double>(frame, "v");
  std::vector<FrameRanges> ranges(static_cast<std::size_t>(request.threads), FrameRanges(frame));
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
        if (fibres)
        {
          fibres[i] = plan.fibres->fibre(grain) + 1;
        }
      }
      if (request.ranges)
      {
        ranges[worker].add(frame, begin, static_cast<std::size_t>(end - begin));
      }
    });
  for (std::size_t worker = 1; worker < ranges.size(); ++worker)
  {
    ranges[0].add(ranges[worker]);
  }
  ranges[0].store(frame);
}
}

DumpFrame make_packing(const PackingRequest& request, Progress& progress)
{
  SerialCommunicator alone;
  PartialProgress part(progress);
  progress.step(0);
  part.set_part(0, 0.8);
  const PackingPlan plan(request, alone, part);
  part.set_part(0.8, 1);
  return make_packing(plan, part);
}

DumpFrame make_packing(const PackingPlan& plan, Progress& progress)
{
  progress.step(0);
  GrainRows rows = { plan.rows() };
  DumpFrame frame = empty_frame(plan, rows.count());
  rows.points = static_cast<double*>(frame.points.data());
  rows.radius = array_of<double>(frame, "radius");
  rows.type = array_of<std::int32_t>(frame, "type");
  PartialProgress part(progress);
  constexpr double placed = 0.4;
  part.set_part(0, placed);
  plan.place_rows(rows, part);
  part.set_part(placed, 1);
  fill_arrays(frame, rows, plan, part);
  progress.step(1);
  return frame;
}
}
