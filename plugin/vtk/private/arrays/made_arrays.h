// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularMadeArrays_h
#define vtkGranularMadeArrays_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArraySelection.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

namespace vtkGranularPrivate
{
/**
 * An array that an algorithm can make, and whether it does if nobody chooses.
 */
struct MadeArray
{
  const char* Name;
  bool On;
};

/**
 * Returns a new selection of arrays, whose changes modify the algorithm.
 */
inline vtkDataArraySelection* MakeSelection(vtkAlgorithm* self, std::span<const MadeArray> arrays)
{
  vtkDataArraySelection* selection = vtkDataArraySelection::New();
  for (const MadeArray& array : arrays)
  {
    selection->AddArray(array.Name, array.On);
  }
  selection->AddObserver(
    vtkCommand::ModifiedEvent, static_cast<vtkObject*>(self), &vtkObject::Modified);
  return selection;
}

/**
 * Returns a remark on the arrays of a selection that the algorithm does not make, though somebody turned them on; empty if there are none.
 */
inline std::string TellOfUnknown(
  vtkDataArraySelection* selection, std::span<const MadeArray> arrays)
{
  std::string unknown;
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
  {
    const std::string name = selection->GetArrayName(i);
    if (selection->GetArraySetting(i) != 0 &&
      std::ranges::find(arrays, name,
        [](const MadeArray& array) { return std::string_view(array.Name); }) == arrays.end())
    {
      unknown += " '" + name + "'";
    }
  }
  if (unknown.empty())
  {
    return unknown;
  }
  std::string known;
  for (const MadeArray& array : arrays)
  {
    known += std::string(known.empty() ? "" : ", ") + array.Name;
  }
  return "there is no array" + unknown + ": Arrays may name " + known;
}
}

#endif
