// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularParticleReaderProxy.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <set>
#include <string>

vtkStandardNewMacro(vtkSMGranularParticleReaderProxy);

void vtkSMGranularParticleReaderProxy::UpdatePipelineInformation()
{
  this->Superclass::UpdatePipelineInformation();
  vtkSMPropertyHelper chosen(this, "PointArrayStatus"); // name, "0" or "1", name, ...
  vtkSMPropertyHelper there(this, "PointArrayInfo");
  std::set<std::string> names;
  for (unsigned int i = 0; i + 1 < there.GetNumberOfElements(); i += 2)
  {
    names.insert(there.GetAsString(i));
  }
  bool gone = chosen.GetNumberOfElements() > 0 && !names.empty();
  for (unsigned int i = 0; gone && i + 1 < chosen.GetNumberOfElements(); i += 2)
  {
    gone = names.count(chosen.GetAsString(i)) == 0;
  }
  if (gone)
  {
    this->GetProperty("PointArrayStatus")->Copy(this->GetProperty("PointArrayInfo"));
    this->UpdateVTKObjects();
  }
}

void vtkSMGranularParticleReaderProxy::PostUpdateData(bool usingCache)
{
  this->Superclass::PostUpdateData(usingCache);
  if (vtkSMProperty* arrays = this->GetProperty("PointArrayInfo"))
  {
    this->UpdatePropertyInformation(arrays);
  }
}
