// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPathAlgorithm.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

//------------------------------------------------------------------------------
int vtkGranularPathAlgorithm::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->IsTheSameAtAllTimes())
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    info->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    info->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  }
  return this->Superclass::RequestInformation(request, inputVector, outputVector);
}

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
