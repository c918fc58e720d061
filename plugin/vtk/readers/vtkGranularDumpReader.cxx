// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpReader.h"

#include "private/dump/input_frames.h"
#include "private/readers/series_reader.h"
#include "private/request/print.h"

#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/frames/other_files.h"

#include "vtkObjectFactory.h"

#include <memory>
#include <optional>
#include <utility>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDumpReader);

//------------------------------------------------------------------------------
struct vtkGranularDumpReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularDumpReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::dump_kind)
    , Reader(reader)
  {
  }

  void SetOptions(granular::RunOptions& options) const override
  {
    options.column_names = this->Reader->ColumnNames;
  }

  void SetRequest(granular::Request& request) const override
  {
    SetParticles(request, this->Reader);
    request.single_precision = this->Reader->PointPrecision == SINGLE_PRECISION;
  }

  VertexCells GetVertices() const override
  {
    return static_cast<VertexCells>(this->Reader->Vertices);
  }

  vtkGranularDumpReader* const Reader;
};

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
  if (!reader || port != 0 || !reader->Series->Valid || reader->Series->Run.index().size() == 0)
  {
    return {};
  }
  granular::Request request = reader->Series->MakeRequest();
  request.ranges = false; // filters need none
  return ReaderFrames{ &reader->Series->Run.index(), std::move(request) };
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
  const std::string name = fileName ? fileName : "";
  return granular::is_dump_file(name) || granular::is_refused_file(name) ? 1 : 0;
}

vtkGranularPrintMacro(vtkGranularDumpReader, ColumnNames, PointPrecision, Vertices);
