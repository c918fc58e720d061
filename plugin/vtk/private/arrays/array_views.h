// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularArrayViews_h
#define vtkGranularArrayViews_h

#include "granular/particles/frame_view.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <optional>
#include <vector>

class vtkAbstractArray;

namespace vtkGranularPrivate
{
/**
 * Views of VTK arrays for the core, in place. Arrays with another memory layout than VTK's own are copied; the copies
 * live as long as this object.
 */
class ArrayViews
{
public:
  /**
   * The things that arrays have a value for each of, such as "points", for errors.
   */
  explicit ArrayViews(const char* owners)
    : Owners(owners)
  {
  }

  /**
   * Returns a view of an array; nothing for a type that the core does not have, such as variants. Throws what
   * CheckTuples throws.
   */
  std::optional<granular::ArrayView> See(
    vtkAbstractArray* array, const char* name, vtkIdType tuples);

  /**
   * Throws Error if an array has another number of tuples.
   */
  void CheckTuples(vtkAbstractArray* array, const char* name, vtkIdType tuples) const;

private:
  const char* Owners;
  std::vector<vtkSmartPointer<vtkAbstractArray>> Copies;
};
}

#endif
