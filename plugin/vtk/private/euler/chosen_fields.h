// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularChosenFields_h
#define vtkGranularChosenFields_h

#include "granular/common/error.h"
#include "granular/euler/euler_file.h"
#include "granular/euler/fields.h"
#include "granular/particles/frame_view.h"

class vtkDataArraySelection;
class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * What is to be made for the arrays that are on.
 */
struct ChosenFields
{
  granular::EulerFieldSet Fields;
  bool Pressure = false;
  bool Stress = false; ///< of contacts, too

  /**
   * Whether contacts have a part in any.
   */
  bool NeedContacts() const
  {
    return this->Stress || this->Fields.coordination || this->Fields.fabric;
  }
};

/**
 * contacts: whether there are any; otherwise what needs them is not made.
 */
ChosenFields ChooseFields(vtkDataArraySelection* selection, bool contacts);

/**
 * Removes the arrays that are off.
 */
void KeepChosen(vtkDataArraySelection* selection, granular::EulerFrame& frame);

/**
 * Tells that particles are missing which the reader left out, and that a tilted box has no periodic images.
 */
void TellOfGrains(
  vtkDataObject* input, const granular::FrameView& view, granular::Notices& notices);
}

#endif
