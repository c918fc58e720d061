// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularAverageAlgorithm.h"

#include "private/arrays/made_arrays.h"
#include "private/euler/chosen_fields.h"
#include "private/request/text_of.h"

#include "vtkInformation.h"

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
vtkGranularAverageAlgorithm::vtkGranularAverageAlgorithm()
  : ArraySelection(MakeSelection(this, AverageArrays))
{
  this->SetNumberOfInputPorts(3);
  this->SetVelocityArray("v");
  this->SetMassArray("mass");
  this->SetRadiusArray("radius");
}

//------------------------------------------------------------------------------
vtkGranularAverageAlgorithm::~vtkGranularAverageAlgorithm()
{
  this->SetVelocityArray(nullptr);
  this->SetMassArray(nullptr);
  this->SetRadiusArray(nullptr);
  this->ArraySelection->Delete();
}

//------------------------------------------------------------------------------
void vtkGranularAverageAlgorithm::SetLinesConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

//------------------------------------------------------------------------------
void vtkGranularAverageAlgorithm::SetWallsConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(2, output);
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularAverageAlgorithm::GetArraySelection()
{
  return this->ArraySelection;
}

//------------------------------------------------------------------------------
// All data come in, and are looked at by all processes together: see Particles and LocalRows.
int vtkGranularAverageAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port == 1 || port == 2 ? 1 : 0);
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularAverageAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "KernelWidth: " << this->KernelWidth << "\n";
  os << indent << "VelocityArray: " << TextOf(this->VelocityArray) << "\n";
  os << indent << "MassArray: " << TextOf(this->MassArray) << "\n";
  os << indent << "RadiusArray: " << TextOf(this->RadiusArray) << "\n";
  os << indent << "ArraySelection:\n";
  this->ArraySelection->PrintSelf(os, indent.GetNextIndent());
}
