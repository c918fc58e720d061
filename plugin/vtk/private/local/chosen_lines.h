// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularChosenLines_h
#define vtkGranularChosenLines_h

#include "vtkType.h"

#include <cstdint>
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
  std::vector<std::int64_t> Wanted; ///< rows
};

/**
 * The cells of some rows: lines that were split have several.
 */
struct ChosenCells
{
  std::vector<std::int64_t> All;
  std::vector<std::int64_t> Rows; ///< of each
};

/**
 * Adds lines to those of the output: each cell with points of its own, which are doubles. Throws Error if the parts of a split
 * line are not consecutive; UnsupportedError for other cells than lines.
 */
ChosenCells AddLines(const ChosenLines& lines, vtkPolyData* output);
}

#endif
