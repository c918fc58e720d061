// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/chosen_sums.h"

#include "granular/numbers/number_print.h"

#include <algorithm>
#include <array>
#include <limits>

namespace granular
{
namespace
{
void expect_number(const char* name, double value, bool zero)
{
  if (!(value >= 0 && (zero || value > 0) && value <= std::numeric_limits<double>::max()))
  {
    throw Error("expected a " + std::string(name) + (zero ? " of 0 or more" : " above 0") +
      ", got " + to_text(value));
  }
}

ContactArrays arrays_for(const ChosenSumsRequest& request)
{
  const auto is_on = [&](const char* name) { return request.arrays.is_on(name); };
  const bool arms = is_on("contact_torque") || is_on("contact_stress") ||
    is_on("principal_stress") || is_on("von_mises");
  ContactArrays wanted;
  wanted.force = arms || is_on("contact_force") || is_on(friction_array) || request.least_force > 0;
  wanted.tangential = is_on(friction_array);
  wanted.torque = is_on("contact_torque");
  wanted.point = arms && !request.half_branch;
  wanted.overlap = request.least_overlap > 0;
  return wanted;
}

ContactSumsRequest sums_of(const ChosenSumsRequest& chosen)
{
  const auto is_on = [&](const char* name) { return chosen.arrays.is_on(name); };
  ContactSumsRequest request;
  request.force = is_on("contact_force");
  request.torque = is_on("contact_torque");
  request.fabric = is_on("fabric");
  request.stress = is_on("contact_stress");
  request.principal_stress = is_on("principal_stress");
  request.von_mises = is_on("von_mises");
  request.friction = is_on(friction_array);
  const bool rattlers = is_on("rattler") || is_on("coordination_without_rattlers");
  request.least_contacts = rattlers ? chosen.rattler_contacts : 0;
  request.options.arm = chosen.half_branch ? LeverArm::Half : LeverArm::ContactPoint;
  request.options.least_force = chosen.least_force;
  request.options.least_overlap = chosen.least_overlap;
  request.radius = chosen.radius;
  request.threads = chosen.threads;
  return request;
}

/// Facts of the inputs that remarks are made of.
struct Seen
{
  std::array<std::int64_t, 2> all = {}; ///< contacts of all ranks
  std::string timesteps;
  bool lack_forces = false;
  bool lack_places = false;
};

Seen look_at(const ContactSources& contacts, const ContactInputs& inputs, bool forces,
  std::optional<std::int64_t> timestep)
{
  Seen seen;
  for (std::size_t port = 0; port < contacts.size(); ++port)
  {
    if (const ContactSource& source = contacts[port]; source.rows != nullptr)
    {
      seen.all[port] = source.rows->count();
      seen.lack_forces = seen.lack_forces ||
        (forces && seen.all[port] > 0 && inputs.each[port]->rows().force.empty());
      seen.lack_places = seen.lack_places || source.rows->lack_places();
      const std::string remark = compare_timesteps(timestep, source.timestep);
      seen.timesteps = seen.timesteps.empty() ? remark : seen.timesteps;
    }
  }
  return seen;
}

void tell(const Seen& seen, const ContactSums& sums, const ArrayChoice& arrays, Notices& notices)
{
  const auto tell = [&](bool holds, const char* topic, const std::string& text)
  {
    if (holds)
    {
      notices.push_back({ {}, text, topic });
    }
  };
  const std::int64_t all = seen.all[0] + seen.all[1];
  const std::string of_all = " of " + std::to_string(all) + " contacts ";
  tell(seen.lack_places && all == 0, "no places",
    "an input has no lines, as its file does not say where these are: take the rows, the second "
    "output of the reader");
  tell(sums.missing > 0, "missing",
    std::to_string(sums.missing) + of_all +
      "name a particle that is not there: they count for the other one alone" +
      (sums.unplaced > 0 ? "; " + std::to_string(sums.unplaced) +
            " of these have no line, and count for coordination and force alone"
                         : ""));
  tell(sums.broken > 0, "broken",
    std::to_string(sums.broken) + of_all +
      "are left out: a number of theirs is no number, infinite or too large");
  tell(sums.repeated > 0, "repeated",
    std::to_string(sums.repeated) +
      " particles have the id of another one: contacts go to the first");
  tell(!seen.timesteps.empty(), "timesteps", seen.timesteps);
  const std::string unknown = arrays.unknown();
  tell(!unknown.empty(), "unknown arrays", unknown);
  tell(seen.lack_forces, "no forces",
    "the contacts have neither an array 'force' nor 'force_normal': what needs forces is not made");
}

std::vector<SummedArray> arrays_of(ContactSums& sums, const ArrayChoice& chosen)
{
  const struct
  {
    const char* name;
    ValueType type;
    int components;
    Block& values;
    bool is_always; ///< there, whatever is chosen
  } all[] = {
    { "coordination", ValueType::Int32, 1, sums.coordination, true },
    { "contact_force", ValueType::Float64, 3, sums.force, false },
    { "contact_torque", ValueType::Float64, 3, sums.torque, false },
    { "fabric", ValueType::Float64, 6, sums.fabric, false },
    { "contact_stress", ValueType::Float64, 6, sums.stress, false },
    { "principal_stress", ValueType::Float64, 3, sums.principal_stress, false },
    { "von_mises", ValueType::Float64, 1, sums.von_mises, false },
    { "rattler", ValueType::UInt8, 1, sums.rattlers, true },
    { "coordination_without_rattlers", ValueType::Int32, 1, sums.backbone, true },
  };
  std::vector<SummedArray> made;
  for (const auto& [name, type, components, values, is_always] : all)
  {
    if (is_always ? chosen.is_on(name) : values.data() != nullptr)
    {
      made.push_back({ name, type, components, std::move(values) });
    }
  }
  return made;
}
}

ChosenSums sum_chosen(const FrameView& particles, const ContactSources& contacts,
  const ChosenSumsRequest& request, Communicator& ranks, Notices& notices,
  PartialProgress& progress)
{
  if (contacts[0].rows == nullptr && contacts[1].rows == nullptr)
  {
    throw Error("expected contacts: the input Lines, Walls, or both, got none. In the window: "
                "Edit, Change Input");
  }
  expect_number("MinimumForce", request.least_force, true);
  expect_number("MinimumOverlap", request.least_overlap, true);
  expect_number("FrictionCoefficient", request.friction_coefficient, false);
  const ContactArrays wanted = arrays_for(request);
  const ContactInputs inputs(contacts, wanted, progress);
  Seen seen = look_at(contacts, inputs, wanted.force, request.timestep);
  progress.set_part(0.1, 0.95);
  ContactSums sums = sum_contacts(particles, inputs.rows, sums_of(request), ranks, progress);
  ranks.sum(seen.all);
  tell(seen, sums, request.arrays, notices);
  ChosenSums made;
  const auto mean = [&](const char* name, std::int64_t of_contacts, std::int64_t of_particles)
  {
    made.means.emplace_back(name,
      of_particles > 0 ? static_cast<double>(of_contacts) / static_cast<double>(of_particles)
                       : 0.0);
  };
  mean("mean_coordination", sums.contacts, sums.particles);
  if (sums.rattlers.data() != nullptr || sums.backbone.data() != nullptr)
  {
    mean("mean_coordination_without_rattlers", sums.bearing, sums.particles - sums.rattling);
  }
  if (!sums.friction.empty() && contacts[0].rows != nullptr)
  {
    const auto* const values = static_cast<const double*>(sums.friction[0].data());
    std::vector<double>& friction =
      made.friction.emplace(values, values + contacts[0].rows->count());
    for (double& value : friction)
    {
      value /= request.friction_coefficient;
    }
  }
  made.arrays = arrays_of(sums, request.arrays);
  return made;
}
}
