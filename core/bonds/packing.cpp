// SPDX-License-Identifier: BSD-3-Clause
#include "packing.h"

#include "granular/numbers/number_print.h"
#include <algorithm>
#include <array>

namespace granular
{
namespace
{
constexpr std::size_t special_counts = 3;

/// The position of the number of bonds in a record.
std::size_t bonds_at(const BondMessage& message) noexcept
{
  return 1 + message.doubles;
}

std::size_t doubles_of(
  const BondedParticles& particles, const BondMessage& message, std::size_t bonds) noexcept
{
  return bonds_at(message) + 1 + bonds * (2 + particles.history_values()) + special_counts;
}

double* put_bonds(const BondedParticles& particles, std::size_t row, double* to) noexcept
{
  const std::size_t bonds = particles.bonds(row);
  const auto* const types = particles.bond_types(row);
  const auto* const partners = particles.partners(row);
  *to++ = static_cast<double>(bonds);
  for (std::size_t k = 0; k < bonds; ++k)
  {
    *to++ = types[k];
    *to++ = id_to_number(partners[k]);
  }
  to = std::copy_n(particles.history(row), bonds * particles.history_values(), to);
  return std::fill_n(to, special_counts, 0.0);
}

const double* get_bonds(BondedParticles& particles, std::size_t row, const double* from)
{
  const auto bonds = static_cast<std::size_t>(*from++);
  particles.set_bonds(row, bonds);
  auto* const types = particles.bond_types(row);
  auto* const partners = particles.partners(row);
  for (std::size_t k = 0; k < bonds; ++k)
  {
    types[k] = static_cast<std::int32_t>(*from++);
    partners[k] = number_to_id(*from++);
  }
  const std::size_t values = bonds * particles.history_values();
  std::copy_n(from, values, particles.history(row));
  return from + values + special_counts;
}

void check_special(std::span<const double> buffer, std::size_t place, std::size_t particle)
{
  for (std::size_t at = place; at < place + special_counts; ++at)
  {
    const double count = buffer[at];
    if (count > 0 && is_int32(count))
    {
      throw UnsupportedError(
        "expected no special neighbours " + buffer_place(particle, at) + ", got " + to_text(count));
    }
    if (count != 0)
    {
      refuse_number("a number of special neighbours", particle, at, count);
    }
  }
}

/// Returns the position of the next record if there is nothing wrong with the one at `place`.
std::size_t check_record(const BondedParticles& particles, const BondMessage& message,
  std::span<const double> buffer, std::size_t place, std::size_t particle)
{
  const std::size_t fixed = doubles_of(particles, message, 0);
  const std::size_t room = buffer.size() - place;
  const double length = buffer[place];
  if (room < fixed ||
    !(length >= static_cast<double>(fixed) && length <= static_cast<double>(room)))
  {
    refuse_number("the length of a record from " + std::to_string(fixed) +
        " to the end, which is at double " + std::to_string(buffer.size()) + ",",
      particle, place, length);
  }
  message.check(buffer, place + 1, particle, 1);

  const std::size_t at = place + bonds_at(message);
  const double bonds = buffer[at];
  if (!(bonds >= 0 && bonds <= static_cast<double>(particles.most_bonds())) || !is_int32(bonds))
  {
    refuse_number(
      "a number of bonds from 0 to " + std::to_string(particles.most_bonds()), particle, at, bonds);
  }
  const auto count = static_cast<std::size_t>(bonds);
  const std::size_t needed = doubles_of(particles, message, count);
  if (length >= static_cast<double>(needed)) // else there may be no room for what comes next
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      if (!is_int32(buffer[at + 1 + 2 * k]))
      {
        refuse_number("a bond type, a whole number of 32 bits,", particle, at + 1 + 2 * k,
          buffer[at + 1 + 2 * k]);
      }
    }
    check_special(buffer, place + needed - special_counts, particle);
  }
  if (length != static_cast<double>(needed))
  {
    refuse_number("the length " + std::to_string(needed) + " of a record of " +
        std::to_string(count) + " bonds with " + std::to_string(particles.history_values()) +
        " history values",
      particle, place, length);
  }
  return place + needed;
}

std::size_t exchange_doubles(
  const BondedParticles& particles, const BondMessage& message, const BondRows& rows)
{
  std::size_t doubles = 0;
  for (std::size_t i = 0; i < rows.count; ++i)
  {
    doubles += doubles_of(particles, message, particles.bonds(rows[i]));
  }
  return doubles;
}

void pack_exchange(const BondedParticles& particles, const BondMessage& message,
  const BondRows& rows, double* buffer)
{
  for (std::size_t i = 0; i < rows.count; ++i)
  {
    const std::size_t row = rows[i];
    *buffer = static_cast<double>(doubles_of(particles, message, particles.bonds(row)));
    try
    {
      message.put(particles.arrays(), { row, 1 }, buffer + 1);
    }
    catch (const LimitError& error)
    {
      throw LimitError(error.text() + " of particle " + std::to_string(row));
    }
    buffer = put_bonds(particles, row, buffer + bonds_at(message));
  }
}

std::size_t unpack_exchange(
  BondedParticles& particles, const BondMessage& message, std::span<const double> buffer)
{
  std::size_t count = 0;
  for (std::size_t place = 0; place < buffer.size(); ++count)
  {
    place = check_record(particles, message, buffer, place, count);
  }
  const std::size_t first = particles.size();
  particles.resize(first + count, message.set);
  const double* from = buffer.data();
  for (std::size_t row = first; row < first + count; ++row)
  {
    message.get(particles.arrays(), row, 1, from + 1);
    from = get_bonds(particles, row, from + bonds_at(message));
  }
  return count;
}

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
