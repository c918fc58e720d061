// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularGrainsDomain.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <algorithm>
#include <initializer_list>

namespace
{
bool HasAny(vtkPVDataInformation* data, int association, std::initializer_list<const char*> names)
{
  return std::any_of(names.begin(), names.end(),
    [=](const char* name) { return data->GetArrayInformation(name, association) != nullptr; });
}

bool AreParticles(vtkPVDataInformation* data)
{
  return data &&
    (data->DataSetTypeIsA("vtkPolyData") || data->DataSetTypeIsA("vtkUnstructuredGrid")) &&
    data->GetNumberOfPoints() > 0 &&
    (data->GetNumberOfCells() == 0 || data->GetNumberOfCells() == data->GetNumberOfPoints()) &&
    HasAny(data, vtkDataObject::FIELD, { "PointOrigin" }) &&
    HasAny(data, vtkDataObject::FIELD, { "Coordinates" }) &&
    HasAny(data, vtkDataObject::POINT, { "radius", "shape" });
}
}

vtkStandardNewMacro(vtkSMGranularGrainsDomain);

vtkSMGranularGrainsDomain::vtkSMGranularGrainsDomain() = default;
vtkSMGranularGrainsDomain::~vtkSMGranularGrainsDomain() = default;

void vtkSMGranularGrainsDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

int vtkSMGranularGrainsDomain::SetDefaultValues(vtkSMProperty* property, bool)
{
  vtkSMProxy* display = property->GetParent();
  if (display && display->GetProperty("Representation") &&
    AreParticles(this->GetInputDataInformation("Input")))
  {
    vtkSMPropertyHelper(display, "Representation").Set("Grains");
  }
  return 1;
}
