// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_chosen_averages_h
#define granular_averages_chosen_averages_h

#include "granular/averages/average.h"
#include "granular/common/error.h"
#include "granular/common/made_arrays.h"
#include "granular/common/progress.h"
#include "granular/contacts/contact_input.h"
#include "granular/contacts/find_ends.h"
#include "granular/grid/cells.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace granular
{
/// The arrays that averages can have.
inline constexpr MadeArray average_arrays[] = {
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

/// Weights as users choose them: see CellWeights and KernelShape.
enum class ChosenWeights : std::uint8_t
{
  Centre,
  Overlap,
  Gaussian,
  Lucy,
  Heaviside
};

/// Averages as users choose them, in cells and at points.
struct ChosenAverages
{
  ArrayChoice arrays;
  ParticleArrayNames names = {};
  ChosenWeights weights = ChosenWeights::Gaussian;
  double kernel_width = 0; ///< 0: the largest diameter
  int threads = 1;
};

/// The input of averages at one time. It must stay while it is averaged.
struct AverageInput
{
  FrameView& particles; ///< whose header all ranks share: see share_header
  std::optional<std::int64_t> timestep = {};
  std::string left_out = {}; ///< why a reader left out particles; empty: it did not
  const ContactSources& contacts;
};

/// The common part of averages in cells and at points: the choice of arrays, the contacts, and what is told.
class Averaging
{
public:
  Averaging(const Averaging&) = delete;
  void operator=(const Averaging&) = delete;

protected:
  /// ranks: that have the particles together.
  Averaging(ChosenAverages chosen, Communicator& ranks, Notices& notices)
    : chosen_(std::move(chosen))
    , ranks_(ranks)
    , executor_(chosen_.threads)
    , notices_(notices)
  {
  }
  ~Averaging() = default;

  /// Sets the names of arrays, and what is made of the arrays that are on, in a request of either kind.
  template <class Request>
  void choose(const AverageInput& input, Request& request) const
  {
    request.arrays = chosen_.names;
    request.fields = this->choose_fields(has_contacts(input));
    request.pressure = chosen_.arrays.is_on("pressure");
    request.tensors = has_contacts(input) && this->is_stress_on();
  }

  /// Returns true if contacts have a part in an array of a request.
  template <class Request>
  static bool needs_contacts(const Request& request)
  {
    return request.tensors || request.fields.coordination || request.fields.fabric;
  }

  static bool has_contacts(const AverageInput& input)
  {
    return input.contacts[0].rows != nullptr || input.contacts[1].rows != nullptr;
  }

  /// Collective.
  WeightOptions make_weights(const AverageInput& input, KernelBounds bounds) const;

  /// Tells that the reader left out particles, and that a general box has no periodic images.
  void check_input(const AverageInput& input);

  /// Finds the contacts of a frame with the particles at their ends, and counts those that are left out. forces: false reads none,
  /// where no stress is wanted. Collective.
  const FoundEnds& find_contacts(const AverageInput& input, bool forces, Progress& progress);

  /// Returns the arrays that are on, and puts what is told of counts before the other notices.
  EulerFrame finish(EulerCells&& cells, EulerFields&& fields);

  const ChosenAverages chosen_;
  Communicator& ranks_;
  const Executor executor_;
  Notices& notices_;
  std::int64_t outside_ = 0; ///< particles, of all frames
  std::int64_t broken_ = 0;
  std::optional<ContactInputs> contacts_;
  std::optional<FoundEnds> ends_;

private:
  EulerFieldSet choose_fields(bool contacts) const;
  bool is_stress_on() const;

  /// contacts of all frames and ranks: lines and rows that nothing places with a particle that is not there, then those with a
  /// number that is not finite
  std::array<std::int64_t, 3> left_out_ = {};
};

/// Averages at points.
class PointAveraging : private Averaging
{
public:
  PointAveraging(ChosenAverages chosen, Communicator& ranks, Notices& notices)
    : Averaging(std::move(chosen), ranks, notices)
  {
  }

  /// points: x y z of each, less the origin of the particles, to which they are moved. Throws Error for a width that cannot be, and what
  /// ContactInput and average_at_points throw; UnsupportedError for scaled particles. Collective.
  EulerFrame average(
    const AverageInput& input, std::vector<double> points, PartialProgress& progress);
};
}
#endif
