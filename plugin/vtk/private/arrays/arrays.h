// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularArrays_h
#define vtkGranularArrays_h

#include "granular/columns/column.h"
#include "granular/dump/read/dump_reader.h"
#include "granular/memory/block.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
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
 * An array that takes the memory of a decoded one, without a copy: Int32 becomes vtkTypeInt32Array,
 * Int64 vtkTypeInt64Array (never vtkIdTypeArray), Float64 vtkDoubleArray, Text vtkStringArray. The
 * columns give the names of components that have no axis: c_ID[1] and so on.
 */
vtkSmartPointer<vtkAbstractArray> TakeArray(
  granular::DumpArray& array, vtkIdType rows, const std::vector<granular::ColumnInfo>& columns);

/**
 * Adds such an array, whose name no other has. VTK compares the name of an array that is added with all others, which takes its time
 * where there are many: it gets its name afterwards.
 */
void AddTaken(vtkFieldData* data, granular::DumpArray& array, vtkIdType rows,
  const std::vector<granular::ColumnInfo>& columns);

/**
 * The same of an array that there is, and that must not know its range: a new name makes it forget that.
 */
void AddNew(vtkFieldData* data, vtkAbstractArray* array);

/**
 * Points that take the memory of rows x 3 doubles or floats.
 */
vtkSmartPointer<vtkPoints> TakePoints(
  granular::Block& block, vtkIdType rows, bool single, const granular::ValueRange& range);

/**
 * Arrays for field data: one tuple, or one value a string.
 */
vtkSmartPointer<vtkAbstractArray> MakeDoubles(const char* name, const std::vector<double>& values);
vtkSmartPointer<vtkAbstractArray> MakeInteger(const char* name, vtkTypeInt64 value);
vtkSmartPointer<vtkAbstractArray> MakeIntegers(const char* name, const std::vector<int>& values);
vtkSmartPointer<vtkAbstractArray> MakeStrings(
  const char* name, const std::vector<std::string>& values);

/**
 * An array that takes the memory of tuples x components doubles.
 */
vtkSmartPointer<vtkDoubleArray> TakeDoubles(
  const char* name, granular::Block& block, vtkIdType tuples, int components);

/**
 * The tuples of an array that are listed, as another one of its kind.
 */
vtkSmartPointer<vtkAbstractArray> TakeTuples(vtkAbstractArray* array, vtkIdList* tuples);

/**
 * Cells with so many points of their own each, one after the other; with 32-bit indices where they suffice. None is
 * no cells.
 */
vtkSmartPointer<vtkCellArray> MakeCells(
  vtkIdType cells, vtkIdType size, const std::shared_ptr<granular::BlockPool>& pool = nullptr);

/**
 * Cells of equal size that take the memory of cells x size std::int64_t, the points of each.
 */
vtkSmartPointer<vtkCellArray> TakeCells(granular::Block& connectivity, vtkIdType cells, int size);

/**
 * One vertex a point, or one cell with all points, by MakeCells; the cells of the frame before where those would be the same. Nothing may be
 * changed in the cells of an output; who does that all the same, and says so, or who changes their
 * number, gets new ones with the next frame.
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
}

#endif
