// SPDX-License-Identifier: BSD-3-Clause
#include "private/euler/chosen_fields.h"

#include "private/dump/dump_output.h"

#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace vtkGranularPrivate
{
ChosenFields ChooseFields(vtkDataArraySelection* selection, bool contacts)
{
  const auto isOn = [&](const char* name) { return selection->ArrayIsEnabled(name) != 0; };
  constexpr std::array ofStress = { "pressure", "sigma", "tau", "sigma_kinetic", "tau_kinetic",
    "sigma_contact", "tau_contact" };
  ChosenFields chosen;
  chosen.Fields.density = isOn("density");
  chosen.Fields.momentum = isOn("momentum");
  chosen.Fields.temperature = isOn("granular_temperature");
  chosen.Fields.coordination = contacts && isOn("coordination");
  chosen.Fields.fabric = contacts && isOn("fabric");
  chosen.Pressure = isOn("pressure");
  chosen.Stress = contacts && std::ranges::any_of(ofStress, isOn);
  return chosen;
}

void KeepChosen(vtkDataArraySelection* selection, granular::EulerFrame& frame)
{
  std::erase_if(frame.arrays,
    [&](const granular::EulerValues& values)
    { return selection->ArrayIsEnabled(values.name.c_str()) == 0; });
}

void TellOfInputs(vtkDataObject* input, const granular::FrameView& view,
  vtkDataArraySelection* selection, granular::Notices& notices)
{
  const auto tell = [&](const std::string& text)
  {
    if (!text.empty())
    {
      notices.push_back({ {}, text });
    }
  };
  const std::string leftOut = FindLeftOut(input->GetFieldData());
  tell(leftOut.empty() ? ""
                       : "particles are missing that the reader left out (" + leftOut +
        "): averages count the particles that are there, volume fraction and stress are too small");
  const granular::Box& box = view.header.box;
  tell(view.has_box && box.general && box.boundary.find('p') != std::string::npos
      ? "the box is a general triclinic one: particles have no periodic images, and cells at its "
        "faces lack their parts"
      : "");
  tell(TellOfUnknown(selection, AverageArrays));
}
}
