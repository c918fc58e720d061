// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/euler/euler_dataset.h"

#include "granular/grid/cells.h"
#include "granular/grid/euler_grid.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
/// Line 2 of what LIGGGHTS and PFM write.
constexpr std::string_view liggghts_title = "LIGGGHTS mesh/VTK export";

/// The arrays that tell Euler cells from others.
constexpr std::string_view telling[] = { "v_avg", "volumefraction" };

bool is_telling(std::string_view name)
{
  return std::ranges::find(telling, name) != std::end(telling);
}

class DatasetReader : public VtkGridReader
{
public:
  DatasetReader(LegacyVtk& file, EulerRead what,
    const std::function<bool(std::string_view)>& wanted, EulerDataset& dataset)
    : VtkGridReader(file, dataset, what == EulerRead::Values, what != EulerRead::Names)
    , what_(what)
    , wanted_(wanted)
    , dataset_(dataset)
  {
  }

  void read()
  {
    constexpr std::string_view kinds[] = { vtk_points, vtk_rectilinear, vtk_unstructured };
    this->VtkGridReader::read(kinds, "Euler cells");
    this->check_arrays();
    if (what_ == EulerRead::Values)
    {
      this->make_frame();
    }
  }

private:
  bool is_enough() const override { return what_ == EulerRead::Look && dataset_.is_euler(); }

  void end_grid() override
  {
    const auto& [counts, dimensions] = std::pair(dataset_.counts, dataset_.dimensions);
    if (counts != dimensions)
    {
      const auto text = [](const std::array<std::int64_t, 3>& each) {
        return std::to_string(each[0]) + " " + std::to_string(each[1]) + " " +
          std::to_string(each[2]);
      };
      throw FormatError(
        "expected DIMENSIONS " + text(counts) + " as of the coordinates, got " + text(dimensions),
        file_.where(dataset_.dimensions_place));
    }
  }

  /// Reads an array that is wanted.
  bool take(const VtkArray& array) override
  {
    if (!is_data_)
    {
      return false;
    }
    if (!is_number(array.type))
    {
      dataset_.texts.push_back(array.name);
      return false;
    }
    this->check(array);
    dataset_.names.push_back(array.name);
    if (what_ != EulerRead::Values || !wanted_(array.name))
    {
      return false;
    }
    EulerValues values = { array.name, static_cast<int>(array.components), {} };
    file_.read(array, values.values);
    dataset_.frame.arrays.push_back(std::move(values));
    return true;
  }

  void check(const VtkArray& array) const
  {
    const auto known = std::ranges::find(euler_arrays(), array.name, &EulerArray::name);
    const bool is_known = known != euler_arrays().end();
    const bool fits = is_known
      ? array.components == known->components
      : array.components > 0 && array.components <= std::numeric_limits<int>::max();
    if (!fits || array.tuples != dataset_.cells)
    {
      const std::string components =
        is_known ? std::to_string(known->components) + " x " : "any number x ";
      file_.fail("values of '" + array.name + "', " + components + std::to_string(dataset_.cells),
        std::to_string(array.components) + " x " + std::to_string(array.tuples));
    }
    if (dataset_.has(array.name))
    {
      file_.fail("one array of the name", array.name);
    }
  }

  /// A file that ends between two arrays may still be growing: LIGGGHTS writes all that it knows.
  void check_arrays()
  {
    for (const EulerArray& array : euler_arrays())
    {
      const bool needed = dataset_.has_title() ? !array.optional : is_telling(array.name);
      if (what_ != EulerRead::Look && needed && dataset_.cells > 0 && !dataset_.has(array.name))
      {
        file_.fail_missing("an array '" + std::string(array.name) + "'");
      }
    }
  }

  /// Centres are points, or the middle of cells that have faces.
  void make_frame()
  {
    EulerFrame& frame = dataset_.frame;
    frame.cells = dataset_.cells;
    if (dataset_.header.dataset == vtk_points)
    {
      frame.centres = std::move(dataset_.points);
      return;
    }
    const auto add = [&](double x, double y, double z) {
      frame.centres.insert(frame.centres.end(), { x, y, z });
    };
    if (dataset_.header.dataset == vtk_rectilinear)
    {
      std::ranges::move(dataset_.coordinates, frame.faces);
      const auto middle = [&](std::size_t axis, std::int64_t cell)
      {
        const double* const face = frame.faces[axis].data() + cell;
        return std::midpoint(face[0], face[1]);
      };
      const auto& [x, y, z] = dataset_.counts;
      CellRange{ {}, { x - 1, y - 1, z - 1 } }.each([&](const std::array<std::int64_t, 3>& cell)
        { add(middle(0, cell[0]), middle(1, cell[1]), middle(2, cell[2])); });
      return;
    }
    for (std::int64_t cell = 0; cell < frame.cells; ++cell)
    {
      const std::array<Vector3, corners_of_voxel> corners =
        corners_of(dataset_.points, dataset_.voxels, cell,
          [&](std::int64_t at) { return file_.where_of(dataset_.voxels, at); });
      // the opposite corners of a box have the same middle, which is then rounded once
      const auto middle = [&](std::size_t axis)
      {
        const auto of = [&](std::size_t a, std::size_t b)
        { return std::midpoint(corners[a][axis], corners[b][axis]); };
        return std::midpoint(std::midpoint(of(0, 6), of(1, 7)), std::midpoint(of(2, 4), of(3, 5)));
      };
      add(middle(0), middle(1), middle(2));
    }
  }

  EulerRead what_;
  const std::function<bool(std::string_view)>& wanted_;
  EulerDataset& dataset_;
};
}

bool EulerDataset::has(std::string_view name) const noexcept
{
  return std::ranges::find(names, name) != names.end();
}

bool EulerDataset::is_euler() const noexcept
{
  return std::ranges::all_of(telling, [this](std::string_view name) { return this->has(name); });
}

bool EulerDataset::may_become_euler() const noexcept
{
  return this->has_title() && has_vertices &&
    std::ranges::all_of(names, [](const std::string& name) { return is_telling(name); });
}

bool EulerDataset::has_title() const noexcept
{
  return header.title == liggghts_title;
}

void read_dataset(LegacyVtk& file, EulerRead what,
  const std::function<bool(std::string_view)>& wanted, EulerDataset& dataset)
{
  DatasetReader(file, what, wanted, dataset).read();
}
}
