// SPDX-License-Identifier: BSD-3-Clause
#include "array_choice.h"

#include "vtkDataArraySelection.h"

namespace vtkGranularPrivate
{
ArrayChoice::ArrayChoice() = default;
ArrayChoice::~ArrayChoice() = default;

void ArrayChoice::Add(const std::string& name, bool on)
{
  if (this->Names.insert(name).second)
  {
    this->Selection->AddArray(name.c_str(), on);
  }
}

void ArrayChoice::End()
{
  for (int i = this->Selection->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (this->Names.count(this->Selection->GetArrayName(i)) == 0)
    {
      this->Selection->RemoveArrayByIndex(i);
    }
  }
}

std::set<std::string> ArrayChoice::GetWanted() const
{
  std::set<std::string> names;
  for (int i = 0; i < this->Selection->GetNumberOfArrays(); ++i)
  {
    if (this->Selection->GetArraySetting(i) != 0)
    {
      names.insert(this->Selection->GetArrayName(i));
    }
  }
  return names;
}

void ArrayChoice::CheckNames(const std::string& path, granular::Notices& notices) const
{
  for (const std::string& name : this->GetWanted())
  {
    if (this->Names.count(name) == 0)
    {
      granular::Notice notice;
      notice.where.path = path;
      notice.text = "no frame has the array '" + name + "' asked for";
      notices.push_back(notice);
    }
  }
}
}
