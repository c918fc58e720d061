// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalReader.h"

#include "private/arrays/array_choice.h"
#include "private/dump/dump_output.h"
#include "private/local/lines.h"
#include "private/request/look_together.h"
#include "private/request/piece_request.h"
#include "private/request/series_reader.h"

#include "granular/local/local_columns.h"
#include "granular/local/local_file.h"
#include "granular/local/local_reader.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularLocalReader);

namespace
{
/**
 * Meaning of the columns of a kind of frames, or the reason why it cannot be known.
 */
struct Meaning
{
  std::vector<std::string> Names;
  std::string Error; ///< where Names are only what the file says
  granular::Where Where;
  granular::Notices Notices;
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<Meaning>& meaning)
{
  granular::pass(archive, meaning.Names);
  archive.text(meaning.Error);
  granular::pass(archive, meaning.Where);
  granular::pass(archive, meaning.Notices);
}

/**
 * Meanings of all kinds, by the columns as the file names them.
 */
using Meanings = std::map<std::string, Meaning>;
}

//------------------------------------------------------------------------------
struct vtkGranularLocalReader::Internals
{
  using Self = vtkGranularLocalReader;
  using Shown = vtkGranularSeriesReader::Internals::Shown;

  std::string ColumnMap;
  ArrayChoice Arrays;
  Meanings Known; ///< empty: nobody has looked

  Meaning FindMeaning(
    Self* self, const granular::FramePiece& piece, granular::Progress& progress) const;
  void Look(Self* self);
  granular::LocalRequest MakeRequest(Self* self, vtkInformation* output) const;
  void FillOutputs(vtkInformationVector* outputs, const granular::LocalRequest& request,
    granular::LocalFrame& frame, Shown& shown) const;
  void Show(Self* self, vtkInformationVector* outputs, Shown& shown);
};

//------------------------------------------------------------------------------
// An error is kept: which arrays there are can be told all the same.
Meaning vtkGranularLocalReader::Internals::FindMeaning(
  Self* self, const granular::FramePiece& piece, granular::Progress& progress) const
{
  const granular::FrameKind& kind = *piece.entry.kind;
  std::vector<std::string> columns;
  for (const granular::ColumnInfo& column : kind.schema.columns())
  {
    columns.push_back(column.name);
  }
  Meaning meaning;
  meaning.Where = granular::where_of(piece);
  try
  {
    if (!this->ColumnMap.empty())
    {
      meaning.Names = granular::name_columns(columns, this->ColumnMap);
    }
    else if (self->Preset == AUTOMATIC)
    {
      const granular::LocalSample sample = granular::say_what_they_are(columns)
        ? granular::LocalSample()
        : granular::read_sample(self->Series->Index, kind, progress);
      meaning.Names = granular::find_columns(columns, sample, meaning.Where, meaning.Notices);
    }
    else if (self->Preset == AS_NAMED)
    {
      meaning.Names = granular::name_columns(columns);
    }
    else
    {
      const auto preset = static_cast<std::size_t>(self->Preset - AS_NAMED - 1);
      meaning.Names = granular::name_columns(columns, granular::local_presets()[preset]);
    }
  }
  catch (const granular::FormatError& error)
  {
    meaning.Error = error.text();
    meaning.Where = error.where().path.empty() ? meaning.Where : error.where();
    meaning.Names = granular::name_columns(columns);
  }
  return meaning;
}

//------------------------------------------------------------------------------
// Rank 0 looks, for all. Collective.
void vtkGranularLocalReader::Internals::Look(Self* self)
{
  if (!this->Known.empty())
  {
    return;
  }
  const auto look = [&](granular::ArchiveWriter& packer)
  {
    AlgorithmProgress progress(self);
    Meanings found;
    std::set<const granular::FrameKind*> seen;
    const granular::RunIndex& index = self->Series->Index;
    for (std::size_t frame = 0; frame < index.size(); ++frame)
    {
      const granular::FramePiece piece = index.first_piece(frame);
      if (!seen.insert(piece.entry.kind.get()).second)
      {
        continue;
      }
      const std::string columns = piece.entry.kind->schema.text();
      if (found.count(columns) == 0)
      {
        found[columns] = this->FindMeaning(self, piece, progress);
      }
    }
    std::size_t count = found.size();
    packer.number(count);
    for (auto& [columns, meaning] : found)
    {
      std::string key = columns;
      packer.text(key);
      pass(packer, meaning);
    }
  };
  const auto take = [&](granular::ArchiveReader& unpacker)
  {
    std::size_t count = 0;
    unpacker.number(count);
    Meanings found;
    this->Arrays.Begin();
    while (found.size() < count)
    {
      std::string columns;
      unpacker.text(columns);
      Meaning& meaning = found[columns];
      pass(unpacker, meaning);
      const granular::ColumnSchema schema = granular::make_local_schema(meaning.Names);
      for (const granular::ArrayInfo& array : schema.arrays())
      {
        this->Arrays.Add(array.name, !granular::is_end_array(array.name));
      }
    }
    this->Arrays.End();
    this->Known = std::move(found);
  };
  LookTogether(self->Series->GetRanks(), look, take);
}

//------------------------------------------------------------------------------
granular::LocalRequest vtkGranularLocalReader::Internals::MakeRequest(
  Self* self, vtkInformation* output) const
{
  granular::LocalRequest request;
  request.lines = MakeLineRequest(self->PeriodicLines, self->PointOrigin);
  request.lines.threads = ChooseThreads(self->Threads, self->Series->GetRanks());
  request.lines.pool = self->Series->Pool;
  request.wanted = [names = this->Arrays.GetWanted()](std::string_view name)
  { return names.count(std::string(name)) != 0; };
  const PieceRequest wanted = PieceRequest::Of(output);
  request.piece = wanted.Piece;
  request.pieces = wanted.Pieces;
  return request;
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::Internals::FillOutputs(vtkInformationVector* outputs,
  const granular::LocalRequest& request, granular::LocalFrame& frame, Shown& shown) const
{
  auto* lines = vtkPolyData::GetData(outputs, 0);
  auto* rows = vtkTable::GetData(outputs, 1);
  FillRows(rows, frame);
  if (frame.has_lines)
  {
    FillLines(lines, rows, frame, request.lines, shown.Where, shown.Notices);
  }
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    FillFieldData(vtkDataObject::GetData(outputs, port)->GetFieldData(), frame.table,
      request.lines.point_origin);
  }
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::Internals::Show(
  Self* self, vtkInformationVector* outputs, Shown& shown)
{
  granular::Communicator& ranks = self->Series->GetRanks();
  self->Series->StartFrame(shown.Notices);
  this->Look(self);
  granular::LocalRequest request = this->MakeRequest(self, shown.Port);
  this->Arrays.CheckNames(shown.Where.path, shown.Notices);
  const Meaning& meaning = this->Known.at(shown.Pieces.front().entry.kind->schema.text());
  if (!meaning.Error.empty())
  {
    throw granular::FormatError(meaning.Error, meaning.Where);
  }
  request.columns = meaning.Names;
  shown.Notices.insert(shown.Notices.end(), meaning.Notices.begin(), meaning.Notices.end());
  shown.Together = AskTogether(ranks, { request.piece, request.pieces }, this->Arrays.GetWanted(),
    [&](granular::ArchiveWriter& form)
    {
      form.number(shown.Number);
      form.number(request.lines.periodic);
      form.number(request.lines.point_origin);
    });
  granular::SerialCommunicator alone;
  granular::LocalFrame frame = granular::read_local(
    shown.Pieces, request, shown.Together ? ranks : alone, shown.Notices, shown.Progress);
  this->FillOutputs(outputs, request, frame, shown);
}

//------------------------------------------------------------------------------
vtkGranularLocalReader::vtkGranularLocalReader()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
  this->Series->Format = &granular::local_format();
  this->Internal->Arrays.GetSelection()->AddObserver(
    vtkCommand::ModifiedEvent, this, &vtkGranularLocalReader::Modified);
}

//------------------------------------------------------------------------------
vtkGranularLocalReader::~vtkGranularLocalReader() = default;

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularLocalReader::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkTable* vtkGranularLocalReader::GetRows()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::SetPreset(int preset)
{
  preset = std::clamp(preset, static_cast<int>(AUTOMATIC), static_cast<int>(BOND_TYPE_IDS_FORCE));
  if (this->Preset != preset)
  {
    this->Preset = preset;
    this->Internal->Known.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::SetColumnMap(const char* map)
{
  const std::string wanted = map ? map : "";
  if (this->Internal->ColumnMap != wanted)
  {
    this->Internal->ColumnMap = wanted;
    this->Internal->Known.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkGranularLocalReader::GetColumnMap()
{
  return this->Internal->ColumnMap.c_str();
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularLocalReader::GetCellDataArraySelection()
{
  return this->Internal->Arrays.GetSelection();
}

//------------------------------------------------------------------------------
int vtkGranularLocalReader::CanReadFile(const char* fileName)
{
  return granular::is_local_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::ForgetFrames()
{
  this->Internal->Known.clear();
}

//------------------------------------------------------------------------------
int vtkGranularLocalReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkTable");
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::InspectFrames(vtkInformationVector* vtkNotUsed(outputVector))
{
  this->Internal->Look(this);
}

//------------------------------------------------------------------------------
int vtkGranularLocalReader::RequestData(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  return this->Series->Run(this, request, outputVector,
    [&](auto& shown) { this->Internal->Show(this, outputVector, shown); });
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preset: " << this->Preset << "\n";
  os << indent << "ColumnMap: " << this->Internal->ColumnMap << "\n";
  os << indent << "PeriodicLines: " << this->PeriodicLines << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
  os << indent << "CellArrays:\n";
  this->Internal->Arrays.GetSelection()->PrintSelf(os, indent.GetNextIndent());
}
