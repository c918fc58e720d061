// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPrint_h
#define vtkGranularPrint_h

#include "vtkIndent.h"
#include "vtkType.h"

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>

namespace vtkGranularPrivate
{
/**
 * Prints a property: several numbers one after the other, an object on lines of its own.
 */
template <class Value>
void PrintProperty(std::ostream& os, vtkIndent indent, std::string_view name, const Value& value)
{
  os << indent << name << ":";
  if constexpr (std::is_pointer_v<Value>)
  {
    os << "\n";
    value->PrintSelf(os, indent.GetNextIndent());
  }
  else if constexpr (std::ranges::range<Value> && !std::is_same_v<Value, std::string>)
  {
    for (const auto& each : value)
    {
      os << " " << each;
    }
    os << "\n";
  }
  else if constexpr (std::is_same_v<Value, bool>)
  {
    os << (value ? " On\n" : " Off\n");
  }
  else
  {
    os << " " << value << "\n";
  }
}

/**
 * Prints properties by their names in a list like "Radius, Speed".
 */
template <class... Values>
void PrintProperties(
  std::ostream& os, vtkIndent indent, std::string_view names, const Values&... values)
{
  const auto next = [&names]
  {
    const std::string_view name = names.substr(0, names.find(','));
    names.remove_prefix(std::min(name.size() + 2, names.size()));
    return name;
  };
  (PrintProperty(os, indent, next(), values), ...);
}
}

/**
 * Defines the method PrintSelf of a class, which prints these members after those of the superclass.
 */
#define vtkGranularPrintMacro(Class, ...)                                       \
  void Class::PrintSelf(ostream& os, vtkIndent indent)                          \
  {                                                                             \
    this->Superclass::PrintSelf(os, indent);                                    \
    vtkGranularPrivate::PrintProperties(os, indent, #__VA_ARGS__, __VA_ARGS__); \
  }

#endif
