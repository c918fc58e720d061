// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPathAlgorithm.h"

#include "private/request/text_of.h"

#include "vtkInformation.h"

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
vtkGranularPathAlgorithm::vtkGranularPathAlgorithm() = default;

//------------------------------------------------------------------------------
vtkGranularPathAlgorithm::~vtkGranularPathAlgorithm()
{
  this->SetIds(nullptr);
  this->SetArrays(nullptr);
}

//------------------------------------------------------------------------------
// All data come in, and are looked at by all processes together: see Particles.
int vtkGranularPathAlgorithm::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularPathAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Ids: " << TextOf(this->Ids) << "\n";
  os << indent << "EveryNth: " << this->EveryNth << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "RegionOfInterest:";
  for (double bound : this->RegionOfInterest)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "SelectionFrame: " << this->SelectionFrame << "\n";
  os << indent << "TimeWindow: " << this->TimeWindow[0] << " " << this->TimeWindow[1] << "\n";
  os << indent << "FrameStride: " << this->FrameStride << "\n";
  os << indent << "Arrays: " << TextOf(this->Arrays) << "\n";
}
