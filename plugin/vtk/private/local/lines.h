// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLines_h
#define vtkGranularLines_h

#include "granular/common/error.h"
#include "granular/formats/local/local_reader.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkFieldData;
class vtkPolyData;
class vtkTable;

namespace vtkGranularPrivate
{
/**
 * Names of the arrays that lines get.
 */
constexpr const char* RowArray = "row";
constexpr const char* PartArray = "part";

/**
 * Returns the name of the array with the lengths of lines, `length`, or `length_2` and so on if the field data Columns has
 * that.
 */
std::string LengthName(vtkFieldData* fields);

/**
 * Fills the table with the rows of a frame of local data. Takes over their memory.
 */
void FillRows(vtkTable* rows, granular::Table& frame);

/**
 * Fills the output with the lines of a frame and the values of its rows. Takes over their memory.
 */
void FillLines(vtkPolyData* output, vtkTable* rows, granular::Table& frame,
  const granular::Request& request, const granular::Where& where, granular::Notices& notices);

/**
 * Fills the output, whose field data are there, with lines, two points each, and the cell array LengthName. Takes over the memory of
 * the lines.
 */
void FillLines(
  vtkPolyData* output, granular::Lines& lines, const std::shared_ptr<granular::BlockPool>& pool);

/**
 * Returns the values of an array for lines; the array has a tuple for each row. Returns the array itself if each row is
 * one line.
 */
vtkSmartPointer<vtkAbstractArray> TakeRows(vtkAbstractArray* array, const granular::Lines& lines);

/**
 * Adds the values of a table's rows to lines. If the lines are split, arrays `row` and `part` become `row_2` and so on, with
 * a notice.
 */
void AddRows(vtkPolyData* output, vtkTable* rows, const granular::Lines& lines, bool split,
  const granular::Where& where, granular::Notices& notices);

/**
 * Adds the cell arrays that identify parts of split lines: `row` (vtkTypeInt64), the number of the row, where firstRow
 * is the number of the first one; `part` (vtkTypeInt32), 0 for the part at the first end, then 1, 2, ... rows: the rows
 * that the lines are made from; empty for all rows in order.
 */
void AddParts(vtkPolyData* output, const granular::Lines& lines, vtkTypeInt64 firstRow,
  const std::vector<std::int64_t>& rows = {});
}

#endif
