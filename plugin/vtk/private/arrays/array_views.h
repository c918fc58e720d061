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
 * Arrays of VTK as the core sees them, where they are. Those whose memory is not laid out as VTK's own are copied, and
 * kept until this is gone.
 */
class ArrayViews
{
public:
  /**
   * What arrays have a value for each of: "points". It is named in errors.
   */
  explicit ArrayViews(const char* owners)
    : Owners(owners)
  {
  }

  /**
   * Nothing for an array of a type that the core does not have, of variants for one. Throws what CheckTuples does.
   */
  std::optional<granular::ArrayView> See(
    vtkAbstractArray* array, const char* name, vtkIdType tuples);

  /**
   * Throws Error where an array has not so many tuples.
   */
  void CheckTuples(vtkAbstractArray* array, const char* name, vtkIdType tuples) const;

private:
  const char* Owners;
  std::vector<vtkSmartPointer<vtkAbstractArray>> Copies;
};
}

#endif
