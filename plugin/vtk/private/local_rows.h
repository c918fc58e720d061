// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLocalRows_h
#define vtkGranularLocalRows_h

#include "array_views.h"

#include "granular/base/progress.h"

#include "vtkType.h"

#include <cstdint>
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
 * Rows that name particles at the ends of lines: of a table, or cells of lines. Each counts once: of the parts of a
 * line that was split, which have the same integer in the cell array `row`, the first. Duplicates of ghosts are left
 * out.
 */
class LocalRows
{
public:
  /**
   * The cell array, or column, that tells the parts of a line from others.
   */
  static constexpr const char* RowArray = "row";

  /**
   * Throws UnsupportedError if it is neither a vtkPolyData nor a vtkTable.
   */
  explicit LocalRows(vtkDataObject* input);

  vtkIdType Count() const { return static_cast<vtkIdType>(this->Tuples.size()); }

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
   * The ids of each row; the numbers of some. Throws Error if the array is not there, or has others; granular::Cancelled.
   */
  std::vector<std::int64_t> ReadIds(const char* name, granular::Progress& progress);
  std::vector<double> ReadNumbers(const char* name, const std::vector<std::int64_t>& rows);

  /**
   * All arrays, with the values of these rows, in any number and order.
   */
  void Pass(const std::vector<std::int64_t>& rows, vtkDataSetAttributes* to) const;

  vtkFieldData* GetFieldData() const { return this->Field; }

private:
  granular::ArrayView See(const char* name);
  void FindTuples(vtkIdType count);

  vtkDataSetAttributes* Data = nullptr;
  vtkFieldData* Field = nullptr;
  ArrayViews Arrays{ "rows" };
  std::vector<vtkIdType> Tuples; ///< of the arrays, one a row
  vtkIdType AllTuples = 0;
};
}

#endif
