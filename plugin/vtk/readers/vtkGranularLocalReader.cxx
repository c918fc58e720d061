// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalReader.h"

#include "private/readers/series_reader.h"
#include "private/request/print.h"

#include "granular/formats/local/local_file.h"
#include "granular/formats/local/local_presets.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <memory>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularLocalReader);

//------------------------------------------------------------------------------
struct vtkGranularLocalReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularLocalReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::local_kind)
    , Reader(reader)
  {
  }

  void SetOptions(granular::RunOptions& options) const override
  {
    const int preset = this->Reader->Preset;
    options.preset = preset == AUTOMATIC ? "Automatic"
      : preset == AS_NAMED               ? "AsNamed"
                                         : granular::local_presets()[preset - AS_NAMED - 1].name;
    options.column_map = this->Reader->ColumnMap;
  }

  void SetRequest(granular::Request& request) const override
  {
    request.periodic_lines = static_cast<granular::PeriodicLines>(this->Reader->PeriodicLines);
    std::copy_n(this->Reader->PointOrigin, 3, request.point_origin.begin());
  }

  vtkGranularLocalReader* const Reader;
};

//------------------------------------------------------------------------------
vtkGranularLocalReader::vtkGranularLocalReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkPolyData", "vtkTable", "vtkUnstructuredGrid" });
}

//------------------------------------------------------------------------------
int vtkGranularLocalReader::CanReadFile(const char* fileName)
{
  return granular::is_local_file(fileName ? fileName : "") ? 1 : 0;
}

vtkGranularOutputMacro(vtkGranularLocalReader, GetOutput, vtkPolyData, 0);
vtkGranularOutputMacro(vtkGranularLocalReader, GetRows, vtkTable, 1);
vtkGranularOutputMacro(vtkGranularLocalReader, GetBox, vtkUnstructuredGrid, 2);
vtkGranularPrintMacro(vtkGranularLocalReader, Preset, ColumnMap, PeriodicLines, PointOrigin);
