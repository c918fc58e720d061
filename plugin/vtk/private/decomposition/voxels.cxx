// SPDX-License-Identifier: BSD-3-Clause
#include "private/decomposition/voxels.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_input.h"

#include "granular/decomposition/decomposition_file.h"
#include "granular/decomposition/voxels.h"
#include "granular/parallel/executor.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace vtkGranularPrivate
{
namespace
{
using granular::Subdomain;

template <typename Array, typename Value>
vtkSmartPointer<Array> MakeCellArray(
  const char* name, const std::vector<Subdomain>& subdomains, Value Subdomain::*member)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(subdomains.size()));
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), subdomains[i].*member);
  }
  return array;
}

/**
 * A cell array of whole numbers, one a cell.
 */
class WholeNumbers
{
public:
  WholeNumbers(vtkUnstructuredGrid* input, std::initializer_list<const char*> names)
  {
    for (const char* name : names)
    {
      vtkDataArray* array = input->GetCellData()->GetArray(name);
      if (array && array->GetNumberOfComponents() == 1 && !this->Array)
      {
        this->Array = array;
      }
    }
  }

  explicit operator bool() const { return this->Array != nullptr; }

  vtkTypeInt64 Get(vtkIdType cell, vtkTypeInt64 most) const
  {
    const double value = this->Array->GetComponent(cell, 0);
    const bool whole = std::trunc(value) == value && value >= 0 && value < 0x1p63;
    if (!whole || this->Array->GetVariantValue(cell).ToTypeInt64() > most)
    {
      throw granular::FormatError("expected whole numbers from 0 to " + std::to_string(most) +
          ", got " + std::to_string(value) + " in cell " + std::to_string(cell),
        { .column = this->Array->GetName() });
    }
    return this->Array->GetVariantValue(cell).ToTypeInt64();
  }

private:
  vtkDataArray* Array = nullptr;
};

bool IsDuplicate(vtkUnsignedCharArray* ghosts, vtkIdType cell)
{
  return ghosts && (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0;
}
}

void FillVoxels(vtkUnstructuredGrid* output, const granular::Decomposition& decomposition,
  const VoxelForm& form, granular::Progress& progress)
{
  const std::vector<Subdomain>& subdomains = decomposition.subdomains;
  const granular::Executor executor(form.Threads);
  granular::Voxels voxels = granular::make_voxels(subdomains, form.Origin, executor, progress);
  const auto cells = static_cast<vtkIdType>(subdomains.size());
  output->SetPoints(TakePoints(voxels.points, voxels.number_of_points, false, {}));
  // An array of types, where VTK 9.6 has a constant for one type: its writers warn of that.
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(cells);
  types->FillValue(VTK_VOXEL);
  output->SetCells(types, TakeCells(voxels.connectivity, cells, granular::corners_of_voxel));
  vtkCellData* data = output->GetCellData();
  if (decomposition.has_particles)
  {
    data->SetScalars(MakeCellArray<vtkTypeInt64Array>("nlocal", subdomains, &Subdomain::particles));
  }
  if (decomposition.has_ranks)
  {
    data->AddArray(MakeCellArray<vtkTypeInt32Array>("proc", subdomains, &Subdomain::rank));
  }
}

granular::Decomposition ReadVoxels(vtkUnstructuredGrid* input, granular::Notices& notices)
{
  const WholeNumbers particles(input, { "nlocal" });
  const WholeNumbers ranks(input, { "proc", "procID" });
  const std::vector<double> points = ReadAbsolutePoints(input);
  granular::Decomposition decomposition;
  decomposition.has_particles = static_cast<bool>(particles);
  decomposition.has_ranks = static_cast<bool>(ranks);
  vtkUnsignedCharArray* ghosts = input->GetCellGhostArray();
  vtkIdType reflected = 0;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    if (IsDuplicate(ghosts, cell))
    {
      continue;
    }
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    input->GetCellPoints(cell, count, ids);
    const int type = input->GetCellType(cell);
    Subdomain subdomain;
    auto order = granular::CornerOrder::None;
    if ((type == VTK_VOXEL || type == VTK_HEXAHEDRON) && count == granular::corners_of_voxel)
    {
      std::array<granular::Vector3, granular::corners_of_voxel> corners;
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        if (ids[i] < 0 || ids[i] >= input->GetNumberOfPoints())
        {
          throw granular::FormatError("expected points from 0 to " +
            std::to_string(input->GetNumberOfPoints() - 1) + " in cell " + std::to_string(cell) +
            ", got " + std::to_string(ids[i]));
        }
        std::copy_n(points.begin() + 3 * ids[i], 3, corners[i].begin());
      }
      order = granular::bounds_of_cell(corners, subdomain);
    }
    if (order == granular::CornerOrder::None)
    {
      throw granular::UnsupportedError(
        "expected voxels, or hexahedra along the axes, got another cell: number " +
        std::to_string(cell) + " of type " + std::to_string(type));
    }
    reflected += order == granular::CornerOrder::Reflected ? 1 : 0;
    subdomain.particles =
      particles ? particles.Get(cell, std::numeric_limits<std::int64_t>::max()) : 0;
    subdomain.rank =
      static_cast<int>(ranks ? ranks.Get(cell, std::numeric_limits<int>::max())
                             : static_cast<vtkTypeInt64>(decomposition.subdomains.size()));
    decomposition.subdomains.push_back(subdomain);
  }
  if (reflected > 0)
  {
    notices.push_back(granular::note_reflected({}, reflected));
  }
  return decomposition;
}
}
