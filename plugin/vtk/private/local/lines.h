// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLines_h
#define vtkGranularLines_h

#include "granular/common/error.h"
#include "granular/local/local_reader.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <memory>
#include <vector>

class vtkAbstractArray;
class vtkPolyData;
class vtkTable;

namespace vtkGranularPrivate
{
/**
 * Names of the arrays that lines get here.
 */
constexpr const char* LengthArray = "length";
constexpr const char* RowArray = "row";
constexpr const char* PartArray = "part";

/**
 * How lines are to be made, by what users set: PeriodicLines as in the core, and a point that must be finite.
 */
granular::LineRequest MakeLineRequest(int periodicLines, const double pointOrigin[3]);

/**
 * The rows of a frame of local data. Takes their memory.
 */
void FillRows(vtkTable* rows, granular::LocalFrame& frame);

/**
 * The lines of a frame, with what they have of its rows. Takes their memory.
 */
void FillLines(vtkPolyData* output, vtkTable* rows, granular::LocalFrame& frame,
  const granular::LineRequest& request, const granular::Where& where, granular::Notices& notices);

/**
 * Points and cells of lines, two points each, and their lengths as the cell array `length`. Takes the memory of the lines.
 */
void FillLines(
  vtkPolyData* output, granular::Lines& lines, const std::shared_ptr<granular::BlockPool>& pool);

/**
 * What the lines have of an array that has a tuple for each row: the array itself where each row is one line.
 */
vtkSmartPointer<vtkAbstractArray> TakeRows(vtkAbstractArray* array, const granular::Lines& lines);

/**
 * Adds what the lines have of the rows of a table. An array that is named like one that lines get here, `row` and `part` if
 * they are split, is `length_2` or so there, with a notice.
 */
void AddRows(vtkPolyData* output, vtkTable* rows, const granular::Lines& lines, bool split,
  const granular::Where& where, granular::Notices& notices);

/**
 * What tells the parts of lines that were split, as cell arrays: `row` (vtkTypeInt64), the number of the row, which is
 * firstRow for number 0 of these; `part` (vtkTypeInt32), 0 for the part at the first end, 1, 2, ... rows lists the numbers of
 * those that the lines are made from; empty: they are those.
 */
void AddParts(vtkPolyData* output, const granular::Lines& lines, vtkTypeInt64 firstRow,
  const std::vector<std::int64_t>& rows = {});
}

#endif
