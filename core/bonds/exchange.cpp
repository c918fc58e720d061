// SPDX-License-Identifier: BSD-3-Clause
// A record of a particle that changes its rank: length, fields, number of bonds, type and partner of each, history, and how many
// special neighbours of three kinds there are: none.
#include "packing.h"

#include "id_numbers.h"

#include "granular/numbers/number_print.h"

#include <algorithm>

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
}
