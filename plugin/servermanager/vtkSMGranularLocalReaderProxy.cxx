// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularLocalReaderProxy.h"

#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"

#include <cstring>

vtkStandardNewMacro(vtkSMGranularLocalReaderProxy);

vtkPVXMLElement* vtkSMGranularLocalReaderProxy::GetHints()
{
  vtkPVXMLElement* hints = this->Superclass::GetHints();
  const vtkSMPropertyHelper there(this, "CellArrayInfo"); // name, "0" or "1", name, ...
  bool ends = there.GetNumberOfElements() == 0;
  for (unsigned int i = 0; i < there.GetNumberOfElements(); i += 2)
  {
    ends = ends || std::strcmp(there.GetAsString(i), "position1") == 0;
  }
  if (ends || !hints)
  {
    return hints;
  }
  this->RowsHints->RemoveAllNestedElements();
  for (unsigned int i = 0; i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* hint = hints->GetNestedElement(i);
    if (std::strcmp(hint->GetName(), "View") != 0)
    {
      this->RowsHints->AddNestedElement(hint, 0);
    }
  }
  return this->RowsHints;
}
