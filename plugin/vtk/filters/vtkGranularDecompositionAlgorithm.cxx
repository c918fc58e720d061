// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecompositionAlgorithm.h"

#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/grid/process_grid.h"

#include "vtkUnstructuredGrid.h"

#include <algorithm>

//------------------------------------------------------------------------------
granular::GridRequest vtkGranularDecompositionAlgorithm::DescribeGrid() const
{
  granular::GridRequest request;
  request.processes = this->NumberOfProcesses;
  std::copy_n(this->ProcessorGrid, 3, request.grid.begin());
  std::copy_n(this->Cuts, 3, request.cuts.begin());
  return request;
}

//------------------------------------------------------------------------------
void vtkGranularDecompositionAlgorithm::AddCut(int axis, double position)
{
  this->Cuts[axis].push_back(position);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGranularDecompositionAlgorithm::ClearCuts(int axis)
{
  if (!this->Cuts[axis].empty())
  {
    this->Cuts[axis].clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkGranularDecompositionAlgorithm::GetNumberOfCuts(int axis)
{
  return axis >= 0 && axis < 3 ? static_cast<int>(this->Cuts[axis].size()) : 0;
}

vtkGranularOutputMacro(vtkGranularDecompositionAlgorithm, GetOutput, vtkUnstructuredGrid, 0);

//------------------------------------------------------------------------------
void vtkGranularDecompositionAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto& [x, y, z] = this->Cuts;
  vtkGranularPrivate::PrintProperties(os, indent,
    "Bounds, NumberOfProcesses, ProcessorGrid, XCuts, YCuts, ZCuts", this->Bounds,
    this->NumberOfProcesses, this->ProcessorGrid, x, y, z);
}
