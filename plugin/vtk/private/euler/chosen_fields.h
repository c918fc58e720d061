// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularChosenFields_h
#define vtkGranularChosenFields_h

#include "private/arrays/made_arrays.h"

#include "granular/common/error.h"
#include "granular/euler/euler_file.h"
#include "granular/euler/fields.h"
#include "granular/particles/frame_view.h"

class vtkDataArraySelection;
class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * The arrays that averages can have.
 */
inline constexpr MadeArray AverageArrays[] = {
  { "v_avg", true },
  { "volumefraction", true },
  { "radius", true },
  { "pressure", true },
  { "sigma", true },
  { "tau", true },
  { "density", false },
  { "momentum", false },
  { "granular_temperature", false },
  { "coordination", false },
  { "fabric", false },
  { "sigma_kinetic", false },
  { "tau_kinetic", false },
  { "sigma_contact", false },
  { "tau_contact", false },
};

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
 * Tells that particles are missing which the reader left out, that a general box has no periodic images, and that arrays are on
 * which do not exist.
 */
void TellOfInputs(vtkDataObject* input, const granular::FrameView& view,
  vtkDataArraySelection* selection, granular::Notices& notices);
}

#endif
