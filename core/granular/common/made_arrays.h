// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_made_arrays_h
#define granular_common_made_arrays_h

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace granular
{
/// An array that a filter can make, and whether it does if nobody chooses.
struct MadeArray
{
  const char* name;
  bool on;
};

/// The arrays that a user chose from those that a filter can make.
class ArrayChoice
{
public:
  ArrayChoice(std::span<const MadeArray> known, std::vector<std::string> on)
    : known_(known)
    , on_(std::move(on))
  {
  }

  bool is_on(std::string_view name) const { return std::ranges::count(on_, name) != 0; }

  /// Returns what to tell of names that the filter does not know; nothing if there are none.
  std::string unknown() const
  {
    std::string unknown;
    for (const std::string& name : on_)
    {
      if (std::ranges::count(known_, name, &MadeArray::name) == 0)
      {
        unknown += " '" + name + "'";
      }
    }
    std::string known;
    for (const MadeArray& array : known_)
    {
      known += std::string(known.empty() ? "" : ", ") + array.name;
    }
    return unknown.empty() ? unknown : "there is no array" + unknown + ": Arrays may name " + known;
  }

private:
  std::span<const MadeArray> known_;
  std::vector<std::string> on_;
};
}
#endif
