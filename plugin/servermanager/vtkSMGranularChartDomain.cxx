// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularChartDomain.h"

#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <regex>
#include <string>

namespace
{
bool Fits(vtkPVXMLElement* hint, const char* attribute, const std::string& name)
{
  const std::string expression = hint->GetAttributeOrEmpty(attribute);
  return !expression.empty() && std::regex_search(name, std::regex(expression));
}

// Sets a property of texts of series - name, text, name, ... - for the series that an expression of the hint fits.
void SetSeries(vtkSMProxy* display, const char* property, vtkPVXMLElement* hint, const char* which,
  const std::string& text)
{
  if (vtkSMProperty* series = display->GetProperty(property))
  {
    vtkSMPropertyHelper texts(series);
    for (unsigned int i = 0; i + 1 < texts.GetNumberOfElements(); i += 2)
    {
      if (Fits(hint, which, texts.GetAsString(i)))
      {
        texts.Set(i + 1, text.c_str());
      }
    }
  }
}

// Returns true if a series - of a name, or of any - has one of some states: "1", visible, or "0".
bool HasSeries(vtkSMProxy* display, const std::string& name, const std::string& states)
{
  const vtkSMPropertyHelper texts(display, "SeriesVisibility", true);
  bool found = false;
  for (unsigned int i = 0; i + 1 < texts.GetNumberOfElements(); i += 2)
  {
    found = found ||
      ((name.empty() || name == texts.GetAsString(i)) &&
        states.find(texts.GetAsString(i + 1)) != std::string::npos);
  }
  return found;
}
}

vtkStandardNewMacro(vtkSMGranularChartDomain);

int vtkSMGranularChartDomain::SetDefaultValues(vtkSMProperty* property, bool)
{
  vtkSMProxy* display = property->GetParent();
  vtkSMProperty* input = this->GetRequiredProperty("Input");
  vtkSMProxy* source = input ? vtkSMPropertyHelper(input).GetAsProxy(0) : nullptr;
  vtkPVXMLElement* hints = source ? source->GetHints() : nullptr;
  vtkPVXMLElement* hint = hints ? hints->FindNestedElementByName("Chart") : nullptr;
  if (display && hint)
  {
    for (const char* const name : { "SeriesVisibility", "SeriesLabel" })
    {
      if (vtkSMProperty* series = display->GetProperty(name))
      {
        series->ResetToDomainDefaults();
      }
    }
    const char* axis = hint->GetAttributeOrEmpty("x");
    if (!HasSeries(display, axis, "01"))
    {
      return 1; // as with other tables
    }
    vtkSMPropertyHelper(display, "UseIndexForXAxis", true).Set(0);
    vtkSMPropertyHelper(display, "XArrayName", true).Set(axis);
    SetSeries(display, "SeriesVisibility", hint, "hide", "0");
    SetSeries(display, "SeriesVisibility", hint, "show", "1");
    if (!HasSeries(display, {}, "1"))
    {
      SetSeries(display, "SeriesVisibility", hint, "otherwise", "1");
    }
    if (hint->GetAttribute("label"))
    {
      SetSeries(display, "SeriesLabel", hint, "show", hint->GetAttribute("label"));
    }
  }
  return 1;
}
