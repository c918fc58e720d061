// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/decomposition_grid.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

namespace granular
{
namespace
{
constexpr std::int64_t points_a_cell = corners_of_voxel;

/// Cells between so many positions along each axis; the largest number there is, where there are more.
std::int64_t cells_between(const std::array<std::int64_t, 3>& positions) noexcept
{
  std::int64_t cells = 1;
  for (const std::int64_t along : positions)
  {
    cells = VtkArray{ {}, VtkType::Double, cells, std::max(along, std::int64_t{ 1 }) - 1 }.size();
  }
  return cells;
}

/// Calls good(i) for each number, and says where the first is that is not.
template <class Failure, class Good>
void check_numbers(const std::vector<std::int64_t>& numbers, const std::string& expected, Good good,
  const ProcessArray::WhereOf& where_of)
{
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (!good(i))
    {
      throw Failure("expected " + expected + ", got " + std::to_string(numbers[i]),
        where_of(static_cast<std::int64_t>(i)));
    }
  }
}

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
  GridReader(LegacyVtk& file, bool keep)
    : file_(file)
    , keep_(keep)
  {
  }

  DecompositionGrid read();

private:
  struct Section
  {
    const char* keyword;
    bool rectilinear;
    void (GridReader::*read)();
  };

  static const Section sections[];

  void read_header();
  bool read_section();
  void end_sections();
  void read_dimensions();
  void read_coordinates();
  void read_points();
  void read_cells();
  void read_types();
  void read_data(bool of_cells);
  bool take(const VtkArray& array);
  void limit(std::int64_t cells) const;
  ProcessArray::WhereOf places(const VtkPlace& first, const VtkArray& array);

  LegacyVtk& file_;
  bool keep_;
  DecompositionGrid grid_;
  unsigned seen_ = 0; ///< sections, a bit each
  bool of_cells_ = false;
  std::int64_t tuples_ = 0; ///< of the arrays at hand
  std::int64_t types_ = 0;
  VtkPlace types_place_;
};

const GridReader::Section GridReader::sections[] = {
  { "DIMENSIONS", true, &GridReader::read_dimensions },
  { "X_COORDINATES", true, &GridReader::read_coordinates },
  { "Y_COORDINATES", true, &GridReader::read_coordinates },
  { "Z_COORDINATES", true, &GridReader::read_coordinates },
  { "POINTS", false, &GridReader::read_points },
  { "CELLS", false, &GridReader::read_cells },
  { "CELL_TYPES", false, &GridReader::read_types },
};

DecompositionGrid GridReader::read()
{
  this->read_header();
  while (file_.next())
  {
    if (file_.is("CELL_DATA") || file_.is("POINT_DATA"))
    {
      this->read_data(file_.is("CELL_DATA"));
    }
    else if (!this->read_section() &&
      !file_.take_arrays(tuples_, [this](const VtkArray& array) { return this->take(array); }))
    {
      file_.fail("a section of the grid", file_.words().front());
    }
  }
  this->end_sections();
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
  grid_.rectilinear = dataset == "RECTILINEAR_GRID";
  if (!grid_.rectilinear && dataset != "UNSTRUCTURED_GRID")
  {
    file_.fail(expected, dataset);
  }
}

/// False: the line begins none.
bool GridReader::read_section()
{
  const auto* const section = std::find_if(std::begin(sections), std::end(sections),
    [&](const auto& each)
    { return each.rectilinear == grid_.rectilinear && file_.is(each.keyword); });
  if (section == std::end(sections))
  {
    return false;
  }
  const auto bit = 1U << (section - std::begin(sections));
  if ((seen_ & bit) != 0)
  {
    file_.fail("one section of the name", section->keyword);
  }
  seen_ |= bit;
  (this->*section->read)();
  return true;
}

/// All sections must have been there.
void GridReader::end_sections()
{
  for (std::size_t i = 0; i < std::size(sections); ++i)
  {
    if (sections[i].rectilinear == grid_.rectilinear && (seen_ >> i & 1) == 0)
    {
      file_.fail_missing(sections[i].keyword);
    }
  }
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
ProcessArray::WhereOf GridReader::places(const VtkPlace& first, const VtkArray& array)
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
  grid_.number_of_points = array.tuples;
  this->limit(array.tuples / points_a_cell);
  file_.take(array, keep_, grid_.points);
}

void GridReader::read_cells()
{
  const std::int64_t first = file_.count(1);
  const std::int64_t second = file_.count(2);
  const bool counted = second % 9 == 0 && second / 9 == first;
  const bool with_offsets = second % 8 == 0 && second / 8 == std::max(first, std::int64_t{ 1 }) - 1;
  if (!counted && !with_offsets)
  {
    file_.fail(
      "eight points in each cell", "CELLS " + std::to_string(first) + " " + std::to_string(second));
  }
  this->limit(first);
  grid_.voxels = file_.cells(keep_);
  grid_.cells = grid_.voxels.size;
  const std::vector<std::int64_t>& offsets = grid_.voxels.offsets;
  for (std::size_t i = 1; i < offsets.size(); ++i)
  {
    if (offsets[i] - offsets[i - 1] != points_a_cell)
    {
      fail_points_of_cell(offsets[i] - offsets[i - 1],
        file_.where_of(grid_.voxels, static_cast<std::int64_t>(i) - 1));
    }
  }
}

void GridReader::read_types()
{
  const VtkArray array = { {}, VtkType::Int32, 1, file_.count(1) };
  types_ = array.tuples;
  types_place_ = file_.line_place();
  std::vector<std::int64_t> types;
  const VtkPlace first = file_.place();
  file_.take(array, keep_, types);
  check_types(types, this->places(first, array));
}

void GridReader::read_data(bool of_cells)
{
  this->end_sections();
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
  check_numbers<FormatError>(
    values, "a number '" + std::string(name) + "' from 0 to " + std::to_string(most),
    [&](std::size_t i) { return values[i] >= 0 && values[i] <= most; }, where_of);
}

std::span<const ProcessArray> process_arrays() noexcept
{
  return all_process_arrays;
}

void check_types(const std::vector<std::int64_t>& types, const ProcessArray::WhereOf& where_of)
{
  constexpr std::int64_t voxel = 11;
  constexpr std::int64_t hexahedron = 12;
  check_numbers<UnsupportedError>(
    types, "the cell type of a voxel (11) or a hexahedron (12)",
    [&](std::size_t i) { return types[i] == voxel || types[i] == hexahedron; }, where_of);
}

void fail_points_of_cell(std::int64_t points, const Where& where)
{
  throw FormatError("expected eight points in a cell, got " + std::to_string(points), where);
}

CornerOrder bounds_of(const DecompositionGrid& grid, std::int64_t cell,
  const ProcessArray::WhereOf& where_of, Subdomain& subdomain)
{
  std::array<Vector3, corners_of_voxel> corners;
  const std::int64_t* const points =
    grid.voxels.connectivity.data() + cell * std::int64_t{ corners_of_voxel };
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (points[i] < 0 || points[i] >= grid.number_of_points)
    {
      throw FormatError("expected points from 0 to " + std::to_string(grid.number_of_points - 1) +
          " in cell " + std::to_string(cell) + ", got " + std::to_string(points[i]),
        where_of(cell));
    }
    const double* const point = grid.points.data() + 3 * points[i];
    corners[i] = { point[0], point[1], point[2] };
  }
  return bounds_of_cell(corners, subdomain);
}

DecompositionGrid read_grid(LegacyVtk& file, bool keep)
{
  return GridReader(file, keep).read();
}
}
