// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularAverageTask_h
#define vtkGranularAverageTask_h

#include "vtkGranularAverageAlgorithm.h"

#include "private/contacts/contact_input.h"
#include "private/dump/dump_input.h"
#include "private/request/request_task.h"

#include "granular/averages/chosen_averages.h"

#include <array>
#include <string>

class vtkDataObject;

/**
 * The common part of the tasks of filters that average.
 */
class vtkGranularAverageAlgorithm::AverageTask
  : public vtkGranularPrivate::FilterTask<vtkGranularAverageAlgorithm>
{
public:
  using FilterTask::FilterTask;

protected:
  /**
   * The data at one time: particles, contacts between them, contacts with walls; null where there is none.
   */
  using FrameInputs = std::array<vtkDataObject*, 3>;

  /**
   * The same as the core takes them.
   */
  struct Frame
  {
    /**
     * Throws what Particles and GivenContacts throw. Collective.
     */
    Frame(const FrameInputs& inputs, granular::Communicator& ranks);

    vtkGranularPrivate::Particles Grains;
    vtkGranularPrivate::GivenContacts Contacts;
    granular::AverageInput Input;
  };

  /**
   * Returns what the properties say; weights: a WeightsType.
   */
  granular::ChosenAverages Choose(int weights, const std::string& stressArray = {}) const;

  const FrameInputs Inputs = { this->GetInput(0), this->GetInput(1), this->GetInput(2) };
};

#endif
