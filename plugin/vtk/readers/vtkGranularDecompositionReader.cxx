// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecompositionReader.h"

#include "private/decomposition/voxels.h"
#include "private/readers/series_reader.h"
#include "private/request/print.h"

#include "granular/formats/decomposition/decomposition_file.h"

#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

#include <memory>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDecompositionReader);

//------------------------------------------------------------------------------
struct vtkGranularDecompositionReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularDecompositionReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::decomposition_kind)
    , Reader(reader)
  {
  }

  void Show(Shown& shown) override;

  vtkGranularDecompositionReader* const Reader;
};

//------------------------------------------------------------------------------
// Each rank reads the whole frame, and keeps its piece.
void vtkGranularDecompositionReader::Internals::Show(Shown& shown)
{
  shown.Progress.set_part(0, 0.4);
  granular::Decomposition all =
    granular::read_decomposition_pieces(shown.Pieces, shown.Notices, shown.Progress);
  granular::SubdomainChecks checks;
  checks.overlap = static_cast<granular::Answer>(this->Reader->CheckOverlap);
  checks.gap = static_cast<granular::Answer>(this->Reader->CheckGaps);
  shown.Progress.set_part(0.4, 0.8);
  granular::check_subdomains(all.subdomains, checks, shown.Where, shown.Notices, shown.Progress);

  granular::FrameHeader header;
  const granular::Subdomain bounds = granular::bounds_of(all.subdomains);
  header.box = granular::Box::from_bounds(bounds.lo, bounds.hi);
  header.box.boundary = "ff ff ff";
  header.timestep = shown.Pieces.front().entry.timestep;
  auto* output = vtkUnstructuredGrid::GetData(shown.Outputs);
  FillHeader(output->GetFieldData(), header, granular::Coordinates::Absolute, {});
  if (all.has_particles)
  {
    output->GetFieldData()->AddArray(
      MakeDoubles("imbalance", { granular::imbalance_of(all.subdomains) }));
  }

  const auto [begin, end] = shown.Piece.RangeOf(static_cast<vtkTypeInt64>(all.subdomains.size()));
  all.subdomains.erase(all.subdomains.begin() + end, all.subdomains.end());
  all.subdomains.erase(all.subdomains.begin(), all.subdomains.begin() + begin);
  VoxelForm form;
  form.Threads = this->GetThreads();
  shown.Progress.set_part(0.8, 1);
  FillVoxels(output, all, form, shown.Progress);
}

//------------------------------------------------------------------------------
vtkGranularDecompositionReader::vtkGranularDecompositionReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkUnstructuredGrid" });
}

//------------------------------------------------------------------------------
int vtkGranularDecompositionReader::CanReadFile(const char* fileName)
{
  return granular::is_decomposition_file(fileName ? fileName : "") ? 1 : 0;
}

vtkGranularOutputMacro(vtkGranularDecompositionReader, GetOutput, vtkUnstructuredGrid, 0);
vtkGranularPrintMacro(vtkGranularDecompositionReader, CheckOverlap, CheckGaps);
