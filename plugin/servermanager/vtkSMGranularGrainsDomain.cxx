// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularGrainsDomain.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string>

namespace
{
bool HasAny(vtkPVDataInformation* data, int association, std::initializer_list<const char*> names)
{
  return std::any_of(names.begin(), names.end(),
    [=](const char* name) { return data->GetArrayInformation(name, association) != nullptr; });
}

bool AreParticles(vtkPVDataInformation* data)
{
  return (data->DataSetTypeIsA("vtkPolyData") || data->DataSetTypeIsA("vtkUnstructuredGrid")) &&
    (data->GetNumberOfCells() == 0 || data->GetNumberOfCells() == data->GetNumberOfPoints()) &&
    HasAny(data, vtkDataObject::FIELD, { "PointOrigin" }) &&
    HasAny(data, vtkDataObject::FIELD, { "Coordinates" }) &&
    HasAny(data, vtkDataObject::POINT, { "radius", "shape" });
}

// Filters that make particles of particles, whatever there is: the first frame of most runs that insert particles is empty.
constexpr const char* ParticleFilters[] = { "Calculator", "Clip", "ExtractSelection", "Threshold" };

bool KeepsParticles(vtkSMSourceProxy* source, unsigned int port)
{
  const std::string name = source->GetXMLName() ? source->GetXMLName() : "";
  const bool reader = source->IsA("vtkSMGranularParticleReaderProxy");
  return (reader && port == 0) ||
    std::find(std::begin(ParticleFilters), std::end(ParticleFilters), name) !=
    std::end(ParticleFilters);
}

// Returns true if the input of a property is particles, and so are the data that it was made of: circles that a plane cuts out of
// glyphs have as many lines as points, too.
bool IsParticlesFromTheReaderOn(vtkSMProperty* input)
{
  while (input && vtkSMPropertyHelper(input).GetNumberOfElements() > 0)
  {
    const vtkSMUncheckedPropertyHelper helper(input);
    auto* source = vtkSMSourceProxy::SafeDownCast(helper.GetAsProxy(0));
    const unsigned int port = helper.GetOutputPort(0);
    vtkPVDataInformation* data = source ? source->GetDataInformation(port) : nullptr;
    if (!data ||
      !(data->GetNumberOfPoints() > 0 ? AreParticles(data) : KeepsParticles(source, port)))
    {
      return false;
    }
    input = source->GetProperty("Input");
  }
  return true;
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
    IsParticlesFromTheReaderOn(this->GetRequiredProperty("Input")))
  {
    vtkSMPropertyHelper(display, "Representation").Set("Grains");
  }
  return 1;
}
