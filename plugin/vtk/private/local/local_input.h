// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLocalInput_h
#define vtkGranularLocalInput_h

#include "private/dump/dump_input.h"

#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace vtkGranularPrivate
{
class LocalRows;

/**
 * Rows of contacts, bonds or anything else: of a table, or lines with their cell arrays, and with their ends as the
 * arrays position1 and position2 unless they have such arrays. Components of arrays that local_known_columns knows get
 * its names.
 */
class LocalInput : public RowsInput
{
public:
  /**
   * made: keep the cell arrays `length` and `row`, which readers and joins add to lines. Throws UnsupportedError for
   * other data and for cells that are not lines of two points; and what SeeArrays and ReadAbsolutePoints throw.
   */
  LocalInput(vtkDataObject* input, bool made, granular::Notices& notices);

private:
  void LeaveOut(const LocalRows& rows);
  void SeeLines(vtkPolyData* lines, bool made, const LocalRows& rows, granular::Notices& notices);
  void LeaveOutMade();
  void AddEnds(vtkPolyData* lines, const LocalRows& rows);

  std::vector<unsigned char> Ghosts; ///< where some rows are left out
  std::vector<double> Ends;          ///< x y z of both ends of each line
};
}

#endif
