// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/exchange_packing.h"

#include "granular/bonds/pack_values.h"
#include "granular/numbers/number_print.h"

#include <algorithm>

namespace granular
{
namespace
{
/// Counts of special neighbours of three kinds, behind the history.
constexpr std::size_t special_counts = 3;

/// Doubles of a bond.
std::size_t bond_doubles(const BondedParticles& particles) noexcept
{
  return 2 + static_cast<std::size_t>(particles.history_values());
}

/// Records of the particles of a dialect: length, fields, number of bonds, type and partner of each, history, special counts.
template <const auto& fields>
struct Records
{
  using Table = PackTable<fields>;

  static constexpr std::size_t bonds_at = 1 + Table::doubles;
  static constexpr std::size_t fixed = bonds_at + 1 + special_counts;

  static std::size_t doubles_of(const BondedParticles& particles, std::size_t row) noexcept
  {
    return fixed + static_cast<std::size_t>(particles.bonds()[row]) * bond_doubles(particles);
  }

  template <class Rows>
  static std::size_t count(const BondedParticles& particles, const Rows& rows) noexcept
  {
    std::size_t doubles = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      doubles += doubles_of(particles, rows[i]);
    }
    return doubles;
  }

  static double* put_bonds(const BondedParticles& particles, std::size_t row, double* to) noexcept
  {
    const auto types = particles.bond_types(row);
    const auto partners = particles.partners(row);
    *to++ = static_cast<double>(types.size());
    for (std::size_t k = 0; k < types.size(); ++k)
    {
      *to++ = types[k];
      *to++ = id_to_number(partners[k]);
    }
    const auto history = particles.history(row);
    if (!history.empty())
    {
      std::memcpy(to, history.data(), history.size_bytes());
    }
    return std::fill_n(to + history.size(), special_counts, 0.0);
  }

  template <class Rows>
  static void pack(const BondedParticles& particles, const Rows& rows, double* to)
  {
    const auto arrays = Table::arrays_of(particles);
    ExactNumbers numbers;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const std::size_t row = rows[i];
      try
      {
        Table::put(arrays, row, to + 1, numbers);
      }
      catch (const LimitError& error)
      {
        throw LimitError(error.text() + " of particle " + std::to_string(row));
      }
      *to = static_cast<double>(doubles_of(particles, row));
      to = put_bonds(particles, row, to + bonds_at);
    }
  }

  /// Where the next record begins, if there is nothing wrong with this one.
  static std::size_t check(const BondedParticles& particles, std::span<const double> buffer,
    std::size_t place, std::size_t particle)
  {
    const std::size_t room = buffer.size() - place;
    const double length = buffer[place];
    if (room < fixed || !(length >= fixed && length <= static_cast<double>(room)))
    {
      refuse_number("the length of a record from " + std::to_string(fixed) +
          " to the end, which is at double " + std::to_string(buffer.size()) + ",",
        particle, place, length);
    }
    Table::check(buffer, place + 1, particle);

    const double bonds = buffer[place + bonds_at];
    if (!(bonds >= 0 && bonds <= particles.most_bonds()) || !is_int32(bonds))
    {
      refuse_number("a number of bonds from 0 to " + std::to_string(particles.most_bonds()),
        particle, place + bonds_at, bonds);
    }
    const auto bond_count = static_cast<std::size_t>(bonds);
    const std::size_t needed = fixed + bond_count * bond_doubles(particles);
    if (length < static_cast<double>(needed))
    {
      refuse_length(particles, needed, bond_count, particle, place, length);
    }
    check_types(buffer, place + bonds_at + 1, bond_count, particle);
    check_special(buffer, place + needed - special_counts, particle);
    if (length != static_cast<double>(needed))
    {
      refuse_length(particles, needed, bond_count, particle, place, length);
    }
    return place + needed;
  }

  [[noreturn]] static void refuse_length(const BondedParticles& particles, std::size_t needed,
    std::size_t bonds, std::size_t particle, std::size_t place, double length)
  {
    refuse_number("the length " + std::to_string(needed) + " of a record of " +
        std::to_string(bonds) + " bonds with " + std::to_string(particles.history_values()) +
        " history values",
      particle, place, length);
  }

  static void check_types(
    std::span<const double> buffer, std::size_t place, std::size_t bonds, std::size_t particle)
  {
    for (std::size_t k = 0; k < bonds; ++k)
    {
      const double type = buffer[place + 2 * k];
      if (!is_int32(type))
      {
        refuse_number("a bond type, a whole number of 32 bits,", particle, place + 2 * k, type);
      }
    }
  }

  static void check_special(std::span<const double> buffer, std::size_t place, std::size_t particle)
  {
    for (std::size_t at = place; at < place + special_counts; ++at)
    {
      const double count = buffer[at];
      if (count > 0 && is_int32(count))
      {
        throw UnsupportedError("expected no special neighbours " + buffer_place(particle, at) +
          ", got " + to_text(count));
      }
      if (count != 0)
      {
        refuse_number("a number of special neighbours", particle, at, count);
      }
    }
  }

  static const double* get_bonds(const double* from, BondedParticles& particles, std::size_t row)
  {
    particles.set_bonds(row, static_cast<std::size_t>(*from++));
    const auto types = particles.bond_types(row);
    const auto partners = particles.partners(row);
    for (std::size_t k = 0; k < types.size(); ++k)
    {
      types[k] = static_cast<std::int32_t>(*from++);
      partners[k] = number_to_id(*from++);
    }
    const auto history = particles.history(row);
    std::copy_n(from, history.size(), history.begin());
    return from + history.size() + special_counts;
  }

  static std::size_t unpack(std::span<const double> buffer, BondedParticles& particles)
  {
    std::size_t count = 0;
    for (std::size_t place = 0; place < buffer.size(); ++count)
    {
      place = check(particles, buffer, place, count);
    }
    const std::size_t first = particles.size();
    particles.resize(first + count, Table::set);
    const auto arrays = Table::arrays_of(particles);
    const double* from = buffer.data();
    for (std::size_t row = first; row < first + count; ++row)
    {
      Table::get(from + 1, arrays, row);
      from = get_bonds(from + bonds_at, particles, row);
    }
    return count;
  }
};

using PfmRecords = Records<pack_tables::exchange_pfm>;
using PlainRecords = Records<pack_tables::exchange_plain>;

static_assert(PfmRecords::fixed == 22 && PlainRecords::fixed == 16);

/// Calls work with the records of a dialect.
template <class Work>
auto with_records(PackDialect dialect, const Work& work)
{
  return dialect == PackDialect::Pfm ? work(PfmRecords{}) : work(PlainRecords{});
}
}

std::size_t exchange_doubles(
  const BondedParticles& particles, PackDialect dialect, const ParticleRows& rows)
{
  expect_rows(particles, rows);
  return with_records(dialect,
    [&](auto records)
    { return std::visit([&](const auto& some) { return records.count(particles, some); }, rows); });
}

void pack_exchange(const BondedParticles& particles, PackDialect dialect, const ParticleRows& rows,
  std::span<double> buffer)
{
  expect_size(exchange_doubles(particles, dialect, rows), buffer.size());
  with_records(dialect,
    [&](auto records)
    { std::visit([&](const auto& some) { records.pack(particles, some, buffer.data()); }, rows); });
}

std::size_t unpack_exchange(
  BondedParticles& particles, PackDialect dialect, std::span<const double> buffer)
{
  return with_records(dialect, [&](auto records) { return records.unpack(buffer, particles); });
}
}
