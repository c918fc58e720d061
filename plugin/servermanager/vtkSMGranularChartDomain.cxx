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

// Sets a property of texts of series - name, text, name, ... - to its defaults, but for series that one of the expressions of the hint fits.
void SetSeries(vtkSMProxy* display, const char* property, vtkPVXMLElement* hint,
  const std::string& shown, const char* hidden)
{
  if (vtkSMProperty* series = display->GetProperty(property))
  {
    series->ResetToDomainDefaults();
    vtkSMPropertyHelper texts(series);
    for (unsigned int i = 0; i + 1 < texts.GetNumberOfElements(); i += 2)
    {
      const std::string name = texts.GetAsString(i);
      if (Fits(hint, "show", name))
      {
        texts.Set(i + 1, shown.empty() ? name.c_str() : shown.c_str());
      }
      else if (hidden && Fits(hint, "hide", name))
      {
        texts.Set(i + 1, hidden);
      }
    }
  }
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
    vtkSMPropertyHelper(display, "UseIndexForXAxis", true).Set(0);
    vtkSMPropertyHelper(display, "XArrayName", true).Set(hint->GetAttributeOrEmpty("x"));
    SetSeries(display, "SeriesVisibility", hint, "1", "0");
    SetSeries(display, "SeriesLabel", hint, hint->GetAttributeOrEmpty("label"), nullptr);
  }
  return 1;
}
