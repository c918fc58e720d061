// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalReader.h"

#include "private/local/lines.h"
#include "private/readers/series_reader.h"

#include "granular/common/pass.h"
#include "granular/local/local_columns.h"
#include "granular/local/local_file.h"
#include "granular/local/local_reader.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <map>
#include <memory>
#include <set>
#include <string>
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
}

//------------------------------------------------------------------------------
struct vtkGranularLocalReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularLocalReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::local_format())
    , Reader(reader)
  {
  }

  std::string GetLookKey() const override;
  Meaning FindMeaning(const granular::FramePiece& piece, granular::Progress& progress) const;
  Found Look(granular::ArchiveWriter& archive) override;
  void Take(granular::ArchiveReader& archive) override;
  void Show(Shown& shown) override;

  vtkGranularLocalReader* const Reader;
  std::map<std::string, Meaning> Meanings; ///< of all kinds, by the columns as the file names them
};

//------------------------------------------------------------------------------
std::string vtkGranularLocalReader::Internals::GetLookKey() const
{
  return std::to_string(this->Reader->Preset) + " " + this->Reader->ColumnMap;
}

//------------------------------------------------------------------------------
// An error is kept: which arrays there are can be told all the same.
Meaning vtkGranularLocalReader::Internals::FindMeaning(
  const granular::FramePiece& piece, granular::Progress& progress) const
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
    if (!this->Reader->ColumnMap.empty())
    {
      meaning.Names = granular::name_columns(columns, this->Reader->ColumnMap);
    }
    else if (this->Reader->Preset == AUTOMATIC)
    {
      const granular::LocalSample sample = granular::say_what_they_are(columns)
        ? granular::LocalSample()
        : granular::read_sample(this->Index, kind, progress);
      meaning.Names = granular::find_columns(columns, sample, meaning.Where, meaning.Notices);
    }
    else if (this->Reader->Preset == AS_NAMED)
    {
      meaning.Names = granular::name_columns(columns);
    }
    else
    {
      const auto preset = static_cast<std::size_t>(this->Reader->Preset - AS_NAMED - 1);
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
vtkGranularSeriesReader::Internals::Found vtkGranularLocalReader::Internals::Look(
  granular::ArchiveWriter& archive)
{
  AlgorithmProgress progress(this->Reader);
  Found found;
  std::map<std::string, Meaning> meanings;
  std::set<const granular::FrameKind*> seen;
  for (std::size_t frame = 0; frame < this->Index.size(); ++frame)
  {
    const granular::FramePiece piece = this->Index.first_piece(frame);
    const granular::FrameKind& kind = *piece.entry.kind;
    if (seen.insert(&kind).second && !meanings.contains(kind.schema.text()))
    {
      meanings.emplace(kind.schema.text(), this->FindMeaning(piece, progress));
    }
  }
  archive.count(meanings.size());
  for (const auto& [columns, meaning] : meanings)
  {
    archive.text(columns);
    pass(archive, meaning);
    const granular::ColumnSchema schema = granular::make_local_schema(meaning.Names);
    for (const granular::ArrayInfo& array : schema.arrays())
    {
      found.Cells.push_back({ array.name, !granular::is_end_array(array.name) });
    }
  }
  return found;
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::Internals::Take(granular::ArchiveReader& archive)
{
  this->Meanings.clear();
  for (std::size_t left = archive.count(1); left > 0; --left)
  {
    std::string columns;
    archive.text(columns);
    pass(archive, this->Meanings[columns]);
  }
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::Internals::Show(Shown& shown)
{
  granular::LocalRequest request;
  request.lines = this->MakeLineRequest(this->Reader->PeriodicLines, this->Reader->PointOrigin);
  request.wanted = this->Cells.MakeFilter();
  request.piece = shown.Piece.Piece;
  request.pieces = shown.Piece.Pieces;
  this->Cells.CheckNames(shown.Where.path, shown.Notices);
  const Meaning& meaning = this->Meanings.at(shown.Pieces.front().entry.kind->schema.text());
  if (!meaning.Error.empty())
  {
    throw granular::FormatError(meaning.Error, meaning.Where);
  }
  request.columns = meaning.Names;
  shown.Notices.insert(shown.Notices.end(), meaning.Notices.begin(), meaning.Notices.end());
  granular::Communicator& group = this->FindGroup(shown,
    [&](granular::ArchiveWriter& form)
    {
      form.number(request.lines.periodic);
      form.number(request.lines.point_origin);
    });
  granular::LocalFrame frame =
    granular::read_local(shown.Pieces, request, group, shown.Notices, shown.Progress);
  auto* lines = vtkPolyData::GetData(shown.Outputs, 0);
  auto* rows = vtkTable::GetData(shown.Outputs, 1);
  FillRows(rows, frame);
  if (frame.has_lines)
  {
    FillLines(lines, rows, frame, request.lines, shown.Where, shown.Notices);
  }
  FillFieldData(lines->GetFieldData(), frame.table, request.lines.point_origin);
  FillFieldData(rows->GetFieldData(), frame.table, request.lines.point_origin);
}

//------------------------------------------------------------------------------
vtkGranularLocalReader::vtkGranularLocalReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkPolyData", "vtkTable" });
}

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
int vtkGranularLocalReader::CanReadFile(const char* fileName)
{
  return granular::is_local_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularLocalReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preset: " << this->Preset << "\n";
  os << indent << "ColumnMap: " << this->ColumnMap << "\n";
  os << indent << "PeriodicLines: " << this->PeriodicLines << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
}
