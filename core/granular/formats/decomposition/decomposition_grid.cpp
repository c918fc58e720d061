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

/// Reads one dataset, section by section.
class GridReader
{
public:
  GridReader(LegacyVtk& file, bool keep)
    : file_(file)
    , keep_(keep)
    , sections_(file, grid_, keep, keep)
  {
  }

  DecompositionGrid read()
  {
    this->read_header();
    while (file_.next())
    {
      if (file_.is("CELL_DATA") || file_.is("POINT_DATA"))
      {
        this->read_data(file_.is("CELL_DATA"));
        continue;
      }
      if (!grid_.rectilinear && (file_.is("POINTS") || file_.is("CELLS")))
      {
        this->limit(file_.count(1) / (file_.is("POINTS") ? points_a_cell : 1));
      }
      if (!sections_.read() &&
        !file_.take_arrays(tuples_, [this](const VtkArray& array) { return this->take(array); }))
      {
        file_.fail("a section of the grid", file_.words().front());
      }
    }
    this->end_sections(true);
    return std::move(grid_);
  }

private:
  void read_header()
  {
    grid_.header = file_.read_header();
    const std::string& dataset = grid_.header.dataset;
    const std::string expected = "DATASET RECTILINEAR_GRID or UNSTRUCTURED_GRID";
    if (dataset.empty())
    {
      file_.fail_missing(
        expected, ": LIGGGHTS writes a header without a grid where a timestep is dumped again");
    }
    grid_.rectilinear = dataset == vtk_rectilinear;
    if (!grid_.rectilinear && dataset != vtk_unstructured)
    {
      file_.fail(expected, dataset);
    }
  }

  /// All sections must have been there.
  void end_sections(bool at_end)
  {
    sections_.end(at_end);
    this->limit(grid_.rectilinear ? grid_.cells : 0);
  }

  void limit(std::int64_t cells) const
  {
    if (cells > most_processes)
    {
      throw LimitError("expected at most " + std::to_string(most_processes) + " processes, got " +
          std::to_string(cells),
        file_.where(file_.line_place()));
    }
  }

  void read_data(bool of_cells)
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
  bool take(const VtkArray& array)
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

  LegacyVtk& file_;
  bool keep_;
  DecompositionGrid grid_;
  VtkGridReader sections_;
  bool of_cells_ = false;
  std::int64_t tuples_ = 0; ///< of the arrays at hand
};
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
