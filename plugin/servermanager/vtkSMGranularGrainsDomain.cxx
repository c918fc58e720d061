// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularGrainsDomain.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace
{
bool AreOurs(vtkPVDataInformation* data)
{
  return (data->DataSetTypeIsA("vtkPolyData") || data->DataSetTypeIsA("vtkUnstructuredGrid")) &&
    data->GetArrayInformation("PointOrigin", vtkDataObject::FIELD) &&
    data->GetArrayInformation("Coordinates", vtkDataObject::FIELD);
}

// Filters that keep particles. Data without cells tell nothing: the first frame of most runs that insert particles is empty.
constexpr const char* ParticleFilters[] = { "Calculator", "Clip", "ExtractSelection", "ForceTime",
  "PassArrays", "PythonCalculator", "TemporalInterpolator", "TemporalShiftScale", "Threshold",
  "TransformFilter" };

bool KeepsParticles(vtkSMSourceProxy* source, unsigned int port)
{
  const std::string name = source->GetXMLName() ? source->GetXMLName() : "";
  const bool reader = source->IsA("vtkSMGranularParticleReaderProxy");
  return (reader && port == 0) ||
    std::ranges::find(ParticleFilters, name) != std::end(ParticleFilters);
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
    if (!data || (data->GetNumberOfPoints() > 0 && !AreOurs(data)))
    {
      return false;
    }
    const vtkTypeInt64 cells = data->GetNumberOfCells(); // a vertex of each point, or none
    if (cells > 0 ? cells != data->GetNumberOfPoints() : !KeepsParticles(source, port))
    {
      return false;
    }
    input = source->GetProperty("Input");
  }
  return true;
}
}

vtkStandardNewMacro(vtkSMGranularGrainsDomain);

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
