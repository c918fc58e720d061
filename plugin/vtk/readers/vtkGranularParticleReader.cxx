// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularParticleReader.h"

#include "private/readers/series_reader.h"
#include "private/request/print.h"

#include "vtkPolyData.h"

#include <memory>
#include <utility>

//------------------------------------------------------------------------------
vtkGranularParticleReader::vtkGranularParticleReader(std::unique_ptr<Internals> internals)
  : Superclass(std::move(internals))
{
}

vtkGranularOutputMacro(vtkGranularParticleReader, GetOutput, vtkPolyData, 0);
vtkGranularPrintMacro(
  vtkGranularParticleReader, Coordinates, PointOrigin, SortById, Stride, RegionOfInterest);
