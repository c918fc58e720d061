// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLines_h
#define vtkGranularLines_h

#include "granular/local/lines.h"

#include "vtkSmartPointer.h"

#include <memory>

class vtkAbstractArray;
class vtkPolyData;

namespace vtkGranularPrivate
{
/**
 * Points and cells of lines, two points each, and their lengths as the cell array `length`. Takes the memory of the lines.
 */
void FillLines(
  vtkPolyData* output, granular::Lines& lines, const std::shared_ptr<granular::BlockPool>& pool);

/**
 * What the lines have of an array that has a tuple for each row: the array itself where each row is one line.
 */
vtkSmartPointer<vtkAbstractArray> TakeRows(vtkAbstractArray* array, const granular::Lines& lines);
}

#endif
