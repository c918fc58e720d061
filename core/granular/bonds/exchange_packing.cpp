// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/exchange_packing.h"

#include "granular/base/number_print.h"
#include "granular/bonds/pack_values.h"

#include <algorithm>

namespace granular
{
namespace
{
/// What is added while packing.
struct Displacement
{
  Vector3 x = {};
  Vector3 v = {};
  std::int32_t moving_groups = 0;
};

/// Along each axis the boxes of counts, and what tilts add to those.
Vector3 sum_of(const std::array<int, 6>& counts, const std::array<double, 6>& amounts) noexcept
{
  std::array<double, 6> terms{};
  for (std::size_t k = 0; k < terms.size(); ++k)
  {
    terms[k] = counts[k] * amounts[k];
  }
  return { terms[0] + terms[5] + terms[4], terms[1] + terms[3], terms[2] };
}

Displacement displacement_of(const PeriodicShift& shift, bool border) noexcept
{
  Displacement found;
  const bool tilted = shift.triclinic && !border;
  if (border && shift.triclinic)
  {
    found.x = sum_of(shift.counts, { 1, 1, 1, 0, 0, 0 });
  }
  else
  {
    found.x = sum_of(shift.counts,
      { shift.lengths[0], shift.lengths[1], shift.lengths[2], tilted ? shift.yz : 0,
        tilted ? shift.xz : 0, tilted ? shift.xy : 0 });
  }
  found.v = sum_of(shift.counts, shift.rates);
  found.moving_groups = shift.moving_groups;
  return found;
}

void add_to(double* to, const Vector3& change) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    to[axis] += change[axis];
  }
}

/// The loops of a table.
template <const auto& fields>
struct Packer : PackTable<fields>
{
  using Table = PackTable<fields>;

  /// An array that is sent as it is.
  static constexpr bool is_array = Table::size == 1 && is_vector(fields[0]);

  template <class Rows>
  static void pack(const BondedParticles& particles, const Rows& rows, double* to)
  {
    const auto arrays = Table::arrays_of(particles);
    if constexpr (is_array && std::is_same_v<Rows, ParticleRange>)
    {
      if (rows.count > 0)
      {
        std::memcpy(to, std::get<0>(arrays) + rows.first, rows.count * sizeof(Vector3));
      }
      return;
    }
    for (std::size_t i = 0; i < rows.size(); ++i, to += Table::doubles)
    {
      Table::put(arrays, rows[i], to);
    }
  }

  template <class Rows>
  static void pack_moved(
    const BondedParticles& particles, const Rows& rows, const Displacement& change, double* to)
  {
    const auto arrays = Table::arrays_of(particles);
    const auto* const masks = particles.mask().data();
    for (std::size_t i = 0; i < rows.size(); ++i, to += Table::doubles)
    {
      Table::put(arrays, rows[i], to);
      Table::for_each(
        [&](auto k)
        {
          if constexpr (fields[k] == PackField::X)
          {
            add_to(to + Table::offset_of(k), change.x);
          }
          if constexpr (fields[k] == PackField::V)
          {
            if ((masks[rows[i]] & change.moving_groups) != 0)
            {
              add_to(to + Table::offset_of(k), change.v);
            }
          }
        });
    }
  }

  static void check(std::span<const double> buffer)
  {
    for (std::size_t i = 0; i < buffer.size() / Table::doubles; ++i)
    {
      Table::check(buffer, i * Table::doubles, i);
    }
  }

  template <class Rows>
  static void unpack(const double* from, const Rows& rows, BondedParticles& particles)
  {
    const auto arrays = Table::arrays_of(particles);
    if constexpr (is_array && fields[0] != PackField::F)
    {
      if (rows.count > 0)
      {
        std::memcpy(std::get<0>(arrays) + rows.first, from, rows.count * sizeof(Vector3));
      }
      return;
    }
    for (std::size_t i = 0; i < rows.size(); ++i, from += Table::doubles)
    {
      if constexpr (fields[0] == PackField::F)
      {
        add_to(std::get<0>(arrays)[rows[i]].data(), { from[0], from[1], from[2] });
      }
      else
      {
        Table::get(from, arrays, rows[i]);
      }
    }
  }
};

/// A routine in a dialect.
struct Routine
{
  std::span<const PackField> fields;
  std::size_t doubles;
  bool border;
  void (*pack)(const BondedParticles&, const ParticleRows&, double*);
  void (*pack_moved)(const BondedParticles&, const ParticleRows&, const Displacement&, double*);
  void (*check)(std::span<const double>);
  void (*unpack)(const double*, const ParticleRange&, BondedParticles&);
};

template <const auto& fields>
constexpr Routine routine_of(bool border) noexcept
{
  return { fields, Packer<fields>::doubles, border,
    [](const BondedParticles& particles, const ParticleRows& rows, double* to)
    { std::visit([&](const auto& some) { Packer<fields>::pack(particles, some, to); }, rows); },
    [](const BondedParticles& particles, const ParticleRows& rows, const Displacement& change,
      double* to)
    {
      std::visit(
        [&](const auto& some) { Packer<fields>::pack_moved(particles, some, change, to); }, rows);
    },
    &Packer<fields>::check, &Packer<fields>::template unpack<ParticleRange> };
}

/// By routine, then by dialect.
const Routine& find(PackRoutine routine, PackDialect dialect) noexcept
{
  using namespace pack_tables;
  static constexpr std::array<std::array<Routine, 2>, 6> routines{ {
    { routine_of<comm_pfm>(false), routine_of<comm_plain>(false) },
    { routine_of<comm_velocity_pfm>(false), routine_of<comm_velocity_plain>(false) },
    { routine_of<border_pfm>(true), routine_of<border_plain>(true) },
    { routine_of<border_velocity_pfm>(true), routine_of<border_velocity_plain>(true) },
    { routine_of<border_hybrid>(true), routine_of<border_hybrid>(true) },
    { routine_of<reverse>(false), routine_of<reverse>(false) },
  } };
  return routines[static_cast<std::size_t>(routine)][static_cast<std::size_t>(dialect)];
}

std::size_t size_of(const ParticleRows& rows) noexcept
{
  return std::visit([](const auto& some) { return some.size(); }, rows);
}
}

void refuse_number(const std::string& expected, std::size_t particle, std::size_t at, double got)
{
  throw FormatError(
    "expected " + expected + " " + buffer_place(particle, at) + ", got " + to_text(got));
}

std::string buffer_place(std::size_t particle, std::size_t at)
{
  return "in double " + std::to_string(at) + " of the buffer, of its particle " +
    std::to_string(particle);
}

void expect_rows(const BondedParticles& particles, const ParticleRows& rows)
{
  if (const auto* const range = std::get_if<ParticleRange>(&rows))
  {
    if (range->first > particles.size() || range->count > particles.size() - range->first)
    {
      throw LimitError("expected rows of " + std::to_string(particles.size()) + " particles, got " +
        std::to_string(range->count) + " from " + std::to_string(range->first) + " on");
    }
    return;
  }
  for (const std::size_t row : std::get<ParticleList>(rows))
  {
    if (row >= particles.size())
    {
      throw LimitError("expected rows of " + std::to_string(particles.size()) +
        " particles, got row " + std::to_string(row));
    }
  }
}

void expect_size(std::size_t needed, std::size_t size)
{
  if (size != needed)
  {
    throw LimitError(
      "expected a buffer of " + std::to_string(needed) + " doubles, got " + std::to_string(size));
  }
}

std::span<const PackField> fields_of(PackRoutine routine, PackDialect dialect) noexcept
{
  return find(routine, dialect).fields;
}

std::size_t packed_doubles(PackRoutine routine, PackDialect dialect) noexcept
{
  return find(routine, dialect).doubles;
}

void pack(const BondedParticles& particles, PackRoutine routine, PackDialect dialect,
  const ParticleRows& rows, const PeriodicShift& shift, std::span<double> buffer)
{
  const Routine& found = find(routine, dialect);
  expect_rows(particles, rows);
  expect_size(size_of(rows) * found.doubles, buffer.size());
  if (shift.is_none())
  {
    found.pack(particles, rows, buffer.data());
    return;
  }
  found.pack_moved(particles, rows, displacement_of(shift, found.border), buffer.data());
}

void unpack(BondedParticles& particles, PackRoutine routine, PackDialect dialect,
  ParticleRange rows, std::span<const double> buffer)
{
  const Routine& found = find(routine, dialect);
  if (buffer.size() % found.doubles != 0 || buffer.size() / found.doubles != rows.count)
  {
    throw FormatError("expected " + std::to_string(found.doubles) + " doubles of each of " +
      std::to_string(rows.count) + " particles, got " + std::to_string(buffer.size()));
  }
  if (rows.first > particles.size())
  {
    throw LimitError("expected a first row of at most " + std::to_string(particles.size()) +
      ", got " + std::to_string(rows.first));
  }
  found.check(buffer);
  particles.resize(std::max(particles.size(), rows.first + rows.count));
  found.unpack(buffer.data(), rows, particles);
}

void unpack_reverse(BondedParticles& particles, ParticleList rows, std::span<const double> buffer)
{
  expect_rows(particles, rows);
  expect_size(rows.size() * Packer<pack_tables::reverse>::doubles, buffer.size());
  Packer<pack_tables::reverse>::unpack(buffer.data(), rows, particles);
}
}
