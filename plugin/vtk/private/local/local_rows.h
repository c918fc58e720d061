// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLocalRows_h
#define vtkGranularLocalRows_h

#include "private/arrays/array_views.h"

#include "granular/common/progress.h"

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkDataSetAttributes;
class vtkFieldData;

namespace vtkGranularPrivate
{
/**
 * Rows that name particles at the ends of lines: of a table, or cells of lines. Each counts once: where there are integers
 * `part`, as AddParts makes them, those with another one than 0 are left out, and so are duplicates of ghosts.
 */
class LocalRows
{
public:
  /**
   * Throws UnsupportedError if it is neither a vtkDataSet nor a vtkTable.
   */
  explicit LocalRows(vtkDataObject* input);

  vtkIdType Count() const { return this->AreAll ? this->AllTuples : std::ssize(this->Tuples); }

  /**
   * The cells, or tuples of the table, at which each row begins, and at which it ends. Throws Error where the parts of a
   * line do not follow each other.
   */
  std::vector<vtkIdType> FindBegins() const;
  std::vector<vtkIdType> FindEnds() const;

  /**
   * Those of so many from the first: [first, last).
   */
  void Keep(std::pair<vtkTypeInt64, vtkTypeInt64> range);

  bool Has(const char* name) const;

  /**
   * Whether an array has one number a row.
   */
  bool HasNumbers(const char* name) const;

  /**
   * Whether there are parts of lines that were split.
   */
  bool HasParts() const;

  /**
   * The ids of each row; so many numbers, of the rows that are listed, or where no list is, of the first ones. Throws Error if the
   * array is not there, or has others; granular::Cancelled.
   */
  std::vector<std::int64_t> ReadIds(const char* name, granular::Progress& progress);
  std::vector<double> ReadNumbers(
    const char* name, const std::vector<std::int64_t>& rows, vtkIdType count);

  /**
   * All arrays, with the values of as many rows, in any order.
   */
  void Pass(const std::vector<std::int64_t>& rows, vtkIdType count, vtkDataSetAttributes* to) const;

  vtkFieldData* GetFieldData() const { return this->Field; }

private:
  granular::ArrayView See(const char* name);
  void FindTuples();

  vtkIdType TupleOf(std::int64_t row) const
  {
    return this->AreAll ? row : this->Tuples[static_cast<std::size_t>(row)];
  }

  vtkDataSetAttributes* Data = nullptr;
  bool MayBeSplit = false; ///< they are lines
  vtkFieldData* Field = nullptr;
  ArrayViews Arrays{ "rows" };
  vtkIdType AllTuples = 0;
  bool AreAll = true;            ///< each is a row
  std::vector<vtkIdType> Tuples; ///< of the rows, where not all are
};
}

#endif
