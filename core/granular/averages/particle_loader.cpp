// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/particle_loader.h"

#include "granular/common/error.h"
#include "granular/grid/sphere_box.h"
#include "granular/particles/point_forms.h"

namespace granular
{
namespace
{

/// Magnitudes that can be multiplied with each other as averages do.
constexpr double too_large = 0x1p290;

void check_numbers(const ValueSource& source, const std::string& name)
{
  if (source.type == ValueType::Text)
  {
    throw Error("expected an array '" + name + "' of numbers, got texts");
  }
}

std::optional<ValueSource> find_number(const FrameView& frame, const std::string& name)
{
  std::optional<ValueSource> source = name.empty() ? std::nullopt : find_values(frame, name);
  if (source)
  {
    check_numbers(*source, name);
  }
  else if (const ArrayView* array = frame.find(name))
  {
    throw Error("expected an array '" + name + "' with one value a particle, got " +
      std::to_string(array->size()));
  }
  return source;
}

/// All components of an array, or none where there is no such array.
template <std::size_t size>
std::array<std::optional<ValueSource>, size> find_components(
  const FrameView& frame, const std::string& name)
{
  std::array<std::optional<ValueSource>, size> sources;
  const ArrayView* const array = ArraysByName(frame).find(name, size);
  if (!array)
  {
    if (const ArrayView* other = frame.find(name))
    {
      throw Error("expected an array '" + name + "' with " + std::to_string(size) +
        " values a particle, got " + std::to_string(other->size()));
    }
    return sources;
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    sources[i] = component_of(*array, static_cast<int>(i));
    check_numbers(*sources[i], name);
  }
  return sources;
}

/// The values of all components, one particle after the other: where they are, if they lie so there, or in the buffer.
template <std::size_t size>
const double* load(const std::array<std::optional<ValueSource>, size>& sources, double missing,
  std::span<const std::int64_t> rows, double* buffer)
{
  if (!sources[0])
  {
    std::fill_n(buffer, size * rows.size(), missing);
    return buffer;
  }
  std::array<ValueSource, size> there;
  std::ranges::transform(sources, there.begin(), [](const auto& source) { return *source; });
  constexpr auto step = static_cast<std::int64_t>(size);
  if (!rows.empty() && there[0].step == step && are_rows(there) && is_consecutive(rows))
  {
    return static_cast<const double*>(there[0].data) + step * rows.front();
  }
  load_rows(there, rows, buffer);
  return buffer;
}

/// Returns true if all magnitudes are such that they can be added.
bool all_usable(const Magnitudes& magnitudes) noexcept
{
  return magnitudes.largest() < too_large; // not for nan
}

bool has_negative(const double* values, std::size_t count) noexcept
{
  std::uint64_t signs = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    signs |= std::bit_cast<std::uint64_t>(values[i]);
  }
  return signs >> 63 != 0;
}
}

ParticleSources find_particle_sources(const FrameView& frame, const ParticleArrayNames& names)
{
  ParticleSources sources;
  sources.velocity = find_components<3>(frame, names.velocity);
  sources.radius = find_number(frame, names.radius);
  sources.mass = find_number(frame, names.mass);
  const bool has_mass = sources.mass || names.mass.empty();
  sources.density = has_mass || !sources.radius ? std::nullopt : find_number(frame, "density");
  if (!names.stress.empty())
  {
    sources.stress = find_components<6>(frame, names.stress);
    if (!sources.stress[0] && frame.rows > 0)
    {
      throw Error("expected an array '" + names.stress +
        "' with six values a particle, the stress times the volume, got none");
    }
  }
  return sources;
}

ParticleLoader::ParticleLoader(const FrameView& frame, const ParticleSources& sources)
  : frame_(frame)
  , sources_(sources)
  , positions_(frame, true)
{
}

void ParticleLoader::load(std::span<const std::int64_t> rows, ParticleBlock& block) const
{
  this->load_values(rows, block);
  block.usable = nullptr;
  if (!all_usable_)
  {
    this->find_usable(rows, block);
  }
}

void ParticleLoader::scan(
  std::span<const std::int64_t> rows, ParticleBlock& block, Scan& scan) const
{
  this->load_values(rows, block);
  block.usable = nullptr;
  Scan own;
  Magnitudes positions;
  const bool moved = block.positions == block.positions_buffer.data();
  positions.add(block.positions, moved ? 3 * block.rows : 0); // else they are finite
  own.mass.add(block.mass, block.rows);
  own.speed.add(block.velocities, 3 * block.rows);
  own.radius.add(block.radius, block.rows);
  own.stress.add(block.stresses, block.stresses ? 6 * block.rows : 0);
  const bool usual = !frame_.ghosts && all_usable(positions) && all_usable(own.mass) &&
    all_usable(own.speed) && all_usable(own.radius) && all_usable(own.stress) &&
    sphere_volume(own.radius.largest()) < too_large && !has_negative(block.mass, block.rows) &&
    !has_negative(block.radius, block.rows);
  if (!usual)
  {
    this->find_usable(rows, block);
    own = {};
    for (std::size_t i = 0; i < block.rows; ++i)
    {
      if (block.uses(i))
      {
        own.mass.add(block.mass + i, 1);
        own.speed.add(block.velocities + 3 * i, 3);
        own.radius.add(block.radius + i, 1);
        own.stress.add(block.stresses + 6 * i, block.stresses ? 6 : 0);
      }
      else
      {
        own.broken += frame_.is_duplicate(rows[i]) ? 0 : 1;
      }
    }
  }
  own.moved = moved ? static_cast<std::int64_t>(block.rows) : 0;
  scan.add(own);
}

void ParticleLoader::trust(const Scan& scan) noexcept
{
  all_usable_ = scan.broken == 0 && !frame_.ghosts;
  none_moved_ = scan.moved == 0;
}

void ParticleLoader::load_values(std::span<const std::int64_t> rows, ParticleBlock& block) const
{
  using One = std::array<std::optional<ValueSource>, 1>;
  block.rows = rows.size();
  if (none_moved_ && is_consecutive(rows) && !rows.empty())
  {
    block.positions = positions_.loaded(rows.front());
  }
  else if (is_consecutive(rows) && !rows.empty())
  {
    block.positions = positions_.load(rows.front(), rows.size(), block.positions_buffer.data());
  }
  else
  {
    positions_.load(rows, block.positions_buffer.data());
    block.positions = block.positions_buffer.data();
  }
  block.velocities = granular::load(sources_.velocity, 0, rows, block.velocities_buffer.data());
  block.radius = granular::load(One{ sources_.radius }, 0, rows, block.radius_buffer.data());
  const One mass = { sources_.density ? sources_.density : sources_.mass };
  block.mass = granular::load(mass, 1, rows, block.mass_buffer.data());
  if (sources_.density)
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      block.mass_buffer[i] = block.mass[i] * sphere_volume(block.radius[i]);
    }
    block.mass = block.mass_buffer.data();
  }
  block.stresses = this->has_stress()
    ? granular::load(sources_.stress, 0, rows, block.stresses_buffer.data())
    : nullptr;
}

void ParticleLoader::find_usable(std::span<const std::int64_t> rows, ParticleBlock& block) const
{
  const auto fits = [](const double* values, std::size_t count, double least)
  {
    return std::all_of(values, values + count,
      [&](double value) { return value >= least && value < too_large; }); // false for nan
  };
  for (std::size_t i = 0; i < block.rows; ++i)
  {
    const bool usable = !frame_.is_duplicate(rows[i]) &&
      fits(block.positions + 3 * i, 3, -too_large) &&
      fits(block.velocities + 3 * i, 3, -too_large) && fits(block.radius + i, 1, 0) &&
      fits(block.mass + i, 1, 0) && sphere_volume(block.radius[i]) < too_large &&
      (!block.stresses || fits(block.stresses + 6 * i, 6, -too_large));
    block.usable_buffer[i] = usable ? 1 : 0;
  }
  block.usable = block.usable_buffer.data();
}

void ParticleLoader::Scan::add(const Scan& other) noexcept
{
  mass.add(other.mass);
  speed.add(other.speed);
  radius.add(other.radius);
  stress.add(other.stress);
  broken += other.broken;
  moved += other.moved;
}

SumScale::Range Magnitudes::range(int quantum) const noexcept
{
  constexpr int digits = 53;
  if (largest_ == 0)
  {
    return {};
  }
  return { std::ilogb(this->largest()) + 1, std::ilogb(this->smallest()) - (digits - 1) + quantum };
}
}
