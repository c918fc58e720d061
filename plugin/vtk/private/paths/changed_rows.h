// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularChangedRows_h
#define vtkGranularChangedRows_h

#include "granular/parallel/communicator.h"
#include "granular/paths/change.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
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
 * Returns the arrays that the current rows of all ranks have: those of the first rank with current rows; if none has any, of
 * the first one with rows of the reference frame. Ghosts are left out. Collective.
 */
std::vector<ArrayForm> ShareForms(vtkDataSetAttributes* current, vtkIdType currentRows,
  vtkDataSetAttributes* reference, vtkIdType referenceRows, granular::Communicator& ranks);

/**
 * Rows of the current frame, and behind them the lost ones of a reference frame.
 */
class ChangedRows
{
public:
  /**
   * rows, lost: the tuples of the current and the reference frame. allRows: the number of tuples of the current frame.
   */
  ChangedRows(
    const std::vector<vtkIdType>& rows, vtkIdType allRows, const std::vector<vtkIdType>& lost);

  vtkIdType Count() const;

  /**
   * Returns an array with the values of both; `current` itself if it has exactly these. Rows without a value, because an
   * array is null or of another kind, get nan, 0 or an empty text.
   */
  vtkSmartPointer<vtkAbstractArray> Combine(
    const ArrayForm& form, vtkAbstractArray* current, vtkAbstractArray* reference) const;

  /**
   * Adds arrays of these forms. The current attributes, such as pedigree ids, remain what they are.
   */
  void Pass(const std::vector<ArrayForm>& forms, vtkDataSetAttributes* current,
    vtkDataSetAttributes* reference, vtkDataSetAttributes* output) const;

private:
  vtkNew<vtkIdList> Rows;
  vtkNew<vtkIdList> Lost;
  bool AreAll; ///< current rows, and no others
};

/**
 * Returns the array `change` of rows, by those of all rows, and of as many lost ones behind them.
 */
vtkSmartPointer<vtkAbstractArray> MakeChanges(const std::vector<granular::Change>& changes,
  const std::vector<vtkIdType>& rows, std::size_t lost);
}

#endif
