// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing.h"

#include "granular/packing/packing_plan.h"
#include "granular/packing/random_numbers.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace granular
{
namespace
{
/// The frame, with memory for the rows.
Table empty_frame(const PackingPlan& plan)
{
  std::vector<std::string> columns = { "id", "type", "x", "y", "z", "radius", "vx", "vy", "vz" };
  if (plan.request.arrangement == Arrangement::Chain)
  {
    columns.insert(columns.begin() + 2, "mol");
  }
  Table frame;
  frame.rows = plan.last - plan.first;
  frame.header.rows = plan.particles;
  frame.header.box = plan.box;
  frame.schema = ColumnSchema(columns);
  const auto count = static_cast<std::size_t>(frame.rows);
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

/// The values of an array of the frame; null if it has none.
template <typename T>
T* array_of(const Table& frame, std::string_view name)
{
  const auto found = std::ranges::find(
    frame.arrays, name, [](const TableArray& array) { return std::string_view(array.info.name); });
  return found == frame.arrays.end() ? nullptr : static_cast<T*>(found->block.data());
}
}

Table make_packing(const PackingRequest& request, Progress& progress)
{
  PartialProgress part(progress);
  progress.step(0);
  part.set_part(0, 0.8);
  const PackingPlan plan(request, part);
  part.set_part(0.8, 1);
  return make_packing(plan, part);
}

Table make_packing(const PackingPlan& plan, Progress& progress)
{
  progress.step(0);
  Table frame = empty_frame(plan);
  const PackingRequest& request = plan.request;
  auto* const points = static_cast<double*>(frame.points.data());
  auto* const radii = array_of<double>(frame, "radius");
  auto* const types = array_of<std::int32_t>(frame, "type");
  auto* const ids = array_of<std::int64_t>(frame, "id");
  auto* const molecules = array_of<std::int64_t>(frame, "mol");
  auto* const velocities = array_of<double>(frame, "v");
  std::vector<FrameRanges> ranges(static_cast<std::size_t>(request.threads), FrameRanges(frame));
  constexpr std::size_t rows_a_chunk = 8192;
  Executor(request.threads)
    .for_each_stretch(
      static_cast<std::size_t>(frame.rows), rows_a_chunk,
      [&](std::size_t first, std::size_t count, std::size_t worker)
      {
        for (std::size_t i = first; i < first + count; ++i)
        {
          const std::int64_t row = plan.first + static_cast<std::int64_t>(i);
          const PlacedParticle particle = plan.particle(row);
          RandomNumbers numbers(request.seed, Stream::Velocities, row);
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            points[3 * i + axis] = particle.point[axis];
            velocities[3 * i + axis] = request.speed > 0 ? request.speed * numbers.normal() : 0;
          }
          radii[i] = particle.radius;
          types[i] = particle.type;
          ids[i] = row + 1;
          if (molecules)
          {
            molecules[i] = 1;
          }
        }
        if (request.ranges)
        {
          ranges[worker].add(frame, static_cast<std::int64_t>(first), count);
        }
      },
      progress);
  for (std::size_t worker = 1; worker < ranges.size(); ++worker)
  {
    ranges[0].add(ranges[worker]);
  }
  ranges[0].store(frame);
  progress.step(1);
  return frame;
}
}
