// SPDX-License-Identifier: BSD-3-Clause
#include "granular/runs/kind.h"

#include "granular/formats/local/local_presets.h"

#include <algorithm>
#include <set>
#include <utility>

namespace granular
{
void pass_form(ArchiveWriter& archive, const Request& request, const RunOptions& options)
{
  archive.number(request.coordinates);
  archive.number(request.points);
  archive.number(request.single_precision);
  archive.number(request.point_origin);
  archive.number(request.sort_by_id);
  archive.number(request.stride);
  archive.number(request.region);
  archive.number(request.periodic_lines);
  archive.number(request.bonds);
  archive.number(request.ranges);
  archive.number(request.pieces);
  archive.text(options.preset);
  archive.text(options.column_map);
  archive.text(options.atom_style);
  archive.text(options.boundary);
  archive.number(options.history_layout);
}

std::span<const Kind* const> kinds() noexcept
{
  // clang-format off: the rows are made
  static constexpr const Kind* all[] = {
    &dump_kind,
    &local_kind,
    &restart_kind,
    &data_file_kind,
    &decomposition_kind,
    &euler_kind,
    &grid_kind,
  };
  // clang-format on
  return all;
}

const Kind* find_kind(const std::string& path, const std::string& column_map)
{
  const auto found =
    std::ranges::find_if(kinds(), [&](const Kind* kind) { return kind->is_file(path); });
  return found != kinds().end() ? *found : maps_lines(column_map) ? &local_kind : nullptr;
}

const Kind& kind_of_number(std::int64_t number)
{
  const auto found = std::ranges::find(kinds(), number, &Kind::number);
  if (found == kinds().end())
  {
    throw ArgumentError("expected a kind of granular_kind, got " + std::to_string(number));
  }
  return **found;
}

const Kind& kind_of_first(Communicator& ranks, const std::function<const Kind&()>& find)
{
  std::int64_t number = ranks.rank() == 0 ? find().number : 0;
  ranks.sum({ &number, 1 });
  return kind_of_number(number);
}

std::vector<std::size_t> one_for_columns(const RunIndex& index)
{
  std::vector<std::size_t> frames;
  std::set<const FrameKind*> seen;
  for (std::size_t frame = 0; frame < index.size(); ++frame)
  {
    if (seen.insert(index.first_piece(frame).entry.kind.get()).second)
    {
      frames.push_back(frame);
    }
  }
  return frames;
}

std::vector<std::size_t> first_and_last(const RunIndex& index)
{
  return index.size() == 1 ? std::vector<std::size_t>{ 0 }
                           : std::vector<std::size_t>{ 0, index.size() - 1 };
}

const KnownColumn* find_known(std::string_view array, std::span<const KnownColumn> table) noexcept
{
  const auto part = std::ranges::find(table, array, &KnownColumn::array);
  return part == table.end() ? find_known_column(array, table) : &*part;
}

std::vector<OfferedArray> arrays_of(const ColumnSchema& schema, std::span<const KnownColumn> table)
{
  std::vector<OfferedArray> arrays;
  for (const ArrayInfo& array : schema.arrays())
  {
    arrays.push_back({ array.name, array.type, array.components(), !array.position_form,
      find_known(array.name, table), schema.text(array) });
  }
  return arrays;
}

Tables read_cells(const RunPlace& place, const Request& request, const Offer&, Communicator&,
  Notices& notices, Progress& progress)
{
  const auto wanted = [&request](std::string_view name) { return is_wanted(request.wanted, name); };
  EulerFrame cells =
    place.kind.cells(place.index.pieces(place.frame), wanted, request.threads, notices, progress);
  for (std::size_t i = 0; i < cells.centres.size(); ++i)
  {
    cells.centres[i] -= request.point_origin[i % 3];
  }
  Tables frame;
  Table& table = frame.rows;
  table.header.has_box = false;
  table.header = cells.header.value_or(table.header);
  table.header.timestep = place.index.first_piece(place.frame).entry.timestep;
  table.rows = cells.cells;
  if (request.points)
  {
    table.points = block_of(cells.centres);
    cells.centres = std::vector<double>();
  }
  for (EulerValues& array : cells.arrays)
  {
    add_array(table, array.name, ValueType::Float64, array.components, block_of(array.values));
    array.values = std::vector<double>(); // or there would be two of all
  }
  return frame;
}
}
