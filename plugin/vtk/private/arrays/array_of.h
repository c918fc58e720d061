// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularArrayOf_h
#define vtkGranularArrayOf_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>
#include <functional>
#include <ranges>

namespace vtkGranularPrivate
{
/**
 * Returns an array of single values: of each thing in a range, what the function says.
 */
template <class Array, class Range, class Value = std::identity>
vtkSmartPointer<Array> ArrayOf(const char* name, const Range& things, const Value& value = {})
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(std::ranges::size(things)));
  std::ranges::transform(things, array->GetPointer(0), value);
  return array;
}
}

#endif
