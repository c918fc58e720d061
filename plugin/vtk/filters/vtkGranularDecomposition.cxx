// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecomposition.h"

#include "private/arrays/arrays.h"
#include "private/decomposition/voxels.h"
#include "private/dump/dump_input.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/grid/process_grid.h"
#include "granular/subdomains/count_particles.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

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
    this->Input.emplace(this->GetInput(0), this->Ranks);
    switch (this->Self->Mode)
    {
      case PROCESSOR_GRID:
        this->CountInGrid();
        break;
      case PROCESS_ARRAY:
        this->FindByArray();
        break;
      case SUBDOMAINS:
        this->CountInSubdomains();
        break;
      case RANKS:
        this->FindByRank();
        break;
    }
    this->Fill();
  }

  void SetOutside(std::int64_t own)
  {
    this->Group.sum({ &own, 1 });
    this->Outside = own;
  }

  /**
   * Adds up what all processes counted, and gives the subdomains their numbers.
   */
  void SetCounts(granular::ParticleCounts counts)
  {
    this->Group.sum(counts.particles);
    this->SetOutside(counts.outside);
    std::vector<granular::Subdomain>& all = this->Found.subdomains;
    this->Processes = static_cast<std::int64_t>(all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i].particles = counts.particles[i];
    }
  }

  void CountInGrid()
  {
    const auto [lo, hi] = this->Input->FindBounds(
      this->Self->Bounds, "the subdomains of its processes are tilted, too, and no voxels");
    const granular::ProcessGrid grid = this->Self->MakeGrid(lo.data(), hi.data());
    this->Found.subdomains = grid.subdomains(0, grid.size());
    this->SetCounts(granular::count_in_grid(
      this->Input->View, grid, granular::Executor(this->Threads), this->Progress));
  }

  void CountInSubdomains()
  {
    auto* voxels = vtkUnstructuredGrid::SafeDownCast(this->GetInput(1));
    if (!voxels)
    {
      throw granular::Error("expected the subdomains as voxels at the second input, got nothing");
    }
    this->Found = granular::gather_decomposition(ReadVoxels(voxels, this->Notices), this->Group);
    this->Found.has_particles = true;
    granular::SubdomainChecks checks;
    checks.gap = granular::Answer::None; // who is in one is outside, which is told
    granular::check_subdomains(this->Found.subdomains, checks, {}, this->Notices, this->Progress);
    this->SetCounts(granular::count_in_subdomains(this->Input->View, this->Found.subdomains,
      granular::Executor(this->Threads), this->Progress));
  }

  void FindByArray()
  {
    granular::ParticleBounds own;
    const granular::FrameView& view = this->Input->View;
    const std::string& name = this->Self->ProcessArray;
    const granular::ArrayView* process = view.find(name);
    if (view.rows > 0 && !process)
    {
      throw granular::Error(
        "expected a point array '" + name + "' with ranks of processes, got none");
    }
    if (view.rows > 0)
    {
      own = granular::bounds_by_process(
        view, *process, granular::Executor(this->Threads), this->Progress);
    }
    this->Found.subdomains = granular::join_by_process(own.subdomains, this->Group);
    this->SetOutside(own.outside);
    for (const granular::Subdomain& subdomain : this->Found.subdomains)
    {
      this->Processes = std::max(this->Processes, std::int64_t{ subdomain.rank } + 1);
    }
    this->Processes = std::max<std::int64_t>(this->Processes, this->Self->NumberOfProcesses);
  }

  void FindByRank()
  {
    granular::ParticleBounds own = granular::bounds_of_particles(
      this->Input->View, granular::Executor(this->Threads), this->Progress);
    for (granular::Subdomain& subdomain : own.subdomains)
    {
      subdomain.rank = this->Ranks.rank();
    }
    this->Found.subdomains = granular::join_by_process(own.subdomains, this->Ranks);
    this->Processes = this->Ranks.size();
    this->SetOutside(own.outside);
    granular::SubdomainChecks checks;
    checks.overlap = granular::Answer::Notice;
    checks.gap = granular::Answer::None;
    granular::check_subdomains(this->Found.subdomains, checks, {}, this->Notices, this->Progress);
  }

  /**
   * The part of the subdomains that is wanted.
   */
  granular::Decomposition TakePart() const
  {
    const std::vector<granular::Subdomain>& all = this->Found.subdomains;
    granular::Decomposition part{ {}, true, this->Found.has_ranks };
    if (this->Self->Mode == RANKS)
    {
      std::copy_if(all.begin(), all.end(), std::back_inserter(part.subdomains),
        [&](const granular::Subdomain& subdomain) { return subdomain.rank == this->Ranks.rank(); });
      return part;
    }
    const auto [first, last] = this->Wanted.RangeOf(static_cast<vtkTypeInt64>(all.size()));
    part.subdomains.assign(all.begin() + first, all.begin() + last);
    return part;
  }

  /**
   * To the coordinates of the points, but for the origin.
   */
  void Scale(std::vector<granular::Subdomain>& subdomains) const
  {
    const granular::FrameView& view = this->Input->View;
    if (view.coordinates != granular::Coordinates::Scaled)
    {
      return;
    }
    if (view.header.box.tilted)
    {
      throw granular::UnsupportedError("expected points that are not scaled, or a box along the "
                                       "axes, got scaled points of a tilted box");
    }
    for (granular::Subdomain& subdomain : subdomains)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        granular::scale_aligned(view.header.box, k, { &subdomain.lo[k], 1 });
        granular::scale_aligned(view.header.box, k, { &subdomain.hi[k], 1 });
      }
    }
  }

  void Fill()
  {
    granular::Decomposition part = this->TakePart();
    this->Scale(part.subdomains);
    auto* output = this->GetOutput<vtkUnstructuredGrid>();
    FillVoxels(output, part, { this->Input->View.point_origin, this->Threads }, this->Progress);
    vtkFieldData* data = output->GetFieldData();
    data->PassData(this->GetInput(0)->GetFieldData());
    data->AddArray(MakeDoubles(
      "imbalance", { granular::imbalance_of(this->Found.subdomains, this->Processes) }));
    data->AddArray(ArrayOf<vtkTypeInt64Array>("outside", std::array{ this->Outside }));
    this->Tell(this->Outside > 0, "outside",
      std::to_string(this->Outside) + " particles are outside of all subdomains, and in none");
  }

  std::optional<Particles> Input;
  granular::Decomposition Found; ///< all subdomains
  std::int64_t Processes = 0;    ///< of which some may have no particles, and no subdomain
  std::int64_t Outside = 0;
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
