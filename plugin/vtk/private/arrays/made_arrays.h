// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularMadeArrays_h
#define vtkGranularMadeArrays_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArraySelection.h"

#include <span>

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
}

#endif
