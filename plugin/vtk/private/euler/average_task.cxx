// SPDX-License-Identifier: BSD-3-Clause
#include "private/euler/average_task.h"

#include "private/arrays/made_arrays.h"
#include "private/dump/dump_output.h"

#include "vtkDataObject.h"

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
vtkGranularAverageAlgorithm::AverageTask::Frame::Frame(
  const FrameInputs& inputs, granular::Communicator& ranks)
  : Grains(inputs[0], ranks)
  , Contacts({ inputs[1], inputs[2] })
  , Input{ this->Grains.View, TimestepOf(inputs[0]->GetFieldData()),
    FindLeftOut(inputs[0]->GetFieldData()), this->Contacts.Sources }
{
}

//------------------------------------------------------------------------------
granular::ChosenAverages vtkGranularAverageAlgorithm::AverageTask::Choose(
  int weights, const std::string& stressArray) const
{
  const vtkGranularAverageAlgorithm& self = *this->Self;
  return { ChoiceOf(self.ArraySelection, granular::average_arrays),
    { self.VelocityArray, self.RadiusArray, self.MassArray, stressArray },
    static_cast<granular::ChosenWeights>(weights), self.KernelWidth, this->Threads };
}
