// SPDX-License-Identifier: BSD-3-Clause
#include "private/arrays/array_choice.h"

#include "vtkDataArraySelection.h"

#include <algorithm>
#include <utility>

namespace vtkGranularPrivate
{
ArrayChoice::ArrayChoice() = default;
ArrayChoice::~ArrayChoice() = default;

// VTK looks at all names for each that is added by itself. The list is made anew: those that differ from most are known to it before,
// and keep their state, the others take that of most. Nobody is told, as AddArray tells nobody. State files, and users who name the
// columns of a binary file, choose from names that are not offered yet, and leave the old ones off: new ones that were not chosen are off.
void ArrayChoice::Offer(const std::vector<granular::OfferedArray>& arrays)
{
  const bool chosen = !this->AreAllOn();
  decltype(this->Names)
    offered; // known when all is done: what fails for want of memory is done again
  for (const granular::OfferedArray& array : arrays)
  {
    offered.emplace(array.name, array.is_usual);
  }
  std::map<std::string, bool, std::less<>> states = this->GetStates();
  bool isChosenAhead = false;
  bool isOffElsewhere = false;
  for (const auto& [name, isOn] : states)
  {
    const bool isOffered = offered.count(name) != 0;
    isChosenAhead |= isOn && isOffered && this->Names.count(name) == 0;
    isOffElsewhere |= !isOn && !isOffered;
  }
  const bool chosenByName = (this->Follow && chosen) || (isChosenAhead && isOffElsewhere);
  std::vector<std::string> kept;
  for (int i = 0; i < this->Selection->GetNumberOfArrays(); ++i)
  {
    const std::string name = this->Selection->GetArrayName(i);
    if (offered.count(name) != 0)
    {
      kept.push_back(name);
      continue;
    }
    this->Gone.erase(name);
    if (chosen)
    {
      this->Gone[name] = states[name];
    }
  }
  for (const granular::OfferedArray& array : arrays)
  {
    const std::string& name = array.name;
    const auto before = this->Gone.find(name);
    const bool isOn = array.is_usual && !chosenByName;
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
  this->Names.swap(offered);
}

std::map<std::string, bool, std::less<>> ArrayChoice::GetStates() const
{
  std::map<std::string, bool, std::less<>> states;
  for (int i = 0; i < this->Selection->GetNumberOfArrays(); ++i)
  {
    states.emplace(this->Selection->GetArrayName(i), this->Selection->GetArraySetting(i) != 0);
  }
  return states;
}

bool ArrayChoice::AreAllOn() const
{
  const auto wanted = this->GetWanted();
  return std::ranges::all_of(
    this->Names, [&](const auto& name) { return !name.second || wanted.contains(name.first); });
}

std::set<std::string, std::less<>> ArrayChoice::GetWanted() const
{
  std::set<std::string, std::less<>> names;
  for (const auto& [name, on] : this->GetStates())
  {
    if (on)
    {
      names.insert(name);
    }
  }
  return names;
}

granular::Request::Choice ArrayChoice::MakeFilter() const
{
  return [states = this->GetStates(), all = this->AreAllOn()](std::string_view name, bool isUsual)
  {
    const auto state = states.find(name);
    return state == states.end() ? all && isUsual : state->second;
  };
}

void ArrayChoice::CheckNames(
  const std::string& path, granular::Notices& notices, const granular::ColumnSchema& present) const
{
  for (const std::string& name : this->GetWanted())
  {
    if (this->Names.count(name) == 0 && present.find_array(name) < 0)
    {
      notices.push_back({ { path }, "no frame has the array '" + name + "' asked for" });
    }
  }
}
}
