// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMGranularParticleReaderProxy.h"

#include "vtkGranularDumpReader.h"
#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <set>
#include <string>

vtkStandardNewMacro(vtkSMGranularParticleReaderProxy);

vtkSMGranularParticleReaderProxy::vtkSMGranularParticleReaderProxy() = default;

vtkSMGranularParticleReaderProxy::~vtkSMGranularParticleReaderProxy() = default;

void vtkSMGranularParticleReaderProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HasRadii: " << this->HasRadii() << "\n";
}

bool vtkSMGranularParticleReaderProxy::HasRadii()
{
  const bool quiet = true; // a prototype has no values
  if (vtkSMPropertyHelper(this, "Coordinates", quiet).GetAsInt() == vtkGranularDumpReader::SCALED)
  {
    return false;
  }
  vtkSMPropertyHelper arrays(this, "PointArrayInfo", quiet); // name, "0" or "1", name, ...
  for (unsigned int i = 0; i + 1 < arrays.GetNumberOfElements(); i += 2)
  {
    if (std::string("radius") == arrays.GetAsString(i))
    {
      return arrays.GetAsInt(i + 1) != 0;
    }
  }
  return false;
}

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

vtkPVXMLElement* vtkSMGranularParticleReaderProxy::GetHints()
{
  vtkPVXMLElement* hints = this->Superclass::GetHints();
  if (!hints || this->HasRadii())
  {
    return hints;
  }
  if (!this->HintsWithoutGrains)
  {
    this->HintsWithoutGrains = vtkSmartPointer<vtkPVXMLElement>::New();
    this->HintsWithoutGrains->SetName(hints->GetName());
    for (unsigned int i = 0; i < hints->GetNumberOfNestedElements(); ++i)
    {
      vtkPVXMLElement* hint = hints->GetNestedElement(i);
      if (std::string("Grains") != hint->GetAttributeOrEmpty("type"))
      {
        this->HintsWithoutGrains->AddNestedElement(hint, 0);
      }
    }
  }
  return this->HintsWithoutGrains;
}
