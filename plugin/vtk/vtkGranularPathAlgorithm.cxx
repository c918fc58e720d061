// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPathAlgorithm.h"

//------------------------------------------------------------------------------
void vtkGranularPathAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Ids: " << this->Ids << "\n";
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
  os << indent << "Arrays: " << this->Arrays << "\n";
}
