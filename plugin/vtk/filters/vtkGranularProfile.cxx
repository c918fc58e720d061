// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularProfile.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkGranularProfile);

//------------------------------------------------------------------------------
vtkGranularProfile::vtkGranularProfile()
{
  this->SetOutputType(PROFILE);
  this->SetLayers(20);
}

//------------------------------------------------------------------------------
void vtkGranularProfile::SetLayers(int layers)
{
  this->SetCellCounts(layers, layers, layers);
}

//------------------------------------------------------------------------------
void vtkGranularProfile::SetThickness(double thickness)
{
  this->SetCellsBy(thickness == 0 ? COUNTS : SIZE);
  if (thickness != 0)
  {
    this->SetCellSize(thickness, thickness, thickness);
  }
}
