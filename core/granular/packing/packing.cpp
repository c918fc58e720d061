// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing.h"

#include "granular/packing/grain_rows.h"
#include "granular/packing/packing_plan.h"

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

void number_fibres(DumpFrame& frame, const Fibres& fibres, const RowRange& rows)
{
  auto* const numbers = array_of<std::int64_t>(frame, "mol");
  for (std::int64_t row = rows.first; row < rows.last; ++row)
  {
    numbers[row - rows.first] = fibres.fibre(row) + 1;
  }
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
  if (plan.fibres)
  {
    number_fibres(frame, *plan.fibres, rows);
  }
  part.set_part(placed, 1);
  fill_arrays(frame, rows, plan.request, part);
  progress.step(1);
  return frame;
}
}
