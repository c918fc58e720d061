// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpReader.h"

#include "private/dump/input_frames.h"
#include "private/readers/series_reader.h"

#include "granular/common/words.h"
#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDumpReader);

//------------------------------------------------------------------------------
struct vtkGranularDumpReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularDumpReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::dump_format())
    , Reader(reader)
  {
  }

  std::vector<std::string> GetColumnNames() const override;
  Found Look(granular::ArchiveWriter& archive) override;
  granular::DumpRequest MakeRequest();
  void Show(Shown& shown) override;

  vtkGranularDumpReader* const Reader;
};

//------------------------------------------------------------------------------
std::vector<std::string> vtkGranularDumpReader::Internals::GetColumnNames() const
{
  std::string names = this->Reader->ColumnNames; // no column has a comma in its name
  std::ranges::replace(names, ',', ' ');
  const std::vector<std::string_view> words = granular::split_words(names);
  return { words.begin(), words.end() };
}

//------------------------------------------------------------------------------
// The arrays of all frames, in the order in which they occur.
vtkGranularSeriesReader::Internals::Found vtkGranularDumpReader::Internals::Look(
  granular::ArchiveWriter&)
{
  Found found;
  std::set<const granular::FrameKind*> seen;
  for (std::size_t frame = 0; frame < this->Index.size(); ++frame)
  {
    const granular::FrameKind* kind = this->Index.first_piece(frame).entry.kind.get();
    if (seen.insert(kind).second)
    {
      AddNames(kind->schema, found.Points);
    }
  }
  return found;
}

//------------------------------------------------------------------------------
granular::DumpRequest vtkGranularDumpReader::Internals::MakeRequest()
{
  granular::DumpRequest request = this->MakeDumpRequest(this->Reader);
  request.single_precision = this->Reader->PointPrecision == SINGLE_PRECISION;
  return request;
}

//------------------------------------------------------------------------------
// The ranks exchange rows, if they read together.
void vtkGranularDumpReader::Internals::Show(Shown& shown)
{
  granular::DumpRequest request = this->MakeRequest();
  request.piece = shown.Piece.Piece;
  request.pieces = shown.Piece.Pieces;
  request.ranges = true; // whoever shows an array asks for it
  this->Points.CheckNames(shown.Where.path, shown.Notices);
  granular::Communicator& group =
    this->FindGroup(shown, [&](granular::ArchiveWriter& form) { PassForm(form, request); });
  granular::DumpFrame frame =
    granular::read_dump(shown.Pieces, request, group, shown.Notices, shown.Progress);
  this->FillParticles(shown, frame, request.point_origin, request.single_precision,
    static_cast<VertexCells>(this->Reader->Vertices));
  FillLeftOut(shown.Outputs, request);
}

//------------------------------------------------------------------------------
std::optional<ReaderFrames> ReaderFrames::Find(vtkAlgorithm* consumer)
{
  int port = 0;
  vtkAlgorithm* algorithm = consumer->GetInputAlgorithm(0, 0, port);
  while (algorithm && port == 0 && algorithm->IsA("vtkPVPostFilter"))
  {
    algorithm = algorithm->GetInputAlgorithm(0, 0, port);
  }
  auto* reader = vtkGranularDumpReader::SafeDownCast(algorithm);
  if (!reader || port != 0 || !reader->Series->Valid || reader->Series->Index.size() == 0)
  {
    return {};
  }
  auto& internals = static_cast<vtkGranularDumpReader::Internals&>(*reader->Series);
  return ReaderFrames{ &internals.Index, internals.MakeRequest() };
}

//------------------------------------------------------------------------------
vtkGranularDumpReader::vtkGranularDumpReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkPolyData", "vtkUnstructuredGrid" });
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::CanReadFile(const char* fileName)
{
  return granular::is_dump_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ColumnNames: " << this->ColumnNames << "\n";
  os << indent << "PointPrecision: " << this->PointPrecision << "\n";
  os << indent << "Vertices: " << this->Vertices << "\n";
}
