// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularArrayChoice_h
#define vtkGranularArrayChoice_h

#include "granular/common/error.h"

#include "vtkNew.h"

#include <map>
#include <set>
#include <string>
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
   * Begins a new list of the current arrays; Add names them, End removes those that are gone. The selection stays, also
   * for arrays that return. Time is proportional to the number of arrays if few of them are off. follow: new arrays are
   * off if the user has deselected others.
   */
  void Begin(bool follow = false);
  void Add(const std::string& name, bool on);
  void End();

  /**
   * Returns true if all listed arrays are on, except those that are off by default.
   */
  bool AreAllOn() const;

  /**
   * Returns the names of the selected arrays.
   */
  std::set<std::string> GetWanted() const;

  /**
   * Warns of selected names that no frame has: they are probably misspelt, and the column would be missing without a
   * word. others: names that exist though they were not listed.
   */
  void CheckNames(const std::string& path, granular::Notices& notices,
    const std::vector<std::string>& others = {}) const;

private:
  std::map<std::string, bool> GetStates() const;

  vtkNew<vtkDataArraySelection> Selection;
  std::map<std::string, bool> Names; ///< of all frames, and whether they are on if nobody chooses
  std::map<std::string, bool> Next;  ///< the same of the list that was begun
  std::vector<std::string> Order;    ///< of its names, as they were added
  bool Chosen = false;               ///< some were left out when Begin was called
  bool Follow = false;               ///< as Begin was told
  std::map<std::string, bool> Gone;  ///< what was chosen of those that are no more
};
}

#endif
