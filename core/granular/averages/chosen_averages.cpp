// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/chosen_averages.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace granular
{
bool Averaging::is_stress_on() const
{
  constexpr std::array arrays = { "pressure", "sigma", "tau", "sigma_kinetic", "tau_kinetic",
    "sigma_contact", "tau_contact" };
  return std::ranges::any_of(
    arrays, [this](const char* name) { return chosen_.arrays.is_on(name); });
}

EulerFieldSet Averaging::choose_fields(bool contacts) const
{
  EulerFieldSet fields;
  fields.density = chosen_.arrays.is_on("density");
  fields.momentum = chosen_.arrays.is_on("momentum");
  fields.temperature = chosen_.arrays.is_on("granular_temperature");
  fields.coordination = contacts && chosen_.arrays.is_on("coordination");
  fields.fabric = contacts && chosen_.arrays.is_on("fabric");
  return fields;
}

WeightOptions Averaging::make_weights(const AverageInput& input, KernelBounds bounds) const
{
  constexpr int first = static_cast<int>(ChosenWeights::Gaussian);
  const int weights = static_cast<int>(chosen_.weights);
  WeightOptions options;
  options.weights = static_cast<CellWeights>(std::min(weights, first));
  options.kernel = static_cast<KernelShape>(std::max(weights - first, 0));
  options.bounds = bounds;
  options.width = chosen_.kernel_width;
  if (options.width == 0)
  {
    const double largest =
      weights >= first ? largest_radius(input.particles, chosen_.names, ranks_) : 0;
    options.width = largest > 0 ? 2 * largest : 1; // without particles any does
  }
  return options;
}

void Averaging::check_input(const AverageInput& input)
{
  if (!input.left_out.empty())
  {
    notices_.push_back({ {},
      "particles are missing that the reader left out (" + input.left_out +
        "): averages count the particles that are there, volume fraction and stress are too "
        "small" });
  }
  const Box& box = input.particles.header.box;
  if (input.particles.has_box && box.general && box.boundary.find('p') != std::string::npos)
  {
    notices_.push_back({ {},
      "the box is a general triclinic one: particles have no periodic images, and cells at its "
      "faces lack their parts" });
  }
}

const FoundEnds& Averaging::find_contacts(
  const AverageInput& input, bool forces, Progress& progress)
{
  ContactArrays wanted;
  wanted.force = forces;
  const ContactInputs& found = contacts_.emplace(input.contacts, wanted, progress);
  for (const ContactSource& source : input.contacts)
  {
    const std::string text =
      source.rows != nullptr ? compare_timesteps(input.timestep, source.timestep) : std::string();
    if (!text.empty())
    {
      notices_.push_back({ {}, text });
    }
  }
  ContactOptions options;
  options.arm = LeverArm::Half; // nobody asks where forces act: radii are not needed
  PartialProgress parts(progress);
  const FoundEnds& ends =
    ends_.emplace(input.particles, found.rows, "", options, ranks_, executor_, parts);
  if (forces && !ends.have_forces())
  {
    notices_.push_back({ {},
      "the contacts have neither an array 'force' nor 'force_normal': stress and pressure lack "
      "their part" });
  }
  std::array<std::int64_t, 3> left_out = { ends.missing() - ends.unplaced(), ends.unplaced(),
    ends.broken() };
  ranks_.sum(left_out);
  std::ranges::transform(left_out, left_out_, left_out_.begin(), std::plus<>());
  return ends;
}

EulerFrame Averaging::finish(EulerCells&& cells, EulerFields&& fields)
{
  const std::pair<std::int64_t, const char*> counts[] = {
    { outside_, " particles are outside of all cells, and in none" },
    { broken_,
      " particles are left out: a position, velocity, mass, radius or stress of theirs is no "
      "number, infinite or too large, or a mass or radius is negative" },
    { left_out_[0],
      " contacts name a particle that is not there: their stress counts as far as it is known" },
    { left_out_[1],
      " contacts name a particle that is not there, and have no line: they are left out" },
    { left_out_[2],
      " contacts are left out: a number of theirs is no number, infinite or too large" },
  };
  Notices told;
  for (const auto& [count, text] : counts)
  {
    if (count > 0)
    {
      told.push_back({ {}, std::to_string(count) + text, text });
    }
  }
  if (const std::string unknown = chosen_.arrays.unknown(); !unknown.empty())
  {
    told.push_back({ {}, unknown, "unknown arrays" });
  }
  notices_.insert(notices_.begin(), told.begin(), told.end());
  if (!fields.contact_normal.empty())
  {
    add_contact_stress(cells, fields);
  }
  EulerFrame frame = make_euler_frame(std::move(cells), std::move(fields));
  std::erase_if(
    frame.arrays, [&](const EulerValues& values) { return !chosen_.arrays.is_on(values.name); });
  return frame;
}

// ---- at points -----------------------------------------------------------------------------------
EulerFrame PointAveraging::average(
  const AverageInput& input, std::vector<double> points, PartialProgress& progress)
{
  const FrameView& view = input.particles;
  PointAverageRequest request;
  this->choose(input, request);
  const WeightOptions weights = this->make_weights(input, KernelBounds::None);
  check_width(weights.width);
  request.kernel = Kernel(weights.kernel, weights.width);
  this->check_input(input);
  const FoundEnds* contacts = nullptr;
  if (needs_contacts(request))
  {
    progress.set_part(0, 0.3);
    contacts = &this->find_contacts(input, request.tensors, progress);
  }
  progress.set_part(contacts != nullptr ? 0.3 : 0, 0.95);
  if (view.coordinates == Coordinates::Scaled && !points.empty())
  {
    throw UnsupportedError("expected absolute or unwrapped coordinates of the particles, got "
                           "scaled ones: set Coordinates of the reader");
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] += view.point_origin[i % 3];
  }
  EulerAverages averages =
    average_at_points(view, points, contacts, request, ranks_, executor_, notices_, progress);
  broken_ = averages.broken;
  return this->finish(std::move(averages.cells), std::move(averages.fields));
}
}
