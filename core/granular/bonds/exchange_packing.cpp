// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/exchange_packing.h"

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

/// Borders of a tilted box are in units of the box.
Displacement displacement_of(const PeriodicShift& shift, bool border) noexcept
{
  const auto [x, y, z] = shift.lengths;
  std::array<double, 6> amounts = { x, y, z, 0, 0, 0 };
  if (shift.triclinic)
  {
    amounts = border ? std::array<double, 6>{ 1, 1, 1, 0, 0, 0 }
                     : std::array<double, 6>{ x, y, z, shift.yz, shift.xz, shift.xy };
  }
  return { sum_of(shift.counts, amounts), sum_of(shift.counts, shift.rates), shift.moving_groups };
}

void add_to(double* to, const Vector3& change) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    to[axis] += change[axis];
  }
}

/// Adds what came to the forces on particles.
template <class Rows>
void add_forces(std::span<const double> buffer, const Rows& rows, std::span<Vector3> forces)
{
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    add_to(forces[rows[i]].data(), { buffer[3 * i], buffer[3 * i + 1], buffer[3 * i + 2] });
  }
}

/// Particles that are packed and unpacked before it is asked whether all is well.
constexpr std::size_t rows_a_block = 128;

/// The loops of a table.
template <const auto& fields>
struct Packer : PackTable<fields>
{
  using Table = PackTable<fields>;

  /// An array that is sent as it is.
  static constexpr bool is_array = fields.size() == 1 && is_vector(fields[0]);

  template <class Rows, class Numbers>
  static void put_rows(const auto& arrays, const Rows& rows, std::size_t begin, std::size_t end,
    double* to, Numbers& numbers)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      Table::put(arrays, rows[i], to + i * Table::doubles, numbers);
    }
  }

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
    for (std::size_t i = 0; i < rows.size(); i += rows_a_block)
    {
      const std::size_t end = std::min(i + rows_a_block, rows.size());
      FastNumbers fast;
      put_rows(arrays, rows, i, end, to, fast);
      if (fast.doubtful())
      {
        ExactNumbers exact;
        put_rows(arrays, rows, i, end, to, exact);
      }
    }
  }

  /// Moves what has been packed.
  template <class Rows>
  static void move(
    const BondedParticles& particles, const Rows& rows, const Displacement& change, double* to)
  {
    const auto* const masks = particles.mask().data();
    for (std::size_t i = 0; i < rows.size(); ++i, to += Table::doubles)
    {
      Table::for_each(
        [&](auto k)
        {
          if constexpr (fields[k] == PackField::X)
          {
            add_to(to + Table::template offset<k>, change.x);
          }
          if constexpr (fields[k] == PackField::V)
          {
            if ((masks[rows[i]] & change.moving_groups) != 0)
            {
              add_to(to + Table::template offset<k>, change.v);
            }
          }
        });
    }
  }

  /// Throws FormatError at the first fault of some particles.
  static void check(std::span<const double> buffer, ParticleRange some)
  {
    std::uint64_t doubts = 0;
    const double* const from = buffer.data() + some.first * Table::doubles;
    for (std::size_t i = 0; i < some.size(); ++i)
    {
      doubts |= Table::look_at_integers(from + i * Table::doubles);
    }
    for (std::size_t i = 0; doubts != 0 && i < some.size(); ++i)
    {
      Table::check(buffer, some[i] * Table::doubles, some[i]);
    }
  }

  /// Vectors row by row, then numbers field by field: a loop of one field is done several rows at a time.
  template <class Numbers>
  static void get_rows(const double* from, const auto& arrays, ParticleRange rows, Numbers& numbers)
  {
    for (std::size_t i = 0; i < rows.count; ++i)
    {
      Table::get_vectors(from + i * Table::doubles, arrays, rows[i]);
    }
    Table::for_each(
      [&](auto k)
      {
        if constexpr (!is_vector(fields[k]))
        {
          auto* const to = std::get<k>(arrays) + rows.first;
          const double* const field = from + Table::template offset<k>;
          Numbers own; // in registers
          for (std::size_t i = 0; i < rows.count; ++i)
          {
            own.from_number(field[i * Table::doubles], to[i]);
          }
          numbers.join(own);
        }
      });
  }

  /// Some particles of a buffer, into rows that are there. Throws FormatError.
  static void unpack(std::span<const double> buffer, ParticleRange some, BondedParticles& particles,
    std::size_t first)
  {
    const auto arrays = Table::arrays_of(particles);
    const double* const from = buffer.data() + some.first * Table::doubles;
    if constexpr (fields[0] == PackField::F)
    {
      add_forces(
        { from, some.count * Table::doubles }, ParticleRange{ first, some.count }, particles.f());
      return;
    }
    else if constexpr (is_array)
    {
      std::memcpy(std::get<0>(arrays) + first, from, some.count * sizeof(Vector3));
      return;
    }
    FastNumbers fast;
    get_rows(from, arrays, { first, some.count }, fast);
    if (fast.doubtful())
    {
      check(buffer, some);
      ExactNumbers exact;
      get_rows(from, arrays, { first, some.count }, exact);
    }
  }

  /// All particles of a buffer, into rows of which the last may be new. Throws FormatError.
  static void unpack_rows(
    std::span<const double> buffer, BondedParticles& particles, ParticleRange rows)
  {
    const std::size_t old = particles.size();
    if (rows.first < old)
    {
      check(buffer, { 0, rows.count }); // there is no way back later
    }
    try
    {
      // forces are added, and not written
      particles.resize(std::max(old, rows.first + rows.count), Table::set & ~set_of(PackField::F));
      for (std::size_t i = 0; i < rows.count; i += rows_a_block)
      {
        unpack(buffer, { i, std::min(rows_a_block, rows.count - i) }, particles, rows[i]);
      }
    }
    catch (const FormatError&)
    {
      particles.resize(old);
      throw;
    }
  }
};

/// Calls work with the packer of a routine in a dialect.
template <class Work>
auto with_packer(PackRoutine routine, PackDialect dialect, const Work& work)
{
  using namespace pack_tables;
  const bool pfm = dialect == PackDialect::Pfm;
  switch (routine)
  {
    case PackRoutine::Comm:
      return pfm ? work(Packer<comm_pfm>{}) : work(Packer<comm_plain>{});
    case PackRoutine::CommVelocity:
      return pfm ? work(Packer<comm_velocity_pfm>{}) : work(Packer<comm_velocity_plain>{});
    case PackRoutine::Border:
      return pfm ? work(Packer<border_pfm>{}) : work(Packer<border_plain>{});
    case PackRoutine::BorderVelocity:
      return pfm ? work(Packer<border_velocity_pfm>{}) : work(Packer<border_velocity_plain>{});
    case PackRoutine::BorderHybrid:
      return work(Packer<border_hybrid>{});
    case PackRoutine::Reverse:
      break;
  }
  return work(Packer<reverse>{});
}

bool is_border(PackRoutine routine) noexcept
{
  return routine == PackRoutine::Border || routine == PackRoutine::BorderVelocity;
}
}

std::size_t packed_doubles(PackRoutine routine, PackDialect dialect) noexcept
{
  return with_packer(routine, dialect, [](auto packer) { return packer.doubles; });
}

void pack(const BondedParticles& particles, PackRoutine routine, PackDialect dialect,
  const ParticleRows& rows, const PeriodicShift& shift, std::span<double> buffer)
{
  expect_rows(particles, rows);
  const auto pack_rows = [&](auto packer, const auto& some)
  {
    expect_size(some.size() * packer.doubles, buffer.size());
    packer.pack(particles, some, buffer.data());
    if (!shift.is_none())
    {
      packer.move(particles, some, displacement_of(shift, is_border(routine)), buffer.data());
    }
  };
  with_packer(routine, dialect,
    [&](auto packer) { std::visit([&](const auto& some) { pack_rows(packer, some); }, rows); });
}

void unpack(BondedParticles& particles, PackRoutine routine, PackDialect dialect,
  ParticleRange rows, std::span<const double> buffer)
{
  const std::size_t doubles = packed_doubles(routine, dialect);
  if (buffer.size() % doubles != 0 || buffer.size() / doubles != rows.count)
  {
    throw FormatError("expected " + std::to_string(doubles) + " doubles of each of " +
      std::to_string(rows.count) + " particles, got " + std::to_string(buffer.size()));
  }
  if (rows.first > particles.size())
  {
    throw LimitError("expected a first row of at most " + std::to_string(particles.size()) +
      ", got " + std::to_string(rows.first));
  }
  with_packer(routine, dialect, [&](auto packer) { packer.unpack_rows(buffer, particles, rows); });
}

void unpack_reverse(BondedParticles& particles, ParticleList rows, std::span<const double> buffer)
{
  expect_rows(particles, rows);
  expect_size(rows.size() * packed_doubles(PackRoutine::Reverse, PackDialect::Pfm), buffer.size());
  add_forces(buffer, rows, particles.f());
}
}
