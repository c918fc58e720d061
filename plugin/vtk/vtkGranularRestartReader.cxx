// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularRestartReader.h"

#include "private/readers/series_reader.h"

#include "granular/restart/restart_file.h"
#include "granular/restart/restart_reader.h"

#include "vtkDataArraySelection.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularRestartReader);

namespace
{
/**
 * Returns the choice of the user; an array that neither the first nor the last file has is on where all others are.
 */
std::function<bool(std::string_view)> Wanted(const ArrayChoice& choice)
{
  return [wanted = choice.MakeFilter(), all = choice.AreAllOn(), &choice](std::string_view name)
  {
    return wanted(name) ||
      (all && choice.GetSelection()->ArrayExists(std::string(name).c_str()) == 0);
  };
}

/**
 * The layout as the core counts, by HistoryLayoutType.
 */
constexpr int Layouts[] = { granular::automatic_history, granular::numbered_history, 0, 1, 2, 3 };
}

//------------------------------------------------------------------------------
struct vtkGranularRestartReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularRestartReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::restart_format())
    , Reader(reader)
  {
    this->Points.Follow = true; // a history that gets other names is off where parts of it were
    this->Cells.Follow = true;
  }

  std::string GetLookKey() const override { return std::to_string(this->Reader->HistoryLayout); }
  Found Look(granular::ArchiveWriter& archive) override;
  void Show(Shown& shown) override;

  vtkGranularRestartReader* const Reader;
};

//------------------------------------------------------------------------------
// At the first file and the last one, as bonds may come with time.
vtkGranularSeriesReader::Internals::Found vtkGranularRestartReader::Internals::Look(
  granular::ArchiveWriter&)
{
  AlgorithmProgress progress(this->Reader);
  granular::Notices notices; // are given again where the frame is shown
  Found found;
  for (const std::size_t frame : std::set<std::size_t>{ 0, this->Index.size() - 1 })
  {
    const granular::FileIndex& file = this->Index.first_piece(frame).file;
    const auto source = granular::open_indexed(file);
    const auto layout = granular::find_restart_layout(file, *source, notices, progress);
    const granular::RestartColumns columns =
      granular::find_restart_columns(*source, *layout, notices, progress);
    AddNames(granular::ColumnSchema(columns.particles), found.Points);
    if (columns.has_bonds)
    {
      AddNames(granular::make_bond_schema(Layouts[this->Reader->HistoryLayout],
                 layout->header.version, columns.history_values),
        found.Cells);
    }
  }
  return found;
}

//------------------------------------------------------------------------------
// Each rank reads what its piece needs by itself.
void vtkGranularRestartReader::Internals::Show(Shown& shown)
{
  granular::Notices& notices = shown.Notices;
  granular::PartialProgress& progress = shown.Progress;
  granular::RestartRequest request;
  request.lines = this->MakeLineRequest(this->Reader->PeriodicLines, this->Reader->PointOrigin);
  request.history_layout = Layouts[this->Reader->HistoryLayout];
  request.wanted = Wanted(this->Points);
  request.wanted_bonds = Wanted(this->Cells);
  request.piece = shown.Piece.Piece;
  request.pieces = shown.Piece.Pieces;
  const granular::FileIndex& file = shown.Pieces.front().file;
  const auto source = granular::open_indexed(file);
  progress.set_part(0, 0.1);
  const auto layout = granular::find_restart_layout(file, *source, notices, progress);
  progress.set_part(0.1, 0.95);
  granular::RestartFrame frame =
    granular::read_restart(*source, *layout, request, notices, progress);
  this->Points.CheckNames(shown.Where.path, notices, frame.particles.schema);
  this->Cells.CheckNames(shown.Where.path, notices, frame.bonds.table.schema);
  this->FillParticles(shown, frame.particles, request.lines.point_origin);
  FillBonds(shown, frame.bonds, request.lines);
  vtkPolyData::GetData(shown.Outputs, 0)
    ->GetFieldData()
    ->AddArray(MakeStrings("Groups", layout->groups));
}

//------------------------------------------------------------------------------
vtkGranularRestartReader::vtkGranularRestartReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkPolyData", "vtkPolyData", "vtkUnstructuredGrid" });
  this->RepeatedSteps = LAST; // what is in files of one process each is one file to the index
}

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularRestartReader::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularRestartReader::GetBonds()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
int vtkGranularRestartReader::CanReadFile(const char* fileName)
{
  return granular::is_restart_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularRestartReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HistoryLayout: " << this->HistoryLayout << "\n";
  os << indent << "PeriodicLines: " << this->PeriodicLines << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
}
