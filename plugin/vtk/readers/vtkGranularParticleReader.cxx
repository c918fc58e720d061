// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularParticleReader.h"

#include "private/readers/series_reader.h"

#include "vtkPolyData.h"

#include <memory>
#include <utility>

//------------------------------------------------------------------------------
vtkGranularParticleReader::vtkGranularParticleReader(std::unique_ptr<Internals> internals)
  : Superclass(std::move(internals))
{
}

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularParticleReader::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
void vtkGranularParticleReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Coordinates: " << this->Coordinates << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
  os << indent << "SortById: " << (this->SortById ? "On" : "Off") << "\n";
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "RegionOfInterest:";
  for (double bound : this->RegionOfInterest)
  {
    os << " " << bound;
  }
  os << "\n";
}
