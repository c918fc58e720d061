// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularMenuProxy.h"

#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"

vtkStandardNewMacro(vtkSMGranularMenuProxy);

void vtkSMGranularMenuProxy::SetPrototype(bool isPrototype)
{
  this->Superclass::SetPrototype(isPrototype);
  vtkPVXMLElement* hints = this->GetHints();
  vtkPVXMLElement* menu = hints ? hints->FindNestedElementByName("ShowInMenu") : nullptr;
  if (isPrototype && menu && menu->GetAttribute("text"))
  {
    this->SetXMLLabel(menu->GetAttribute("text"));
  }
}
