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

void TellOfGrains(vtkDataObject* input, const granular::FrameView& view, granular::Notices& notices)
{
  const std::string leftOut = FindLeftOut(input->GetFieldData());
  if (!leftOut.empty())
  {
    granular::Notice notice;
    notice.text = "particles are missing that the reader left out (" + leftOut +
      "): averages count the particles that are there, volume fraction and stress are too small";
    notices.push_back(notice);
  }
  const granular::Box& box = view.header.box;
  if (view.has_box && box.tilted && box.boundary.find('p') != std::string::npos)
  {
    granular::Notice notice;
    notice.text = "the box is tilted: particles have no periodic images, and cells at its faces "
                  "lack their parts";
    notices.push_back(notice);
  }
}
}
