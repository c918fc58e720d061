// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/time_average.h"

#include "granular/common/error.h"

#include <algorithm>
#include <string>

namespace granular
{
namespace
{
/// xx yy zz, xy xz yz.
constexpr std::array<std::array<std::size_t, 2>, 6> stress_axes = { { { 0, 0 }, { 1, 1 }, { 2, 2 },
  { 0, 1 }, { 0, 2 }, { 1, 2 } } };

constexpr std::array<std::vector<double> EulerFields::*, 4> mean_fields = { &EulerFields::density,
  &EulerFields::momentum, &EulerFields::contact_normal, &EulerFields::contact_shear };

void add_values(const std::vector<double>& values, std::vector<CompensatedSum>& sums)
{
  sums.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sums[i].add(values[i]);
  }
}

double quotient(const CompensatedSum& sum, const CompensatedSum& weight)
{
  return weight.value() > 0 ? sum.over(weight.twofold()).value() : 0;
}
}

/// Two sets of masses m and M whose means differ by d: what fluctuates about the mean of both is what does about each one's
/// own, and m M / (m + M) d d (T. F. Chan, G. H. Golub, R. J. LeVeque, "Updating formulae and a pairwise algorithm for
/// computing sample variances", COMPSTAT 1982): a sum of what is not negative, so that nothing cancels.
void TimeAverage::Sums::add_velocities(double frame_mass, const double* frame_momentum)
{
  const double before = mass.value();
  if (before > 0 && frame_mass > 0)
  {
    const double reduced = frame_mass * (before / (before + frame_mass));
    std::array<double, 3> d;
    for (std::size_t k = 0; k < 3; ++k)
    {
      d[k] = deviation(frame_momentum[k] / frame_mass, momentum[k].value() / before);
    }
    for (std::size_t n = 0; n < 6; ++n)
    {
      apart[n].add(reduced * d[stress_axes[n][0]] * d[stress_axes[n][1]]);
    }
  }
  mass.add(frame_mass);
  for (std::size_t k = 0; k < 3; ++k)
  {
    momentum[k].add(frame_momentum[k]);
  }
}

void TimeAverage::add(const EulerAverages& frame)
{
  const EulerCells& cells = frame.cells;
  if (frames_ == 0)
  {
    centres_ = cells.centres;
    sums_.resize(static_cast<std::size_t>(cells.count()));
    stress_ = !cells.normal_stress.empty();
  }
  if (cells.centres != centres_)
  {
    throw Error("expected the same cells in all frames that are averaged, got others in frame " +
      std::to_string(frames_) + ": their bounds and their number must not depend on the frame");
  }
  for (std::size_t i = 0; i < sums_.size(); ++i)
  {
    Sums& sums = sums_[i];
    sums.share.add(frame.sums.share[i]);
    sums.radius.add_product(frame.sums.share[i], cells.radius[i]);
    sums.add_velocities(frame.sums.mass[i], frame.sums.momentum.data() + 3 * i);
    sums.volume_fraction.add(cells.volume_fraction[i]);
    sums.pressure.add(cells.pressure[i]);
    for (std::size_t n = 0; stress_ && n < 3; ++n)
    {
      sums.stress[n].add(cells.normal_stress[3 * i + n]);
      sums.stress[3 + n].add(cells.shear_stress[3 * i + n]);
    }
    sums.volume = frame.sums.volume[i];
  }
  this->add_fields(frame);
  ++frames_;
}

void TimeAverage::add_fields(const EulerAverages& frame)
{
  const EulerFields& fields = frame.fields;
  const bool forces = !fields.contact_normal.empty();
  if (std::ranges::any_of(frame.sums.ends, [](double ends) { return ends > 0; }))
  {
    if (forces_.value_or(forces) != forces)
    {
      throw Error(
        "expected forces of the contacts in all frames that are averaged, or in none, got " +
        std::string(forces ? "some" : "none") + " in frame " + std::to_string(frames_));
    }
    forces_ = forces;
  }
  for (std::size_t i = 0; i < mean_fields.size(); ++i)
  {
    if (!(fields.*mean_fields[i]).empty()) // a frame without contacts may have none
    {
      add_values(fields.*mean_fields[i], means_[i]);
    }
  }
  add_values(frame.sums.ends, ends_);
  add_values(frame.sums.contacts, contacts_);
  add_values(frame.sums.normals, normals_);
  coordination_ = !fields.coordination.empty();
  energy_.resize(fields.temperature.size());
  for (std::size_t i = 0; i < energy_.size(); ++i)
  {
    energy_[i].add_product(3 * frame.sums.mass[i], fields.temperature[i]);
  }
}

EulerFields TimeAverage::fields() const
{
  EulerFields fields;
  for (std::size_t i = 0; i < (forces_.value_or(true) ? 4U : 2U);
       ++i) // the last two are of contacts
  {
    for (const CompensatedSum& sum : means_[i])
    {
      (fields.*mean_fields[i]).push_back(sum.value() / static_cast<double>(frames_));
    }
  }
  fields.temperature.resize(energy_.size());
  for (std::size_t i = 0; i < energy_.size(); ++i)
  {
    CompensatedSum energy = energy_[i];
    for (std::size_t k = 0; k < 3; ++k)
    {
      energy.add(sums_[i].apart[k].twofold());
    }
    fields.temperature[i] = quotient(energy, sums_[i].mass) / 3;
  }
  for (std::size_t i = 0; coordination_ && i < ends_.size(); ++i)
  {
    fields.coordination.push_back(quotient(ends_[i], sums_[i].share));
  }
  for (std::size_t i = 0; i < normals_.size(); ++i)
  {
    fields.fabric.push_back(quotient(normals_[i], contacts_[i / 6]));
  }
  return fields;
}

EulerCells TimeAverage::cells() const
{
  EulerCells cells;
  cells.resize(static_cast<std::int64_t>(sums_.size()));
  cells.centres = centres_;
  cells.normal_stress.resize(stress_ ? 3 * sums_.size() : 0);
  cells.shear_stress.resize(stress_ ? 3 * sums_.size() : 0);
  const auto frames = static_cast<double>(frames_);
  for (std::size_t i = 0; i < sums_.size(); ++i)
  {
    const Sums& sums = sums_[i];
    for (std::size_t k = 0; k < 3; ++k)
    {
      cells.velocities[3 * i + k] = quotient(sums.momentum[k], sums.mass);
    }
    cells.radius[i] = quotient(sums.radius, sums.share);
    cells.volume_fraction[i] = sums.volume_fraction.value() / frames;
    const auto& [xx, yy, zz, xy, xz, yz] = sums.apart;
    const double energy = xx.value() + yy.value() + zz.value();
    cells.pressure[i] = (sums.pressure.value() + energy / (3 * sums.volume)) / frames;
    for (std::size_t n = 0; stress_ && n < 6; ++n)
    {
      std::vector<double>& stress = n < 3 ? cells.normal_stress : cells.shear_stress;
      stress[3 * i + n % 3] =
        (sums.stress[n].value() - sums.apart[n].value() / sums.volume) / frames;
    }
  }
  return cells;
}
}
