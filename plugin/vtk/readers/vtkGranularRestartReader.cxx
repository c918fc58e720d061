// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularRestartReader.h"

#include "private/readers/series_reader.h"
#include "private/request/print.h"

#include "granular/formats/restart/restart_file.h"
#include "granular/formats/restart/restart_reader.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <memory>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularRestartReader);

//------------------------------------------------------------------------------
struct vtkGranularRestartReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularRestartReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::restart_kind)
    , Reader(reader)
  {
    this->Points.Follow = true; // a history that gets other names is off where parts of it were
    this->Cells.Follow = true;
  }

  void SetOptions(granular::RunOptions& options) const override
  {
    options.history_layout = this->Reader->HistoryLayout;
  }

  void SetRequest(granular::Request& request) const override
  {
    request.periodic_lines = static_cast<granular::PeriodicLines>(this->Reader->PeriodicLines);
    std::copy_n(this->Reader->PointOrigin, 3, request.point_origin.begin());
  }

  vtkGranularRestartReader* const Reader;
};

//------------------------------------------------------------------------------
vtkGranularRestartReader::vtkGranularRestartReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkPolyData", "vtkPolyData", "vtkUnstructuredGrid" });
  this->RepeatedSteps = LAST; // what is in files of one process each is one file to the index
}

//------------------------------------------------------------------------------
int vtkGranularRestartReader::CanReadFile(const char* fileName)
{
  return granular::is_restart_file(fileName ? fileName : "") ? 1 : 0;
}

vtkGranularOutputMacro(vtkGranularRestartReader, GetOutput, vtkPolyData, 0);
vtkGranularOutputMacro(vtkGranularRestartReader, GetBonds, vtkPolyData, 1);
vtkGranularPrintMacro(vtkGranularRestartReader, HistoryLayout, PeriodicLines, PointOrigin);
