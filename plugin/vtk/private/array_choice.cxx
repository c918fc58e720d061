// SPDX-License-Identifier: BSD-3-Clause
#include "array_choice.h"

#include "vtkDataArraySelection.h"

#include <algorithm>

namespace vtkGranularPrivate
{
ArrayChoice::ArrayChoice() = default;
ArrayChoice::~ArrayChoice() = default;

void ArrayChoice::Begin(bool follow)
{
  this->Follow = follow;
  this->Chosen = !this->AreAllOn();
  this->Names.clear();
}

void ArrayChoice::Add(const std::string& name, bool on)
{
  if (this->Names.emplace(name, on).second)
  {
    const auto before = this->Gone.find(name);
    const bool isOn = on && !(this->Follow && this->Chosen);
    this->Selection->AddArray(name.c_str(), before == this->Gone.end() ? isOn : before->second);
  }
}

void ArrayChoice::End()
{
  for (int i = this->Selection->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    const std::string name = this->Selection->GetArrayName(i);
    if (this->Names.count(name) == 0)
    {
      this->Gone.erase(name);
      if (this->Chosen)
      {
        this->Gone[name] = this->Selection->GetArraySetting(i) != 0;
      }
      this->Selection->RemoveArrayByIndex(i);
    }
  }
}

bool ArrayChoice::AreAllOn() const
{
  return std::all_of(this->Names.begin(), this->Names.end(),
    [this](const auto& name)
    { return !name.second || this->Selection->ArrayIsEnabled(name.first.c_str()) != 0; });
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

void ArrayChoice::CheckNames(
  const std::string& path, granular::Notices& notices, const std::vector<std::string>& others) const
{
  for (const std::string& name : this->GetWanted())
  {
    if (this->Names.count(name) == 0 &&
      std::find(others.begin(), others.end(), name) == others.end())
    {
      granular::Notice notice;
      notice.where.path = path;
      notice.text = "no frame has the array '" + name + "' asked for";
      notices.push_back(notice);
    }
  }
}
}
