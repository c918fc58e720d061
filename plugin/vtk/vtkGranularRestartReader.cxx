// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularRestartReader.h"

#include "private/arrays/array_choice.h"
#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/local/lines.h"
#include "private/request/look_together.h"
#include "private/request/piece_request.h"
#include "private/request/series_reader.h"

#include "granular/restart/history_layout.h"
#include "granular/restart/restart_file.h"
#include "granular/restart/restart_reader.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularRestartReader);

namespace
{
/**
 * An array that files have.
 */
struct ArrayName
{
  std::string Name;
  bool IsUsual = true; ///< false: no more than the points say
};

using ArrayNames = std::vector<ArrayName>;

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<ArrayName>& array)
{
  archive.text(array.Name);
  archive.number(array.IsUsual);
}

/**
 * Adds the names of all arrays, whether they are there or not: ArrayChoice takes each once.
 */
void AddNames(const granular::ColumnSchema& schema, ArrayNames& names)
{
  for (const granular::ArrayInfo& array : schema.arrays())
  {
    names.push_back({ array.name, !array.position_form });
  }
}

/**
 * A history that gets other names is off where parts of it were.
 */
void Offer(ArrayChoice& choice, const ArrayNames& names)
{
  choice.Begin(true);
  for (const ArrayName& array : names)
  {
    choice.Add(array.Name, array.IsUsual);
  }
  choice.End();
}

std::vector<std::string> NamesOf(const granular::ColumnSchema& schema)
{
  std::vector<std::string> names;
  for (const granular::ArrayInfo& array : schema.arrays())
  {
    names.push_back(array.name);
  }
  return names;
}

/**
 * Returns the choice of the user; an array that neither the first nor the last file has is on where all others are.
 */
std::function<bool(std::string_view)> Wanted(const ArrayChoice& choice)
{
  return [names = choice.GetWanted(), all = choice.AreAllOn(), &choice](std::string_view name)
  {
    const std::string array(name);
    return names.count(array) != 0 ||
      (all && choice.GetSelection()->ArrayExists(array.c_str()) == 0);
  };
}

/**
 * The layout as the core counts, by HistoryLayoutType.
 */
constexpr int Layouts[] = { granular::automatic_history, granular::numbered_history, 0, 1, 2, 3 };
}

//------------------------------------------------------------------------------
struct vtkGranularRestartReader::Internals
{
  using Self = vtkGranularRestartReader;
  using Shown = vtkGranularSeriesReader::Internals::Shown;

  ArrayChoice Points;
  ArrayChoice Cells;
  bool Known = false;   ///< somebody has looked which arrays there are
  VertexCache Vertices; ///< of the frame before

  void Look(Self* self);
  granular::RestartRequest MakeRequest(Self* self, vtkInformation* output) const;
  void FillOutputs(Self* self, vtkInformationVector* outputs,
    const granular::RestartRequest& request, granular::RestartFrame& frame, Shown& shown);
  void Show(Self* self, vtkInformationVector* outputs, Shown& shown);
};

//------------------------------------------------------------------------------
// Rank 0 looks, for all: at the first file and the last one, as bonds may come with time. Collective.
void vtkGranularRestartReader::Internals::Look(Self* self)
{
  if (this->Known)
  {
    return;
  }
  const auto look = [&](granular::ArchiveWriter& packer)
  {
    ArrayNames particles;
    ArrayNames bonds;
    AlgorithmProgress progress(self);
    granular::Notices notices; // are given again where the frame is shown
    const granular::RunIndex& index = self->Series->Index;
    for (const std::size_t frame : std::set<std::size_t>{ 0, index.size() - 1 })
    {
      const granular::FileIndex& file = index.first_piece(frame).file;
      const auto source = granular::open_indexed(file);
      const auto layout = granular::find_restart_layout(file, *source, notices, progress);
      const granular::RestartColumns columns =
        granular::find_restart_columns(*source, *layout, notices, progress);
      AddNames(granular::ColumnSchema(columns.particles), particles);
      if (columns.has_bonds)
      {
        AddNames(granular::make_bond_schema(
                   Layouts[self->HistoryLayout], layout->header.version, columns.history_values),
          bonds);
      }
    }
    granular::pass(packer, particles);
    granular::pass(packer, bonds);
  };
  const auto take = [&](granular::ArchiveReader& unpacker)
  {
    ArrayNames names;
    granular::pass(unpacker, names);
    Offer(this->Points, names);
    granular::pass(unpacker, names);
    Offer(this->Cells, names);
    this->Known = true;
  };
  LookTogether(self->Series->GetRanks(), look, take);
}

//------------------------------------------------------------------------------
granular::RestartRequest vtkGranularRestartReader::Internals::MakeRequest(
  Self* self, vtkInformation* output) const
{
  granular::RestartRequest request;
  request.lines = MakeLineRequest(self->PeriodicLines, self->PointOrigin);
  request.lines.threads = ChooseThreads(self->Threads, self->Series->GetRanks());
  request.lines.pool = self->Series->Pool;
  request.history_layout = Layouts[self->HistoryLayout];
  request.wanted = Wanted(this->Points);
  request.wanted_bonds = Wanted(this->Cells);
  const PieceRequest wanted = PieceRequest::Of(output);
  request.piece = wanted.Piece;
  request.pieces = wanted.Pieces;
  return request;
}

//------------------------------------------------------------------------------
void vtkGranularRestartReader::Internals::FillOutputs(Self* self, vtkInformationVector* outputs,
  const granular::RestartRequest& request, granular::RestartFrame& frame, Shown& shown)
{
  const granular::Vector3& origin = request.lines.point_origin;
  auto* particles = vtkPolyData::GetData(outputs, 0);
  FillParticles(particles, frame.particles, false, VertexCells::OnePerPoint, this->Vertices,
    self->Series->Pool);

  auto* lines = vtkPolyData::GetData(outputs, 1);
  vtkNew<vtkTable> rows;
  FillRows(rows, frame.bonds);
  FillLines(lines, rows, frame.bonds, request.lines, shown.Where, shown.Notices);

  auto* box = vtkUnstructuredGrid::GetData(outputs, 2);
  if (request.piece == 0 &&
    !FillBox(box, frame.particles.header.box, granular::Coordinates::Absolute, origin))
  {
    shown.Notices.push_back({ shown.Where, "the box is not finite and not shown" });
  }

  FillFieldData(particles->GetFieldData(), frame.particles, origin);
  FillFieldData(lines->GetFieldData(), frame.bonds.table, origin);
  FillFieldData(box->GetFieldData(), frame.particles, origin);
}

//------------------------------------------------------------------------------
// Each rank reads what its piece needs by itself.
void vtkGranularRestartReader::Internals::Show(
  Self* self, vtkInformationVector* outputs, Shown& shown)
{
  granular::Notices& notices = shown.Notices;
  granular::PartialProgress& progress = shown.Progress;
  self->Series->StartFrame(notices);
  this->Look(self);
  const granular::RestartRequest request = this->MakeRequest(self, shown.Port);
  const granular::FileIndex& file = shown.Pieces.front().file;
  const auto source = granular::open_indexed(file);
  progress.set_part(0, 0.1);
  const auto layout = granular::find_restart_layout(file, *source, notices, progress);
  progress.set_part(0.1, 0.95);
  granular::RestartFrame restart =
    granular::read_restart(*source, *layout, request, notices, progress);
  this->Points.CheckNames(shown.Where.path, notices, NamesOf(restart.particles.schema));
  this->Cells.CheckNames(shown.Where.path, notices, NamesOf(restart.bonds.table.schema));
  this->FillOutputs(self, outputs, request, restart, shown);
  vtkPolyData::GetData(outputs, 0)->GetFieldData()->AddArray(MakeStrings("Groups", layout->groups));
}

//------------------------------------------------------------------------------
vtkGranularRestartReader::vtkGranularRestartReader()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(3);
  this->RepeatedSteps = LAST; // what is in files of one process each is one file to the index
  this->Series->Format = &granular::restart_format();
  for (const ArrayChoice* choice : { &this->Internal->Points, &this->Internal->Cells })
  {
    choice->GetSelection()->AddObserver(
      vtkCommand::ModifiedEvent, this, &vtkGranularRestartReader::Modified);
  }
}

//------------------------------------------------------------------------------
vtkGranularRestartReader::~vtkGranularRestartReader() = default;

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
void vtkGranularRestartReader::SetHistoryLayout(int layout)
{
  layout =
    std::clamp(layout, static_cast<int>(AUTOMATIC), static_cast<int>(FLEXIBLE_FIBERS_DAMAGE));
  if (this->HistoryLayout != layout)
  {
    this->HistoryLayout = layout;
    this->Internal->Known = false; // arrays have other names
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularRestartReader::GetPointDataArraySelection()
{
  return this->Internal->Points.GetSelection();
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularRestartReader::GetCellDataArraySelection()
{
  return this->Internal->Cells.GetSelection();
}

//------------------------------------------------------------------------------
int vtkGranularRestartReader::CanReadFile(const char* fileName)
{
  return granular::is_restart_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularRestartReader::ForgetFrames()
{
  this->Internal->Known = false;
}

//------------------------------------------------------------------------------
int vtkGranularRestartReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularRestartReader::InspectFrames(vtkInformationVector* vtkNotUsed(outputVector))
{
  this->Internal->Look(this);
}

//------------------------------------------------------------------------------
int vtkGranularRestartReader::RequestData(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  return this->Series->Run(this, request, outputVector,
    [&](auto& shown) { this->Internal->Show(this, outputVector, shown); });
}

//------------------------------------------------------------------------------
void vtkGranularRestartReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HistoryLayout: " << this->HistoryLayout << "\n";
  os << indent << "PeriodicLines: " << this->PeriodicLines << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
  os << indent << "PointArrays:\n";
  this->Internal->Points.GetSelection()->PrintSelf(os, indent.GetNextIndent());
  os << indent << "CellArrays:\n";
  this->Internal->Cells.GetSelection()->PrintSelf(os, indent.GetNextIndent());
}
