// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/grid_dump/grid_dump.h"

#include "granular/formats/dump/grammar/text_dump.h"
#include "granular/formats/dump/read/dump_reader.h"

#include <algorithm>
#include <array>

namespace granular
{
namespace
{
void index_grid(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead)
{
  index_text_dump(source, index, progress, ahead, RowsOf::Cells);
}

/// Cells in the order of their ids are all there, and each once.
void check_ids(const TableArray* ids, const Where& where)
{
  std::int64_t cell = 0;
  for (const std::int64_t id : values_in<std::int64_t>(ids))
  {
    if (id != ++cell)
    {
      throw FormatError("expected the ids of cells from 1 on, each once, got " +
          std::to_string(id) + " instead of " + std::to_string(cell),
        where);
    }
  }
}

template <class Value>
bool add_values(EulerFrame& frame, TableArray& array)
{
  const auto components = static_cast<int>(array.info.columns.size());
  if (!holds<Value>(array, array.info.columns.size()))
  {
    return false;
  }
  const auto values = values_in<Value>(&array, array.info.columns.size());
  frame.arrays.push_back({ array.info.name, components, { values.begin(), values.end() } });
  array.block = {}; // or there would be two of all
  return true;
}

/// The middles of cells that divide the edges of a box evenly, and their faces where the edges are along the axes.
void place_cells(EulerFrame& frame, const FrameHeader& header)
{
  const auto [nx, ny, nz] = header.cells;
  const Vector3 corner = values_of(header.box.origin);
  std::array<Vector3, 3> edges;
  std::ranges::transform(
    header.box.vectors, edges.begin(), [](const auto& edge) { return values_of(edge); });
  const auto point = [&](double x, double y, double z, std::size_t axis)
  { return corner[axis] + x * edges[0][axis] + y * edges[1][axis] + z * edges[2][axis]; };
  const auto middle = [](std::int64_t cell, std::int64_t of)
  { return (static_cast<double>(cell) + 0.5) / static_cast<double>(of); };
  frame.centres.reserve(static_cast<std::size_t>(3 * header.rows));
  for (std::int64_t k = 0; k < nz; ++k)
  {
    for (std::int64_t j = 0; j < ny; ++j)
    {
      for (std::int64_t i = 0; i < nx; ++i)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          frame.centres.push_back(point(middle(i, nx), middle(j, ny), middle(k, nz), axis));
        }
      }
    }
  }
  for (std::size_t axis = 0; axis < 3 && !header.box.tilted && !header.box.general; ++axis)
  {
    const auto count = static_cast<double>(header.cells[axis]);
    for (double face = 0; face <= count; ++face)
    {
      frame.faces[axis].push_back(corner[axis] + face / count * edges[axis][axis]);
    }
  }
}
}

const FileFormat& grid_format() noexcept
{
  static constexpr FileFormat format = {
    .name = "a dump of a grid", .index = index_grid, .large_runs = true
  };
  return format;
}

bool is_grid_file(const std::string& path) noexcept
{
  return looks_so(path,
    [](const ByteSource& source) { return tell_rows(first_bytes_of(source)) == RowsOf::Cells; });
}

EulerFrame read_grid(const std::vector<FramePiece>& pieces,
  const std::function<bool(std::string_view)>& wanted, int threads, Notices& notices,
  Progress& progress)
{
  const FramePiece& piece = pieces.front();
  const Where where = where_of(piece);
  const bool has_ids = piece.entry.kind->schema.find(ColumnRole::Id) >= 0;
  Request request;
  request.points = false;
  request.sort_by_id = has_ids;
  request.threads = threads;
  request.wanted = [&](std::string_view name, bool) { return name == "id" || wanted(name); };
  Table rows = read_dump(pieces, request, notices, progress);
  check_ids(find_array(rows, "id"), where);
  if (!has_ids)
  {
    notices.push_back({ where,
      "the grid has no column id: its rows are taken for cells along x, then y, then z. Where "
      "several processes wrote them, dump_modify sort id makes them so, and colname 1 id names a "
      "column of compute property/grid" });
  }
  EulerFrame frame;
  frame.cells = rows.rows;
  place_cells(frame, rows.header);
  frame.header = rows.header;
  for (TableArray& array : rows.arrays)
  {
    const bool taken = !wanted(array.info.name) || add_values<double>(frame, array) ||
      add_values<std::int64_t>(frame, array) || add_values<std::int32_t>(frame, array);
    if (!taken)
    {
      notices.push_back({ where,
        "expected arrays of numbers, got '" + array.info.name + "' of text, which is left out" });
    }
  }
  return frame;
}
}
