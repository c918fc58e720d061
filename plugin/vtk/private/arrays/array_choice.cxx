// SPDX-License-Identifier: BSD-3-Clause
#include "private/arrays/array_choice.h"

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
  this->Next.clear(); // without End, all stays as it was
  this->Order.clear();
}

void ArrayChoice::Add(const std::string& name, bool on)
{
  if (this->Next.emplace(name, on).second)
  {
    this->Order.push_back(name);
  }
}

// VTK looks at all names for each that is added by itself. The list is made anew: those that differ from most are known to it before,
// and keep their state, the others take that of most. Nobody is told, as AddArray tells nobody.
void ArrayChoice::End()
{
  std::map<std::string, bool> states = this->GetStates();
  std::vector<std::string> kept;
  for (int i = 0; i < this->Selection->GetNumberOfArrays(); ++i)
  {
    const std::string name = this->Selection->GetArrayName(i);
    if (this->Next.count(name) != 0)
    {
      kept.push_back(name);
      continue;
    }
    this->Gone.erase(name);
    if (this->Chosen)
    {
      this->Gone[name] = states[name];
    }
  }
  for (const std::string& name : this->Order)
  {
    const auto before = this->Gone.find(name);
    const bool isOn = this->Next[name] && !(this->Follow && this->Chosen);
    if (states.emplace(name, before == this->Gone.end() ? isOn : before->second).second)
    {
      kept.push_back(name);
    }
  }
  std::vector<const char*> each[2]; // off, and on
  std::vector<const char*> all;
  for (const std::string& name : kept)
  {
    each[states[name] ? 1 : 0].push_back(name.c_str());
    all.push_back(name.c_str());
  }
  const int most = each[1].size() >= each[0].size() ? 1 : 0;
  const auto set = [this](const std::vector<const char*>& names, int state)
  { this->Selection->SetArraysWithDefault(names.data(), static_cast<int>(names.size()), state); };
  set({}, most);
  set(each[1 - most], 1 - most);
  set(all, most);
  this->Names.swap(this->Next);
}

std::map<std::string, bool> ArrayChoice::GetStates() const
{
  std::map<std::string, bool> states;
  for (int i = 0; i < this->Selection->GetNumberOfArrays(); ++i)
  {
    states.emplace(this->Selection->GetArrayName(i), this->Selection->GetArraySetting(i) != 0);
  }
  return states;
}

bool ArrayChoice::AreAllOn() const
{
  const std::map<std::string, bool> states = this->GetStates();
  return std::all_of(this->Names.begin(), this->Names.end(),
    [&](const auto& name)
    {
      const auto state = states.find(name.first);
      return !name.second || (state != states.end() && state->second);
    });
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
