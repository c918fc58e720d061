// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularChosenLines_h
#define vtkGranularChosenLines_h

#include "vtkType.h"

#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace vtkGranularPrivate
{
class LocalRows;

/**
 * Some lines of a frame.
 */
struct ChosenLines
{
  vtkPointSet* Input;
  const LocalRows* Rows;
  std::vector<vtkIdType> Wanted; ///< rows
};

/**
 * The cells of some rows: lines that were split have several.
 */
struct ChosenCells
{
  std::vector<vtkIdType> All;
  std::vector<vtkIdType> Rows; ///< of each
};

/**
 * Throws Error if the parts of a split line are not consecutive.
 */
ChosenCells FindCells(const ChosenLines& lines);

/**
 * Adds cells to the lines of the output, each with points of its own. Throws UnsupportedError for other cells than lines.
 */
void AddLines(vtkPointSet* from, const std::vector<vtkIdType>& cells, vtkPolyData* output);
}

#endif
