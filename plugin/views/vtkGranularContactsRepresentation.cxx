// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularContactsRepresentation.h"

#include "vtkDataObject.h"
#include "vtkGranularEmptyFrame.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVView.h"

vtkStandardNewMacro(vtkGranularContactsRepresentation);

int vtkGranularContactsRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    vtkDataObject* data =
      this->GetNumberOfInputConnections(0) > 0 ? this->GetInputDataObject(0, 0) : nullptr;
    if (vtkGranularEmptyFrame::CountOnRanks(data) == 0)
    {
      vtkGranularEmptyFrame::SetBounds(inInfo, this, data, 0, this->Actor, this->VisibleDataBounds);
    }
  }
  return 1;
}
