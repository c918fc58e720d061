// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecompositionSource.h"

#include "private/decomposition/voxels.h"
#include "private/dump/dump_output.h"
#include "private/request/request_task.h"

#include "granular/subdomains/decompose.h"

#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDecompositionSource);

//------------------------------------------------------------------------------
class vtkGranularDecompositionSource::Task : public FilterTask<vtkGranularDecompositionSource>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    const double* bounds = this->Self->Bounds;
    const granular::Vector3 lo = { bounds[0], bounds[2], bounds[4] };
    const granular::Vector3 hi = { bounds[1], bounds[3], bounds[5] };
    const granular::ProcessGrid grid = granular::grid_in(this->Self->DescribeGrid(), lo, hi);
    const auto [first, last] = this->Wanted.RangeOf(grid.size());
    auto* output = this->GetOutput<vtkUnstructuredGrid>();
    FillVoxels(output, { grid.subdomains(first, last) }, { {}, this->Threads }, this->Progress);
    granular::FrameHeader header;
    header.box = granular::Box::from_bounds(lo, hi);
    header.box.boundary = "ff ff ff";
    FillHeader(output->GetFieldData(), header, granular::Coordinates::Absolute, {});
    output->GetFieldData()->RemoveArray("timestep"); // it has none
  }
};

vtkGranularExecuteMacro(vtkGranularDecompositionSource, true);

//------------------------------------------------------------------------------
vtkGranularDecompositionSource::vtkGranularDecompositionSource()
{
  this->SetPorts({}, { "vtkUnstructuredGrid" });
}
