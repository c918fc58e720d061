// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecomposition.h"

#include "private/arrays/arrays.h"
#include "private/decomposition/voxels.h"
#include "private/dump/dump_input.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/subdomains/decompose.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <array>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDecomposition);

//------------------------------------------------------------------------------
class vtkGranularDecomposition::Task : public FilterTask<vtkGranularDecomposition>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    const Particles particles(this->GetInput(0), this->Ranks);
    const vtkGranularDecomposition& self = *this->Self;
    granular::DecomposeRequest request;
    request.mode = static_cast<granular::SubdomainsOf>(self.Mode);
    request.bounds = std::to_array(self.Bounds);
    request.grid = self.DescribeGrid();
    request.owners = self.ProcessArray;
    request.read_given = [&]
    {
      auto* voxels = vtkUnstructuredGrid::SafeDownCast(this->GetInput(1));
      if (!voxels)
      {
        throw granular::Error("expected the subdomains as voxels at the second input, got nothing");
      }
      return ReadVoxels(voxels, this->Notices);
    };
    request.threads = this->Threads;
    const granular::Decomposed found = granular::decompose(
      particles.View, request, this->Ranks, this->Group, this->Notices, this->Progress);
    const auto count = static_cast<vtkTypeInt64>(found.all.subdomains.size());
    auto* output = this->GetOutput<vtkUnstructuredGrid>();
    FillVoxels(output,
      found.part(particles.View, request.mode, this->Wanted.RangeOf(count), this->Ranks.rank()),
      { particles.View.point_origin, this->Threads }, this->Progress);
    vtkFieldData* data = output->GetFieldData();
    data->PassData(this->GetInput(0)->GetFieldData());
    data->AddArray(MakeDoubles("imbalance", { found.imbalance }));
    data->AddArray(ArrayOf<vtkTypeInt64Array>("outside", std::array{ found.outside }));
  }
};

vtkGranularExecuteMacro(vtkGranularDecomposition, this->Mode == RANKS);

//------------------------------------------------------------------------------
vtkGranularDecomposition::vtkGranularDecomposition()
{
  this->SetPorts({ Input::Required, Input::Optional }, { "vtkUnstructuredGrid" });
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Bounds[2 * axis] = 1; // the input's
    this->Bounds[2 * axis + 1] = -1;
  }
}

//------------------------------------------------------------------------------
// Who asks for another piece than that of its process gets it from the whole; with RANKS there is no other.
int vtkGranularDecomposition::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->Mode == RANKS)
  {
    const PieceRequest wanted = PieceRequest::Of(outputVector->GetInformationObject(0));
    this->AskFor(inputVector, wanted.Piece, wanted.Pieces);
    return 1;
  }
  return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

vtkGranularPrintMacro(vtkGranularDecomposition, Mode, ProcessArray);
