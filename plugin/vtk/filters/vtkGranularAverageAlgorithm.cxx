// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularAverageAlgorithm.h"

#include "private/arrays/made_arrays.h"
#include "private/euler/average_task.h"
#include "private/request/print.h"

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
vtkGranularAverageAlgorithm::vtkGranularAverageAlgorithm()
  : ArraySelection(MakeSelection(this, granular::average_arrays))
{
  this->SetPorts({ Input::Required, Input::Optional, Input::Optional }, { "vtkDataObject" });
}

//------------------------------------------------------------------------------
vtkGranularAverageAlgorithm::~vtkGranularAverageAlgorithm()
{
  this->ArraySelection->Delete();
}

//------------------------------------------------------------------------------
void vtkGranularAverageAlgorithm::SetArrayStatus(const char* name, int status)
{
  this->ArraySelection->SetArraySetting(name, status);
}

//------------------------------------------------------------------------------
void vtkGranularAverageAlgorithm::ClearArrays()
{
  this->ArraySelection->DisableAllArrays();
}

vtkGranularPrintMacro(
  vtkGranularAverageAlgorithm, KernelWidth, VelocityArray, MassArray, RadiusArray, ArraySelection);
