// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDataFileReader.h"

#include "private/readers/series_reader.h"
#include "private/request/print.h"

#include "granular/formats/data_file/data_file.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <memory>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDataFileReader);

//------------------------------------------------------------------------------
struct vtkGranularDataFileReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularDataFileReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::data_file_kind)
    , Reader(reader)
  {
  }

  void SetOptions(granular::RunOptions& options) const override
  {
    options.atom_style = this->Reader->AtomStyle;
    options.boundary = this->Reader->Boundary;
  }

  void SetRequest(granular::Request& request) const override
  {
    SetParticles(request, this->Reader);
    request.periodic_lines = static_cast<granular::PeriodicLines>(this->Reader->PeriodicLines);
  }

  vtkGranularDataFileReader* const Reader;
};

//------------------------------------------------------------------------------
vtkGranularDataFileReader::vtkGranularDataFileReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkPolyData", "vtkPolyData", "vtkUnstructuredGrid" });
  this->RepeatedSteps = LAST; // no file is a piece of another
}

//------------------------------------------------------------------------------
int vtkGranularDataFileReader::CanReadFile(const char* fileName)
{
  return granular::is_data_file(fileName ? fileName : "") ? 1 : 0;
}

vtkGranularOutputMacro(vtkGranularDataFileReader, GetBonds, vtkPolyData, 1);
vtkGranularPrintMacro(vtkGranularDataFileReader, AtomStyle, Boundary, PeriodicLines);
