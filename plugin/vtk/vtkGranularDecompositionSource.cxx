// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecompositionSource.h"

#include "private/decomposition/decomposition_algorithm.h"
#include "private/dump/dump_output.h"

#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDecompositionSource);

//------------------------------------------------------------------------------
vtkGranularDecompositionSource::vtkGranularDecompositionSource()
{
  this->SetPorts({}, { "vtkUnstructuredGrid" });
}

//------------------------------------------------------------------------------
void vtkGranularDecompositionSource::Execute(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputs), vtkInformationVector* outputs)
{
  const double* bounds = this->Bounds;
  const granular::Vector3 lo = { bounds[0], bounds[2], bounds[4] };
  const granular::Vector3 hi = { bounds[1], bounds[3], bounds[5] };
  const granular::ProcessGrid grid = this->Shared->MakeGrid(this, lo, hi);
  const auto [first, last] =
    PieceRequest::Of(outputs->GetInformationObject(0)).RangeOf(grid.size());
  auto* output = vtkUnstructuredGrid::GetData(outputs);
  granular::Communicator& ranks = this->Ranks->Get();
  AlgorithmProgress own(this);
  granular::SharedProgress progress(own, ranks);
  FillVoxels(output, { grid.subdomains(first, last) }, { {}, ChooseThreads(this->Threads, ranks) },
    progress);
  granular::FrameHeader header;
  header.box = granular::Box::from_bounds(lo, hi);
  header.box.boundary = "ff ff ff";
  FillHeader(output->GetFieldData(), header, granular::Coordinates::Absolute, {});
  output->GetFieldData()->RemoveArray("timestep"); // it has none
}
