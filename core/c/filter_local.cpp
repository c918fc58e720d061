// SPDX-License-Identifier: BSD-3-Clause
// GranularLocalJoin.
#include "filter.h"

#include "granular/lines/line_columns.h"
#include "granular/lines/local_join.h"
#include "granular/parallel/trade.h"

#include <numeric>

namespace granular_c
{
using namespace granular;

Frames apply_local_join(FilterTask& task)
{
  Settings& settings = task.settings;
  LocalJoinRequest request;
  request.periodic_lines = static_cast<PeriodicLines>(settings.choice("PeriodicLines", 3));
  request.averages = settings.text("Averages", "");
  request.differences = settings.text("Differences", "");
  request.equilibrium_length_array = settings.text("EquilibriumLengthArray", "equilibrium_length");
  request.equilibrium_length = settings.number("EquilibriumLength", 0);
  request.threads = task.threads;
  const auto particles = task.particles(0);
  const auto lines = task.needed_input(1);
  LineRows rows(lines->view, lines->are_lines);
  request.timesteps = compare_timesteps(particles->timestep, lines->timestep);
  if (!task.together)
  {
    const auto range = task.range_of(rows.count());
    request.first_row = range.first;
    rows.keep(range);
  }
  LocalJoin joined =
    join_local(particles->view, rows, request, task.group, task.notices, task.progress);
  Table table;
  table.rows = static_cast<std::int64_t>(joined.lines.lengths.bytes() / sizeof(double));
  table.coordinates = particles->view.coordinates;
  table.header = particles->view.header;
  table.header.has_box = particles->view.has_box;
  table.schema = ColumnSchema(lines->view.columns, local_known_columns());
  table.has_lines = true;
  table.first_row = joined.first_row;
  for (EndArray& array : joined.arrays)
  {
    add_array(table, array.name, ValueType::Float64, array.size, std::move(array.values));
  }
  table.lines = std::move(joined.lines);
  repeat_rows(table);
  if (joined.cells.empty()) // each line is a row
  {
    joined.cells.resize(static_cast<std::size_t>(table.rows));
    std::iota(joined.cells.begin(), joined.cells.end(), std::int64_t{ 0 });
  }
  add_array(table, "input_row", ValueType::Int64, 1, block_of(joined.cells));
  if (table.lines.rows.empty()) // from here on those of which parts are numbered
  {
    table.lines.rows = std::move(joined.rows);
  }
  else if (!joined.rows.empty())
  {
    table.lines.rows = pick(joined.rows, table.lines.rows);
  }
  Frames frames;
  frames.push_back(
    make_frame(RowKind::Lines, std::move(table), request.periodic_lines == PeriodicLines::Split));
  frames.front()->origin = particles->view.point_origin;
  frames.push_back(make_facts({ { "box_of_lines", { joined.box_of_lines ? 1.0 : 0.0 } },
    { "had_parts", { rows.has_parts() ? 1.0 : 0.0 } } }));
  return frames;
}
}
