// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/vtk_files/vtk_grid.h"

#include "granular/common/words.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace granular
{
namespace
{
constexpr std::int64_t points_a_cell = corners_of_voxel;
}

const VtkGridReader::Section VtkGridReader::sections[] = {
  { vtk_points, "POINTS", &VtkGridReader::read_points },
  { vtk_points, "VERTICES", &VtkGridReader::read_parts, true },
  { vtk_points, "LINES", &VtkGridReader::read_parts, true, true },
  { vtk_points, "POLYGONS", &VtkGridReader::read_parts, true, true },
  { vtk_points, "TRIANGLE_STRIPS", &VtkGridReader::read_parts, true, true },
  { vtk_rectilinear, "DIMENSIONS", &VtkGridReader::read_dimensions },
  { vtk_rectilinear, "X_COORDINATES", &VtkGridReader::read_coordinates },
  { vtk_rectilinear, "Y_COORDINATES", &VtkGridReader::read_coordinates },
  { vtk_rectilinear, "Z_COORDINATES", &VtkGridReader::read_coordinates },
  { vtk_unstructured, "POINTS", &VtkGridReader::read_points },
  { vtk_unstructured, "CELLS", &VtkGridReader::read_cells },
  { vtk_unstructured, "CELL_TYPES", &VtkGridReader::read_types },
};

void VtkGridReader::read(
  std::span<const std::string_view> kinds, const std::string& whose, const std::string& cause)
{
  grid_.header = file_.read_header();
  const std::string& kind = grid_.header.dataset;
  const std::string expected = "DATASET " + join_words(kinds.first(kinds.size() - 1), ", ") +
    (kinds.size() > 1 ? " or " : "") + std::string(kinds.back());
  if (kind.empty())
  {
    file_.fail_missing(expected, cause);
  }
  if (std::ranges::find(kinds, kind) == kinds.end())
  {
    file_.fail(expected, kind);
  }
  while (!this->is_enough() && file_.next())
  {
    const bool of_cells = file_.is("CELL_DATA");
    if (of_cells || file_.is("POINT_DATA"))
    {
      this->read_data(of_cells);
      continue;
    }
    this->begin_section();
    if (!this->read_section() && !this->take_arrays())
    {
      file_.fail("a section of " + whose, file_.words().front());
    }
  }
  this->end_sections(true);
}

void VtkGridReader::read_data(bool of_cells)
{
  this->end_sections(false);
  of_cells_ = of_cells;
  const bool by_points = grid_.header.dataset == vtk_points;
  tuples_ = file_.count(1);
  is_data_ = of_cells_ != by_points;
  if (is_data_ && tuples_ != grid_.cells)
  {
    file_.fail("data of " + std::to_string(grid_.cells) + (by_points ? " points" : " cells"),
      file_.words()[1]);
  }
  this->begin_data();
}

bool VtkGridReader::take_arrays()
{
  const bool is_table = file_.is("LOOKUP_TABLE"); // of colours
  const auto take = [this](const VtkArray& array) { return this->take(array); };
  return file_.take_arrays(tuples_, is_table ? LegacyVtk::TakeArray() : take);
}

/// Reads a section of the grid. Returns false if the line begins none.
bool VtkGridReader::read_section()
{
  const auto* const section = std::ranges::find_if(sections,
    [this](const Section& each)
    {
      return each.dataset == grid_.header.dataset && file_.is(each.keyword) &&
        (surfaces_ || !each.is_surface);
    });
  if (section == std::end(sections))
  {
    return false;
  }
  const auto bit = std::uint32_t{ 1 } << (section - sections);
  if ((seen_ & bit) != 0)
  {
    file_.fail("one section of the name", section->keyword);
  }
  seen_ |= bit;
  (this->*section->read)();
  return true;
}

/// Counts the cells. Sections may be missing at the end, or before the current line, which begins data.
void VtkGridReader::end_sections(bool at_end)
{
  for (std::size_t i = 0; i < std::size(sections); ++i)
  {
    const auto& [dataset, keyword, read, optional, is_surface] = sections[i];
    if (dataset == grid_.header.dataset && !optional && (seen_ >> i & 1) == 0)
    {
      at_end ? file_.fail_missing(keyword) : file_.fail(keyword, file_.words().front());
    }
  }
  if (grid_.header.dataset == vtk_rectilinear)
  {
    grid_.cells = cells_between(grid_.counts);
  }
  else if (grid_.header.dataset == vtk_unstructured && types_ != grid_.cells)
  {
    throw FormatError("expected CELL_TYPES of " + std::to_string(grid_.cells) + " cells, got " +
        std::to_string(types_),
      file_.where(types_place_));
  }
  this->end_grid();
}

void VtkGridReader::read_points()
{
  const VtkArray array = file_.values(3);
  grid_.cells = grid_.header.dataset == vtk_points ? array.tuples : grid_.cells;
  file_.take(array, keep_, grid_.points);
}

/// Values are of points: what the vertices are does not matter, as long as there is nothing wrong with them.
void VtkGridReader::read_parts()
{
  constexpr std::string_view keywords[] = { "VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS" };
  const auto* const keyword =
    std::ranges::find_if(keywords, [this](std::string_view word) { return file_.is(word); });
  const std::int64_t first = file_.count(1);
  const std::int64_t second = file_.count(2);
  VtkCells cells = file_.cells(surfaces_ ? check_ : keep_);
  const bool are_vertices = keyword == std::begin(keywords);
  grid_.has_vertices =
    are_vertices && (cells.counted ? second / 2 == first && second % 2 == 0 : second == cells.size);
  const auto& numbers = cells.connectivity;
  const auto other = std::ranges::find_if(
    numbers, [this](std::int64_t number) { return number < 0 || number >= grid_.cells; });
  if (other != numbers.end())
  {
    const auto after = std::ranges::upper_bound(cells.offsets, other - numbers.begin());
    const std::int64_t cell = after - cells.offsets.begin() - 1;
    throw FormatError("expected points from 0 to " + std::to_string(grid_.cells - 1) + " in " +
        (are_vertices ? "vertex " : "cell ") + std::to_string(cell) + ", got " +
        std::to_string(*other),
      file_.where_of(cells, cell));
  }
  grid_.parts[static_cast<std::size_t>(keyword - std::begin(keywords))] = std::move(cells);
}

void VtkGridReader::read_dimensions()
{
  grid_.dimensions = { file_.count(1), file_.count(2), file_.count(3) };
  grid_.dimensions_place = file_.line_place();
}

void VtkGridReader::read_coordinates()
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

void VtkGridReader::read_cells()
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
  grid_.voxels = file_.cells(keep_);
  grid_.cells = grid_.voxels.size;
  const std::vector<std::int64_t>& offsets = grid_.voxels.offsets;
  for (std::size_t i = 1; i < offsets.size(); ++i)
  {
    const std::int64_t points = offsets[i] - offsets[i - 1];
    if (points != points_a_cell)
    {
      throw FormatError("expected eight points in a cell, got " + std::to_string(points),
        file_.where_of(grid_.voxels, static_cast<std::int64_t>(i) - 1));
    }
  }
}

void VtkGridReader::read_types()
{
  const VtkArray array = { {}, ValueType::Int32, 1, file_.count(1) };
  types_ = array.tuples;
  types_place_ = file_.line_place();
  std::vector<std::int64_t> types;
  const VtkPlace first = file_.place();
  file_.take(array, check_, types);
  check_types(types, [&](std::int64_t cell) { return file_.where_of(first, array, cell); });
}

void check_types(const std::vector<std::int64_t>& types, const WhereOf& where_of)
{
  constexpr std::int64_t voxel = 11;
  constexpr std::int64_t hexahedron = 12;
  const auto other = std::find_if(types.begin(), types.end(),
    [](std::int64_t type) { return type != voxel && type != hexahedron; });
  if (other != types.end())
  {
    throw UnsupportedError(
      "expected the cell type of a voxel (11) or a hexahedron (12), got " + std::to_string(*other),
      where_of(other - types.begin()));
  }
}

std::array<Vector3, corners_of_voxel> corners_of(
  std::span<const double> points, const VtkCells& cells, std::int64_t cell, const WhereOf& where_of)
{
  const auto number_of_points = static_cast<std::int64_t>(points.size() / 3);
  const std::int64_t* const numbers = cells.connectivity.data() + cell * points_a_cell;
  std::array<Vector3, corners_of_voxel> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (numbers[i] < 0 || numbers[i] >= number_of_points)
    {
      throw FormatError("expected points from 0 to " + std::to_string(number_of_points - 1) +
          " in cell " + std::to_string(cell) + ", got " + std::to_string(numbers[i]),
        where_of(cell));
    }
    const double* const point = points.data() + 3 * numbers[i];
    corners[i] = { point[0], point[1], point[2] };
  }
  return corners;
}
}
