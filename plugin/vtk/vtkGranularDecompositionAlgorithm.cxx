// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecompositionAlgorithm.h"

#include "private/decomposition/decomposition_algorithm.h"

#include "vtkUnstructuredGrid.h"

#include <algorithm>

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
granular::ProcessGrid vtkGranularDecompositionAlgorithm::Internals::MakeGrid(
  vtkGranularDecompositionAlgorithm* self, const granular::Vector3& lo,
  const granular::Vector3& hi) const
{
  granular::GridRequest request;
  request.lo = lo;
  request.hi = hi;
  request.processes = self->NumberOfProcesses;
  std::copy_n(self->ProcessorGrid, 3, request.grid.begin());
  request.cuts = this->Cuts;
  return granular::make_process_grid(request);
}

//------------------------------------------------------------------------------
vtkGranularDecompositionAlgorithm::vtkGranularDecompositionAlgorithm()
  : Shared(std::make_unique<Internals>())
{
}

//------------------------------------------------------------------------------
vtkGranularDecompositionAlgorithm::~vtkGranularDecompositionAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkGranularDecompositionAlgorithm::AddCut(int axis, double position)
{
  this->Shared->Cuts[axis].push_back(position);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGranularDecompositionAlgorithm::ClearCuts(int axis)
{
  if (!this->Shared->Cuts[axis].empty())
  {
    this->Shared->Cuts[axis].clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkGranularDecompositionAlgorithm::GetNumberOfCuts(int axis)
{
  return axis >= 0 && axis < 3 ? static_cast<int>(this->Shared->Cuts[axis].size()) : 0;
}

//------------------------------------------------------------------------------
vtkUnstructuredGrid* vtkGranularDecompositionAlgorithm::GetOutput()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
void vtkGranularDecompositionAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const auto& values)
  {
    os << indent << name << ":";
    for (const auto& value : values)
    {
      os << " " << value;
    }
    os << "\n";
  };
  print("Bounds", this->Bounds);
  os << indent << "NumberOfProcesses: " << this->NumberOfProcesses << "\n";
  print("ProcessorGrid", this->ProcessorGrid);
  print("XCuts", this->Shared->Cuts[0]);
  print("YCuts", this->Shared->Cuts[1]);
  print("ZCuts", this->Shared->Cuts[2]);
}
