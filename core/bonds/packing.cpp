// SPDX-License-Identifier: BSD-3-Clause
#include "packing.h"

#include <algorithm>
#include <array>

namespace granular
{
namespace
{
using Triple = std::array<double, 3>;

/// Returns the sum along each axis: the boxes of counts, and the parts that tilts add to them.
Triple sum_of(const int32_t* counts, const std::array<double, 6>& amounts) noexcept
{
  std::array<double, 6> terms{};
  for (std::size_t k = 0; k < terms.size(); ++k)
  {
    terms[k] = counts[k] * amounts[k];
  }
  return { terms[0] + terms[5] + terms[4], terms[1] + terms[3], terms[2] };
}

/// Borders of a tilted box are in units of the box.
Triple movement_of_x(const granular_bonds_shift& shift, int kind) noexcept
{
  const double* const box = shift.lengths;
  const double* const tilts = shift.tilts;
  std::array<double, 6> amounts = { box[0], box[1], box[2], 0, 0, 0 };
  const int routine = routine_of(kind);
  if (shift.triclinic != 0)
  {
    amounts = { box[0], box[1], box[2], tilts[0], tilts[1], tilts[2] };
    if (routine == GRANULAR_BONDS_BORDER || routine == GRANULAR_BONDS_BORDER_VELOCITY)
    {
      amounts = { 1, 1, 1, 0, 0, 0 };
    }
  }
  return sum_of(shift.counts, amounts);
}

void add_to(double* to, const double* change) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    to[axis] += change[axis];
  }
}

/// Moves the copies in a buffer.
void move(const BondedParticles& particles, int kind, const BondRows& rows,
  const granular_bonds_shift& shift, double* to)
{
  const BondMessage& message = message_of(kind);
  const Triple x = movement_of_x(shift, kind);
  std::array<double, 6> rates{};
  std::ranges::copy(shift.rates, rates.begin());
  const Triple v = sum_of(shift.counts, rates);
  for (std::size_t i = 0; i < rows.count; ++i, to += message.doubles)
  {
    add_to(to, x.data());
    const bool moving = (particles.arrays().mask[rows[i]] & shift.moving_groups) != 0;
    if (moving && message.velocity > 0)
    {
      add_to(to + message.velocity, v.data());
    }
  }
}

void expect_rows(const BondedParticles& particles, const BondRows& rows)
{
  const std::size_t size = particles.size();
  if (rows.list == nullptr && (rows.first > size || rows.count > size - rows.first))
  {
    throw BadBondArgument("expected rows of " + std::to_string(size) + " particles, got " +
      std::to_string(rows.count) + " from " + std::to_string(rows.first) + " on");
  }
  for (std::size_t i = 0; rows.list != nullptr && i < rows.count; ++i)
  {
    if (rows[i] >= size) // so is a negative one
    {
      throw BadBondArgument("expected rows of " + std::to_string(size) + " particles, got row " +
        std::to_string(rows.list[rows.first + i]));
    }
  }
}

void add_forces(const BondedParticles& particles, const BondRows& rows, const double* forces)
{
  expect_rows(particles, rows);
  for (std::size_t i = 0; i < rows.count; ++i)
  {
    add_to(particles.arrays().f + 3 * rows[i], forces + 3 * i);
  }
}

/// Particles of a buffer into rows of which the last may be new. Rows that there are must not change before all is checked; new
/// ones are dropped after an error.
void unpack_rows(BondedParticles& particles, const BondMessage& message, std::size_t first,
  std::size_t count, std::span<const double> buffer)
{
  const std::size_t old = particles.size();
  if (first < old)
  {
    message.check(buffer, 0, 0, count);
  }
  particles.resize(std::max(old, first + count), message.set);
  try
  {
    constexpr std::size_t block = 128; // stays in the cache
    for (std::size_t i = 0; i < count; i += block)
    {
      const std::size_t some = std::min(block, count - i);
      const std::size_t place = i * message.doubles;
      message.check(buffer, place, i, some);
      message.get(particles.arrays(), first + i, some, buffer.data() + place);
    }
  }
  catch (const FormatError&)
  {
    particles.resize(old);
    throw;
  }
}
}

std::size_t packed_doubles(const BondedParticles& particles, int kind, const BondRows& rows)
{
  const BondMessage& message = message_of(kind);
  expect_rows(particles, rows);
  return routine_of(kind) == GRANULAR_BONDS_EXCHANGE ? exchange_doubles(particles, message, rows)
                                                     : rows.count * message.doubles;
}

void pack(const BondedParticles& particles, int kind, const BondRows& rows,
  const granular_bonds_shift* shift, double* buffer)
{
  const BondMessage& message = message_of(kind);
  const bool moves =
    shift != nullptr && std::ranges::any_of(shift->counts, [](int count) { return count != 0; });
  if (moves && routine_of(kind) > GRANULAR_BONDS_BORDER_VELOCITY)
  {
    throw BadBondArgument("expected no shift of a message without copies of positions");
  }
  if (routine_of(kind) == GRANULAR_BONDS_EXCHANGE)
  {
    return pack_exchange(particles, message, rows, buffer);
  }
  message.put(particles.arrays(), rows, buffer);
  if (moves)
  {
    move(particles, kind, rows, *shift, buffer);
  }
}

std::size_t unpack(BondedParticles& particles, int kind, std::size_t first,
  const std::int32_t* list, std::span<const double> buffer)
{
  const BondMessage& message = message_of(kind);
  const int routine = routine_of(kind);
  const std::size_t size = particles.size();
  const bool adds = routine == GRANULAR_BONDS_EXCHANGE;
  if (list == nullptr && (first > size || (adds && first < size)))
  {
    throw BadBondArgument("expected a first row of " + std::string(adds ? "" : "at most ") +
      std::to_string(size) + ", got " + std::to_string(first));
  }
  if (list != nullptr && routine != GRANULAR_BONDS_REVERSE)
  {
    throw BadBondArgument("expected a list of rows for forces alone");
  }
  if (adds)
  {
    return unpack_exchange(particles, message, buffer);
  }
  const std::size_t count = buffer.size() / message.doubles;
  if (count * message.doubles != buffer.size())
  {
    throw FormatError("expected " + std::to_string(message.doubles) +
      " doubles of each particle, got " + std::to_string(buffer.size()));
  }
  if (routine == GRANULAR_BONDS_REVERSE)
  {
    add_forces(particles, { first, count, list }, buffer.data());
  }
  else
  {
    unpack_rows(particles, message, first, count, buffer);
  }
  return count;
}
}
