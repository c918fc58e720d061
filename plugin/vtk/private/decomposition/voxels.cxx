// SPDX-License-Identifier: BSD-3-Clause
#include "private/decomposition/voxels.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_input.h"

#include "granular/formats/decomposition/decomposition_file.h"
#include "granular/formats/decomposition/voxels.h"
#include "granular/parallel/executor.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
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

/**
 * The first of some cell arrays that has one number a cell; null if none has.
 */
vtkDataArray* FindNumbers(vtkUnstructuredGrid* input, std::initializer_list<const char*> names)
{
  for (const char* name : names)
  {
    vtkDataArray* array = input->GetCellData()->GetArray(name);
    if (array && array->GetNumberOfComponents() == 1)
    {
      return array;
    }
  }
  return nullptr;
}

vtkTypeInt64 WholeNumber(vtkDataArray* array, vtkIdType cell, vtkTypeInt64 most)
{
  const double value = array->GetComponent(cell, 0);
  const bool whole = std::trunc(value) == value && value >= 0 && value < 0x1p63;
  if (!whole || array->GetVariantValue(cell).ToTypeInt64() > most)
  {
    throw granular::FormatError("expected whole numbers from 0 to " + std::to_string(most) +
        ", got " + std::to_string(value) + " in cell " + std::to_string(cell),
      { .column = array->GetName() });
  }
  return array->GetVariantValue(cell).ToTypeInt64();
}

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
    data->SetScalars(ArrayOf<vtkTypeInt64Array>("nlocal", subdomains, &Subdomain::particles));
  }
  if (decomposition.has_ranks)
  {
    data->AddArray(ArrayOf<vtkTypeInt32Array>("proc", subdomains, &Subdomain::rank));
  }
}

granular::Decomposition ReadVoxels(vtkUnstructuredGrid* input, granular::Notices& notices)
{
  vtkDataArray* const particles = FindNumbers(input, { "nlocal" });
  vtkDataArray* const ranks = FindNumbers(input, { "proc", "procID" });
  const std::vector<double> points = ReadAbsolutePoints(input);
  granular::Decomposition decomposition;
  decomposition.has_particles = particles != nullptr;
  decomposition.has_ranks = ranks != nullptr;
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
      particles ? WholeNumber(particles, cell, std::numeric_limits<std::int64_t>::max()) : 0;
    subdomain.rank =
      static_cast<int>(ranks ? WholeNumber(ranks, cell, std::numeric_limits<int>::max())
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
