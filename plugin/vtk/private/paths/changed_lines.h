// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularChangedLines_h
#define vtkGranularChangedLines_h

#include "private/local/chosen_lines.h"

#include "granular/parallel/communicator.h"
#include "granular/paths/change.h"

#include <vector>

class vtkPolyData;

namespace vtkGranularPrivate
{
/**
 * Fills the output with lines of the current frame, and behind them the lost ones of the reference frame: each cell with
 * points of its own, the cell arrays, and `change`. changes: of all current rows. Throws UnsupportedError for other cells
 * than lines; Error if the parts of a split line are not consecutive. Collective.
 */
void FillLines(const ChosenLines& current, const ChosenLines& lost,
  const std::vector<granular::Change>& changes, granular::Communicator& ranks, vtkPolyData* output);
}

#endif
