// SPDX-License-Identifier: BSD-3-Clause
// GranularContactSums.
#include "filter.h"

#include "granular/contacts/chosen_sums.h"

#include <algorithm>
#include <numeric>

namespace granular_c
{
using namespace granular;

namespace
{
using Range = std::pair<std::int64_t, std::int64_t>;

Block part_of(Block&& values, std::int64_t rows, Range range)
{
  if (range == Range(0, rows))
  {
    return std::move(values);
  }
  const std::size_t row = values.bytes() / static_cast<std::size_t>(rows);
  Block part(static_cast<std::size_t>(range.second - range.first) * row);
  const auto* const from =
    static_cast<const char*>(values.data()) + static_cast<std::size_t>(range.first) * row;
  std::copy_n(from, part.bytes(), static_cast<char*>(part.data()));
  return part;
}

/// The sums of some particles, a row for each.
std::unique_ptr<granular_frame> frame_of(
  std::vector<SummedArray>& sums, std::int64_t rows, Range range)
{
  Table table;
  table.rows = range.second - range.first;
  table.header.has_box = false;
  for (SummedArray& sum : sums)
  {
    add_array(
      table, sum.name, sum.type, sum.components, part_of(std::move(sum.values), rows, range));
  }
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(table.rows));
  std::iota(numbers.begin(), numbers.end(), range.first);
  add_array(table, "input_row", ValueType::Int64, 1, block_of(numbers));
  auto frame = make_frame(RowKind::Cells, std::move(table));
  for (FrameArray& array : frame->arrays)
  {
    for (int i = 0; array.components == 6 && i < 6; ++i)
    {
      array.columns += (i > 0 ? " " : "") + std::string(tensor_components[i]);
    }
  }
  return frame;
}

/// The friction of some contacts, a row for each cell.
std::unique_ptr<granular_frame> frame_of(
  const std::vector<double>& friction, const LineRows& rows, Range range)
{
  const std::vector<std::int64_t> begins = rows.find_begins();
  const std::vector<std::int64_t> ends = rows.find_ends();
  std::vector<std::int64_t> cells;
  std::vector<double> values;
  for (auto row = static_cast<std::size_t>(range.first);
       row < static_cast<std::size_t>(range.second); ++row)
  {
    for (std::int64_t cell = begins[row]; cell <= ends[row]; ++cell)
    {
      cells.push_back(cell);
      values.push_back(friction[row]);
    }
  }
  Table table;
  table.rows = std::ssize(cells);
  table.header.has_box = false;
  add_array(table, "input_cell", ValueType::Int64, 1, block_of(cells));
  add_array(table, friction_array, ValueType::Float64, 1, block_of(values));
  return make_frame(RowKind::Cells, std::move(table));
}
}

Frames apply_contact_sums(FilterTask& task)
{
  Settings& settings = task.settings;
  ChosenSumsRequest request{ settings.arrays(contact_sum_arrays) };
  request.half_branch = settings.choice("LeverArm", 2) == 1;
  request.least_force = settings.number("MinimumForce", 0);
  request.least_overlap = settings.number("MinimumOverlap", 0);
  request.rattler_contacts = static_cast<int>(
    std::clamp<std::int64_t>(settings.integer("RattlerContacts", 2), 1, INT32_MAX));
  request.friction_coefficient = settings.number("FrictionCoefficient", 1);
  request.radius = settings.text("RadiusArray", "radius");
  request.threads = task.threads;
  const auto particles = task.particles(0);
  request.timestep = particles->timestep;
  const TaskContacts contacts(task);
  const std::int64_t rows = particles->view.rows;
  ChosenSums sums = sum_chosen(
    particles->view, contacts.sources(), request, task.group, task.notices, task.progress);
  Frames frames;
  frames.push_back(frame_of(sums.arrays, rows, task.range_of(rows)));
  std::vector<std::pair<std::string_view, std::vector<double>>> facts;
  for (const auto& [name, value] : sums.means)
  {
    facts.push_back({ name, { value } });
  }
  frames.push_back(make_facts(facts));
  if (sums.friction && contacts.are_lines())
  {
    const LineRows& lines = *contacts.sources()[0].rows;
    frames.push_back(frame_of(*sums.friction, lines, task.range_of(lines.count())));
  }
  return frames;
}
}
