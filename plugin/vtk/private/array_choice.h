// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularArrayChoice_h
#define vtkGranularArrayChoice_h

#include "granular/base/error.h"

#include "vtkNew.h"

#include <set>
#include <string>

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
   * Begins to list the arrays that there are now; Add names them, End forgets those that are no more. What was chosen
   * before stays.
   */
  void Begin() { this->Names.clear(); }
  void Add(const std::string& name, bool on);
  void End();

  /**
   * The names of those that are on.
   */
  std::set<std::string> GetWanted() const;

  /**
   * A name that is asked for and that no frame has is a slip of the pen: without a word, a column is missing.
   */
  void CheckNames(const std::string& path, granular::Notices& notices) const;

private:
  vtkNew<vtkDataArraySelection> Selection;
  std::set<std::string> Names; ///< of all frames
};
}

#endif
