// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularMadeArrays_h
#define vtkGranularMadeArrays_h

#include "granular/common/made_arrays.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArraySelection.h"

#include <span>
#include <string>
#include <vector>

namespace vtkGranularPrivate
{
/**
 * Returns a new selection of arrays, whose changes modify the algorithm.
 */
inline vtkDataArraySelection* MakeSelection(
  vtkAlgorithm* self, std::span<const granular::MadeArray> arrays)
{
  vtkDataArraySelection* selection = vtkDataArraySelection::New();
  for (const granular::MadeArray& array : arrays)
  {
    selection->AddArray(array.name, array.on);
  }
  selection->AddObserver(
    vtkCommand::ModifiedEvent, static_cast<vtkObject*>(self), &vtkObject::Modified);
  return selection;
}

/**
 * Returns the arrays that are on.
 */
inline granular::ArrayChoice ChoiceOf(
  vtkDataArraySelection* selection, std::span<const granular::MadeArray> known)
{
  std::vector<std::string> on;
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
  {
    if (selection->GetArraySetting(i) != 0)
    {
      on.emplace_back(selection->GetArrayName(i));
    }
  }
  return { known, on };
}
}

#endif
