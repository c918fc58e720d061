// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPathAlgorithm.h"

#include "private/request/print.h"

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

vtkGranularPrintMacro(vtkGranularPathAlgorithm, Ids, EveryNth, NumberOfSamples, Seed,
  RegionOfInterest, SelectionFrame, TimeWindow, FrameStride, Arrays);
