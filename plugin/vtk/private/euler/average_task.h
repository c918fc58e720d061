// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularAverageTask_h
#define vtkGranularAverageTask_h

#include "vtkGranularAverageAlgorithm.h"

#include "private/arrays/made_arrays.h"
#include "private/contacts/contact_input.h"
#include "private/dump/dump_input.h"
#include "private/request/request_task.h"

#include "granular/averages/particle_loader.h"
#include "granular/averages/smooth_cells.h"
#include "granular/contacts/find_ends.h"
#include "granular/formats/euler/euler_file.h"
#include "granular/grid/cells.h"
#include "granular/parallel/executor.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

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
}

/**
 * The common part of the tasks of filters that average: the choice of arrays, the contacts, and the warnings.
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

  void Execute() final;

  /**
   * Averages: sets Cells, Fields, Outside and Broken.
   */
  virtual void Average() = 0;

  virtual void Fill() = 0;

  /**
   * Sets the names of arrays, and what is made of the arrays that are on, in a request of the core.
   */
  template <class Request>
  void Choose(Request& request, const std::string& stressArray = {}) const
  {
    request.arrays = { this->Self->VelocityArray, this->Self->RadiusArray, this->Self->MassArray,
      stressArray };
    request.fields = this->ChooseFields();
    request.pressure = this->IsOn("pressure");
    request.tensors = this->HaveContacts() && this->IsStressOn();
  }

  /**
   * Returns true if contacts have a part in an array of a request.
   */
  template <class Request>
  static bool NeedsContacts(const Request& request)
  {
    return request.tensors || request.fields.coordination || request.fields.fabric;
  }

  bool HaveContacts() const { return this->Inputs[1] || this->Inputs[2]; }

  /**
   * Returns the weights of a WeightsType; a KernelWidth of 0 is the largest diameter. Collective.
   */
  granular::WeightOptions MakeWeights(
    int weights, granular::KernelBounds bounds, const granular::ParticleArrayNames& arrays);

  /**
   * Adds notices that the reader left out particles, and that a general box has no periodic images.
   */
  void CheckInput(vtkDataObject* input);

  /**
   * Finds the contacts of a frame with the particles at their ends, Grains, and counts those that are left out. Notices tell
   * if they are of another timestep. forces: false reads none, where no stress is wanted; otherwise a notice tells if there
   * are none. Collective.
   */
  const granular::FoundEnds& FindContacts(const FrameInputs& inputs, bool forces,
    const granular::Executor& executor, granular::Progress& progress);

  /**
   * Returns the arrays that are on, of Cells and Fields. Uses these up.
   */
  granular::EulerFrame TakeFrame();

  const FrameInputs Inputs = { this->GetInput(0), this->GetInput(1), this->GetInput(2) };
  std::optional<vtkGranularPrivate::Particles> Grains; ///< of the last frame
  std::optional<vtkGranularPrivate::ContactInputs> Contacts;
  std::optional<granular::FoundEnds> Ends; ///< of these
  granular::EulerCells Cells;
  granular::EulerFields Fields;
  std::int64_t Outside = 0; ///< particles, of all frames
  std::int64_t Broken = 0;

private:
  bool IsOn(const char* name) const;
  bool IsStressOn() const;
  granular::EulerFieldSet ChooseFields() const;

  /// contacts of all frames and ranks: lines and rows that nothing places with a particle that is not there, then those with a
  /// number that is not finite
  std::array<std::int64_t, 3> LeftOut = {};
};

#endif
