// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/decomposition_grid.h"

#include "granular/vtk_files/vtk_sections.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

namespace granular
{
namespace
{
constexpr std::int64_t points_a_cell = corners_of_voxel;
constexpr std::string_view rectilinear = "RECTILINEAR_GRID";
constexpr std::string_view unstructured = "UNSTRUCTURED_GRID";

constexpr ProcessArray all_process_arrays[] = {
  { "nlocal", &DecompositionGrid::has_particles, &DecompositionGrid::particles,
    std::numeric_limits<std::int64_t>::max(), false },
  { "proc", &DecompositionGrid::has_ranks, &DecompositionGrid::ranks,
    std::numeric_limits<int>::max(), false },
  { "procID", &DecompositionGrid::has_ranks, &DecompositionGrid::ranks,
    std::numeric_limits<int>::max(), true },
};

/// Reads one dataset, section by section.
class GridReader
{
public:
  GridReader(LegacyVtk& file, bool keep);

  DecompositionGrid read();

private:
  static const VtkSection<GridReader> sections[];

  void read_header();
  void end_sections(bool at_end);
  void read_dimensions();
  void read_coordinates();
  void read_points();
  void read_cells();
  void read_types();
  void read_data(bool of_cells);
  bool take(const VtkArray& array);
  void limit(std::int64_t cells) const;
  WhereOf places(const VtkPlace& first, const VtkArray& array);

  LegacyVtk& file_;
  bool keep_;
  DecompositionGrid grid_;
  VtkSections<GridReader> sections_;
  bool of_cells_ = false;
  std::int64_t tuples_ = 0; ///< of the arrays at hand
  std::int64_t types_ = 0;
  VtkPlace types_place_;
};

const VtkSection<GridReader> GridReader::sections[] = {
  { rectilinear, "DIMENSIONS", &GridReader::read_dimensions },
  { rectilinear, "X_COORDINATES", &GridReader::read_coordinates },
  { rectilinear, "Y_COORDINATES", &GridReader::read_coordinates },
  { rectilinear, "Z_COORDINATES", &GridReader::read_coordinates },
  { unstructured, "POINTS", &GridReader::read_points },
  { unstructured, "CELLS", &GridReader::read_cells },
  { unstructured, "CELL_TYPES", &GridReader::read_types },
};

GridReader::GridReader(LegacyVtk& file, bool keep)
  : file_(file)
  , keep_(keep)
  , sections_(file, sections)
{
}

DecompositionGrid GridReader::read()
{
  this->read_header();
  while (file_.next())
  {
    if (file_.is("CELL_DATA") || file_.is("POINT_DATA"))
    {
      this->read_data(file_.is("CELL_DATA"));
    }
    else if (!sections_.read(grid_.header.dataset, *this) &&
      !file_.take_arrays(tuples_, [this](const VtkArray& array) { return this->take(array); }))
    {
      file_.fail("a section of the grid", file_.words().front());
    }
  }
  this->end_sections(true);
  return std::move(grid_);
}

void GridReader::read_header()
{
  grid_.header = file_.read_header();
  const std::string& dataset = grid_.header.dataset;
  const std::string expected = "DATASET RECTILINEAR_GRID or UNSTRUCTURED_GRID";
  if (dataset.empty())
  {
    file_.fail_missing(
      expected, ": LIGGGHTS writes a header without a grid where a timestep is dumped again");
  }
  grid_.rectilinear = dataset == rectilinear;
  if (!grid_.rectilinear && dataset != unstructured)
  {
    file_.fail(expected, dataset);
  }
}

/// All sections must have been there.
void GridReader::end_sections(bool at_end)
{
  sections_.end(grid_.header.dataset, at_end);
  if (grid_.rectilinear)
  {
    grid_.cells = cells_between(grid_.counts);
    this->limit(grid_.cells);
  }
  else if (types_ != grid_.cells)
  {
    throw FormatError("expected CELL_TYPES of " + std::to_string(grid_.cells) + " cells, got " +
        std::to_string(types_),
      file_.where(types_place_));
  }
}

void GridReader::limit(std::int64_t cells) const
{
  if (cells > most_processes)
  {
    throw LimitError("expected at most " + std::to_string(most_processes) + " processes, got " +
        std::to_string(cells),
      file_.where(file_.line_place()));
  }
}

void GridReader::read_dimensions()
{
  grid_.dimensions = { file_.count(1), file_.count(2), file_.count(3) };
}

/// Places of the values of an array, for messages.
WhereOf GridReader::places(const VtkPlace& first, const VtkArray& array)
{
  return [this, first, array](std::int64_t number) { return file_.where_of(first, array, number); };
}

void GridReader::read_coordinates()
{
  const VtkArray array = file_.values(1);
  const auto axis = static_cast<std::size_t>((file_.words().front().front() | 0x20) - 'x');
  if (array.tuples < 2)
  {
    file_.fail("at least 2 coordinates", file_.words()[1]);
  }
  grid_.counts[axis] = array.tuples;
  file_.take(array, keep_, grid_.coordinates[axis]);
}

void GridReader::read_points()
{
  const VtkArray array = file_.values(3);
  this->limit(array.tuples / points_a_cell);
  file_.take(array, keep_, grid_.points);
}

void GridReader::read_cells()
{
  this->limit(file_.count(1));
  grid_.voxels = read_eight_point_cells(file_, keep_);
  grid_.cells = grid_.voxels.size;
}

void GridReader::read_types()
{
  const VtkArray array = { {}, ValueType::Int32, 1, file_.count(1) };
  types_ = array.tuples;
  types_place_ = file_.line_place();
  std::vector<std::int64_t> types;
  const VtkPlace first = file_.place();
  file_.take(array, keep_, types);
  check_types(types, this->places(first, array));
}

void GridReader::read_data(bool of_cells)
{
  this->end_sections(false);
  of_cells_ = of_cells;
  tuples_ = file_.count(1);
  grid_.has_data = true;
  if (of_cells && tuples_ != grid_.cells)
  {
    file_.fail("data of " + std::to_string(grid_.cells) + " cells", file_.words()[1]);
  }
  file_.need(of_cells ? "arrays of CELL_DATA" : "arrays of POINT_DATA");
  if (!file_.take_arrays(tuples_, [this](const VtkArray& array) { return this->take(array); }))
  {
    file_.fail("an array", file_.words().front());
  }
}

/// Reads the arrays that tell what is known of a process.
bool GridReader::take(const VtkArray& array)
{
  const auto* const known =
    std::find_if(std::begin(all_process_arrays), std::end(all_process_arrays),
      [&](const ProcessArray& entry) { return entry.name == array.name; });
  if (!of_cells_ || known == std::end(all_process_arrays) ||
    (known->only_if_none && grid_.*known->there))
  {
    return false;
  }
  if (array.components != 1 || array.tuples != grid_.cells)
  {
    file_.fail(
      "one value of '" + array.name + "' for each of " + std::to_string(grid_.cells) + " cells",
      std::to_string(array.components) + " x " + std::to_string(array.tuples));
  }
  grid_.*known->there = true;
  std::vector<std::int64_t>& numbers = grid_.*known->numbers;
  const VtkPlace first = file_.place();
  file_.take(array, keep_, numbers);
  known->check(numbers, this->places(first, array));
  return true;
}
}

bool DecompositionGrid::is_piece() const noexcept
{
  return rectilinear && cells_between(dimensions) > cells;
}

void ProcessArray::check(const std::vector<std::int64_t>& values, const WhereOf& where_of) const
{
  const auto other = std::find_if(
    values.begin(), values.end(), [this](std::int64_t value) { return value < 0 || value > most; });
  if (other != values.end())
  {
    throw FormatError("expected a number '" + std::string(name) + "' from 0 to " +
        std::to_string(most) + ", got " + std::to_string(*other),
      where_of(other - values.begin()));
  }
}

std::span<const ProcessArray> process_arrays() noexcept
{
  return all_process_arrays;
}

CornerOrder bounds_of(
  const DecompositionGrid& grid, std::int64_t cell, const WhereOf& where_of, Subdomain& subdomain)
{
  return bounds_of_cell(corners_of(grid.points, grid.voxels, cell, where_of), subdomain);
}

DecompositionGrid read_grid(LegacyVtk& file, bool keep)
{
  return GridReader(file, keep).read();
}
}
