// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularChangedRows_h
#define vtkGranularChangedRows_h

#include "granular/parallel/communicator.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataSetAttributes;
class vtkIdList;

namespace vtkGranularPrivate
{
/**
 * The name and kind of an array.
 */
struct ArrayForm
{
  std::string Name;
  int Type = 0;
  int Components = 1;
};

/**
 * Rows of the current frame, and behind them the lost ones of a reference frame.
 */
class ChangedRows
{
public:
  /**
   * rows, lost: the tuples of the current and the reference frame.
   */
  ChangedRows(const std::vector<std::int64_t>& rows, const std::vector<std::int64_t>& lost);

  vtkIdType Count() const;

  /**
   * Returns an array with the values of both; `current` itself if it has exactly these. Rows without a value, because an
   * array is null or of another kind, get nan, 0 or an empty text.
   */
  vtkSmartPointer<vtkAbstractArray> Combine(
    const ArrayForm& form, vtkAbstractArray* current, vtkAbstractArray* reference) const;

  /**
   * Adds the arrays that the current rows of all ranks have: those of the first rank with current rows; if none has any, of
   * the first one with rows of the reference frame. Ghosts are left out. The current attributes, such as pedigree ids, remain
   * what they are. Collective.
   */
  void Pass(vtkDataSetAttributes* current, vtkDataSetAttributes* reference,
    granular::Communicator& ranks, vtkDataSetAttributes* output) const;

private:
  vtkNew<vtkIdList> Rows;
  vtkNew<vtkIdList> Lost;
};
}

#endif
