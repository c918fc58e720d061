// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularGrainsDomain.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
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

std::string NameOf(vtkSMProxy* proxy)
{
  return proxy->GetXMLName() ? proxy->GetXMLName() : "";
}

// Returns the representation that the hints of one of our own sources name for an output; only images have a volume.
std::string FindHint(vtkSMSourceProxy* source, int port)
{
  vtkPVXMLElement* hints = NameOf(source).starts_with("Granular") ? source->GetHints() : nullptr;
  for (unsigned int i = 0; hints && i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* hint = hints->GetNestedElement(i);
    int of = port;
    hint->GetScalarAttribute("port", &of);
    if (of == port && std::string(hint->GetName()) == "RepresentationType")
    {
      const std::string type = hint->GetAttributeOrEmpty("type");
      const bool image = source->GetDataInformation(port)->DataSetTypeIsA("vtkImageData");
      return type == "Volume" && !image ? "Surface" : type;
    }
  }
  return {};
}

// ParaView hides the input of Clip when its result is first shown in the window, but only an input that is a surface: particles would
// stay over the part of them that is left. The hints belong to all filters of this name, so that other displays set them back.
void HideInput(vtkSMProxy* filter, bool ofParticles)
{
  vtkPVXMLElement* hints = filter->GetHints();
  vtkPVXMLElement* hint = hints ? hints->FindNestedElementByName("Visibility") : nullptr;
  const std::string mode = hint ? hint->GetAttributeOrEmpty("replace_input") : "";
  if (ofParticles && mode == "2")
  {
    hint->SetAttribute("replace_input", "1");
    hint->SetAttribute("replace_surfaces", "2");
  }
  else if (!ofParticles && hint && hint->GetAttribute("replace_surfaces"))
  {
    hint->SetAttribute("replace_input", "2");
    hint->RemoveAttribute("replace_surfaces");
  }
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
    const std::string hint = data ? FindHint(source, static_cast<int>(port)) : "";
    if (!data || (!hint.empty() && hint != "Grains") ||
      (data->GetNumberOfPoints() > 0 && !AreOurs(data)))
    {
      return false;
    }
    const vtkTypeInt64 cells = data->GetNumberOfCells(); // a vertex of each point, or none
    const bool keeps = hint == "Grains" ||
      std::ranges::find(ParticleFilters, NameOf(source)) != std::end(ParticleFilters);
    if (cells > 0 ? cells != data->GetNumberOfPoints() : !keeps)
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
  vtkSMProperty* input = this->GetRequiredProperty("Input");
  auto* const shown =
    input ? vtkSMSourceProxy::SafeDownCast(vtkSMPropertyHelper(input).GetAsProxy(0)) : nullptr;
  if (display && shown && display->GetProperty("Representation"))
  {
    const bool particles = IsParticlesFromTheReaderOn(input);
    const std::string form =
      particles ? "Grains" : FindHint(shown, vtkSMPropertyHelper(input).GetOutputPort(0));
    if (!form.empty())
    {
      vtkSMPropertyHelper(display, "Representation").Set(form.c_str());
    }
    HideInput(shown, particles);
  }
  return 1;
}
