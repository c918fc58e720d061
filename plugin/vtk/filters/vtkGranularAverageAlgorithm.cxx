// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularAverageAlgorithm.h"

#include "private/euler/average_task.h"

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
vtkGranularAverageAlgorithm::vtkGranularAverageAlgorithm()
  : ArraySelection(MakeSelection(this, AverageArrays))
{
  this->SetPorts({ Input::Required, Input::Optional, Input::Optional }, { "vtkDataObject" });
}

//------------------------------------------------------------------------------
vtkGranularAverageAlgorithm::~vtkGranularAverageAlgorithm()
{
  this->ArraySelection->Delete();
}

//------------------------------------------------------------------------------
void vtkGranularAverageAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "KernelWidth: " << this->KernelWidth << "\n";
  os << indent << "VelocityArray: " << this->VelocityArray << "\n";
  os << indent << "MassArray: " << this->MassArray << "\n";
  os << indent << "RadiusArray: " << this->RadiusArray << "\n";
  os << indent << "ArraySelection:\n";
  this->ArraySelection->PrintSelf(os, indent.GetNextIndent());
}
