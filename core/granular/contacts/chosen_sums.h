// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_chosen_sums_h
#define granular_contacts_chosen_sums_h

#include "granular/common/error.h"
#include "granular/common/made_arrays.h"
#include "granular/common/progress.h"
#include "granular/common/value_type.h"
#include "granular/contacts/contact_input.h"
#include "granular/contacts/contact_sums.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace granular
{
/// The arrays that sums of contacts can have. The last one is of the contacts.
inline constexpr const char* friction_array = "mobilised_friction";
inline constexpr MadeArray contact_sum_arrays[] = {
  { "coordination", true },
  { "contact_force", true },
  { "contact_torque", true },
  { "fabric", true },
  { "contact_stress", true },
  { "principal_stress", false },
  { "von_mises", false },
  { "rattler", false },
  { "coordination_without_rattlers", false },
  { friction_array, false },
};

/// Sums as users choose them.
struct ChosenSumsRequest
{
  ArrayChoice arrays;
  bool half_branch = false;
  double least_force = 0;
  double least_overlap = 0;
  int rattler_contacts = 2;
  double friction_coefficient = 1;
  std::string radius = "radius";
  int threads = 1;
  std::optional<std::int64_t> timestep = {}; ///< of the particles, if it is known
};

/// An array of the particles.
struct SummedArray
{
  const char* name;
  ValueType type;
  int components;
  Block values;
};

/// The components of symmetric tensors, of which arrays have six.
inline constexpr const char* tensor_components[] = { "XX", "YY", "ZZ", "XY", "XZ", "YZ" };

struct ChosenSums
{
  std::vector<SummedArray> arrays;
  std::optional<std::vector<double>> friction;       ///< of each contact between particles
  std::vector<std::pair<const char*, double>> means; ///< over all particles, by their names
};

/// Sums the contacts that are there, and tells what is left out or missing. Throws Error for contacts that are not there or numbers that
/// cannot be, and what ContactInput and sum_contacts throw. Collective, of the ranks that have the particles together.
ChosenSums sum_chosen(const FrameView& particles, const ContactSources& contacts,
  const ChosenSumsRequest& request, Communicator& ranks, Notices& notices,
  PartialProgress& progress);
}
#endif
