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
 * The arrays that files have, and which of them the user wants.
 */
class ArrayChoice
{
public:
  ArrayChoice();
  ~ArrayChoice();

  vtkDataArraySelection* GetSelection() const { return this->Selection; }

  /**
   * Begins to list the arrays that there are now; Add names them, End takes away those that are no more. What was chosen
   * before stays, also for arrays that come back. Takes time in proportion to the arrays, if few of them are off. follow: new ones are off where the user has left out others.
   */
  void Begin(bool follow = false);
  void Add(const std::string& name, bool on);
  void End();

  /**
   * Whether all are on that were listed, but for those that are off if nobody chooses.
   */
  bool AreAllOn() const;

  /**
   * The names of those that are on.
   */
  std::set<std::string> GetWanted() const;

  /**
   * A name that is asked for and that no frame has is a slip of the pen: without a word, a column is missing. others: names that
   * are there, too, though they were not listed.
   */
  void CheckNames(const std::string& path, granular::Notices& notices,
    const std::vector<std::string>& others = {}) const;

private:
  std::map<std::string, bool> GetStates() const;

  vtkNew<vtkDataArraySelection> Selection;
  std::map<std::string, bool> Names; ///< of all frames, and whether they are on if nobody chooses
  std::vector<std::string> Order;    ///< of the names, as they were added
  bool Chosen = false;               ///< some were left out when Begin was called
  bool Follow = false;               ///< as Begin was told
  std::map<std::string, bool> Gone;  ///< what was chosen of those that are no more
};
}

#endif
