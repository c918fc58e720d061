// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/decomposition/decomposition_grid.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace granular
{
namespace
{
constexpr std::int64_t points_a_cell = corners_of_voxel;

constexpr ProcessArray all_process_arrays[] = {
  { "nlocal", &DecompositionGrid::has_particles, &DecompositionGrid::particles,
    std::numeric_limits<std::int64_t>::max(), false },
  { "proc", &DecompositionGrid::has_ranks, &DecompositionGrid::ranks,
    std::numeric_limits<int>::max(), false },
  { "procID", &DecompositionGrid::has_ranks, &DecompositionGrid::ranks,
    std::numeric_limits<int>::max(), true },
};

class GridReader : public VtkGridReader
{
public:
  GridReader(LegacyVtk& file, DecompositionGrid& grid, bool keep)
    : VtkGridReader(file, grid, keep, keep)
    , grid_(grid)
  {
  }

private:
  void limit(std::int64_t cells) const
  {
    if (cells > most_processes)
    {
      throw LimitError("expected at most " + std::to_string(most_processes) + " processes, got " +
          std::to_string(cells),
        file_.where(file_.line_place()));
    }
  }

  void begin_section() override
  {
    if (!grid_.rectilinear() && (file_.is("POINTS") || file_.is("CELLS")))
    {
      this->limit(file_.count(1) / (file_.is("POINTS") ? points_a_cell : 1));
    }
  }

  void end_grid() override { this->limit(grid_.rectilinear() ? grid_.cells : 0); }

  void begin_data() override
  {
    grid_.has_data = true;
    file_.need(of_cells_ ? "arrays of CELL_DATA" : "arrays of POINT_DATA");
    if (!this->take_arrays())
    {
      file_.fail("an array", file_.words().front());
    }
  }

  /// Reads the arrays that tell what is known of a process.
  bool take(const VtkArray& array) override
  {
    const auto* const known =
      std::ranges::find(all_process_arrays, array.name, &ProcessArray::name);
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
    known->check(
      numbers, [&](std::int64_t number) { return file_.where_of(first, array, number); });
    return true;
  }

  DecompositionGrid& grid_;
};
}

bool DecompositionGrid::is_piece() const noexcept
{
  return this->rectilinear() && cells_between(dimensions) > cells;
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
  constexpr std::string_view kinds[] = { vtk_rectilinear, vtk_unstructured };
  DecompositionGrid grid;
  GridReader(file, grid, keep)
    .read(kinds, "the grid",
      ": LIGGGHTS writes a header without a grid where a timestep is dumped again");
  return grid;
}
}
