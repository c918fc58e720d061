// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularArrayChoice_h
#define vtkGranularArrayChoice_h

#include "granular/columns/column.h"
#include "granular/common/error.h"
#include "granular/runs/kind.h"

#include "vtkNew.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

class vtkDataArraySelection;

namespace vtkGranularPrivate
{
/**
 * The arrays in the files, and the user's selection of them.
 */
class ArrayChoice
{
public:
  ArrayChoice();
  ~ArrayChoice();

  vtkDataArraySelection* GetSelection() const { return this->Selection; }

  /**
   * Replaces the list of arrays, of which the first of a name counts. The selection stays, also for arrays that return. Time is proportional to the number of
   * arrays if few of them are off.
   */
  void Offer(const std::vector<granular::OfferedArray>& arrays);

  /**
   * Returns true if all listed arrays are on, except those that are off by default.
   */
  bool AreAllOn() const;

  /**
   * Returns the names of the selected arrays.
   */
  std::set<std::string, std::less<>> GetWanted() const;

  /**
   * Returns a function that tells whether an array is selected now: a frame may be decoded while the selection changes. An array that
   * is not listed, such as bonds that come and go between the frames that were looked at, is on where all others are.
   */
  granular::Request::Choice MakeFilter() const;

  /**
   * Warns of selected names that no frame has: they are probably misspelt, and the column would be missing without a
   * word. present: arrays that exist though they may not be listed.
   */
  void CheckNames(const std::string& path, granular::Notices& notices,
    const granular::ColumnSchema& present = {}) const;

  bool Follow = false; ///< new arrays are off if the user has deselected others

private:
  std::map<std::string, bool, std::less<>> GetStates() const;

  vtkNew<vtkDataArraySelection> Selection;
  std::map<std::string, bool> Names; ///< of all frames, and whether they are on if nobody chooses
  std::map<std::string, bool> Gone;  ///< what was chosen of those that are no more
};
}

#endif
