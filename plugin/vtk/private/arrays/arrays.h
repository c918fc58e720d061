// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularArrays_h
#define vtkGranularArrays_h

#include "granular/columns/column.h"
#include "granular/common/error.h"
#include "granular/formats/dump/read/dump_reader.h"
#include "granular/memory/block.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <ranges>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkCellArray;
class vtkDoubleArray;
class vtkFieldData;
class vtkIdList;
class vtkPoints;

namespace vtkGranularPrivate
{
/**
 * Returns an array that takes over the memory of a decoded one without a copy: Int32 becomes vtkTypeInt32Array, Int64
 * vtkTypeInt64Array (never vtkIdTypeArray), Float64 vtkDoubleArray, Text vtkStringArray. The columns name components
 * that have no axis: c_ID[1] and so on.
 */
vtkSmartPointer<vtkAbstractArray> TakeArray(
  granular::TableArray& array, vtkIdType rows, const std::vector<granular::ColumnInfo>& columns);

/**
 * Adds such an array, whose name must be unique. VTK compares the name of an added array with all others, which takes
 * long for many arrays; therefore the array gets its name afterwards.
 */
void AddTaken(vtkFieldData* data, granular::TableArray& array, vtkIdType rows,
  const std::vector<granular::ColumnInfo>& columns);

/**
 * Adds an existing array that has no ranges set: renaming would discard them.
 */
void AddNew(vtkFieldData* data, vtkAbstractArray* array);

/**
 * Returns points that take over the memory of rows x 3 doubles or floats.
 */
vtkSmartPointer<vtkPoints> TakePoints(
  granular::Block& block, vtkIdType rows, bool single, const granular::ValueRange& range);

/**
 * Returns arrays for field data: one tuple, or one value for a string.
 */
vtkSmartPointer<vtkAbstractArray> MakeDoubles(const char* name, const std::vector<double>& values);
vtkSmartPointer<vtkAbstractArray> MakeStrings(
  const char* name, const std::vector<std::string>& values);

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

/**
 * Returns an array that takes over the memory of tuples x components doubles.
 */
vtkSmartPointer<vtkDoubleArray> TakeDoubles(
  const char* name, granular::Block& block, vtkIdType tuples, int components);

/**
 * Returns the listed tuples of an array as an array of the same kind.
 */
vtkSmartPointer<vtkAbstractArray> TakeTuples(vtkAbstractArray* array, vtkIdList* tuples);

/**
 * Returns cells with this many consecutive points each; with 32-bit indices where they suffice. Zero points mean no
 * cells.
 */
vtkSmartPointer<vtkCellArray> MakeCells(
  vtkIdType cells, vtkIdType size, const std::shared_ptr<granular::BlockPool>& pool = nullptr);

/**
 * Returns cells of equal size that take over the memory of cells x size std::int64_t, the points of each cell.
 */
vtkSmartPointer<vtkCellArray> TakeCells(granular::Block& connectivity, vtkIdType cells, int size);

/**
 * Returns one vertex per point, or one cell with all points, from MakeCells; reuses the cells of the frame before if
 * they would be equal. Cells of an output must not be changed. If somebody does so and calls Modified(), or changes
 * their number, the next frame gets new cells.
 */
class VertexCache
{
public:
  VertexCache();
  ~VertexCache();

  vtkSmartPointer<vtkCellArray> Get(
    vtkIdType points, bool onePerPoint, const std::shared_ptr<granular::BlockPool>& pool);

private:
  vtkSmartPointer<vtkCellArray> Cells;
  vtkIdType Points = 0;
  bool OnePerPoint = false;
  vtkMTimeType Time = 0; ///< of Cells when they were made
};

/**
 * Returns the memory pool of a reader. The environment variable GRANULAR_POOL_MIB sets how many MiB the pool may keep.
 * If it is not set, or is not a number, which gives a notice, the limit is an eighth of the memory that the process may
 * use. Returns null for 0: no pool.
 */
std::shared_ptr<granular::BlockPool> MakePool(granular::Notices& notices);
}

#endif
