// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_pack_values_h
#define granular_bonds_pack_values_h

#include "granular/bonds/exchange_packing.h"
#include "granular/bonds/pack_numbers.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <tuple>
#include <utility>

namespace granular
{
/// Throws FormatError: expected something else in a double of a buffer.
[[noreturn]] void refuse_number(
  const std::string& expected, std::size_t particle, std::size_t at, double got);

/// Returns the place for a message: "in double 3 of the buffer, of particle 0".
std::string buffer_place(std::size_t particle, std::size_t at);

/// Throws LimitError if a row is not that of a particle.
void expect_rows(const BondedParticles& particles, const ParticleRows& rows);

/// Throws LimitError if the buffer has another size than needed.
void expect_size(std::size_t needed, std::size_t size);

/// Returns the arrays of all fields, in the order of PackField.
template <class Particles>
auto arrays_of(Particles& particles) noexcept
{
  return std::tuple(particles.x().data(), particles.v().data(), particles.f().data(),
    particles.x_mol().data(), particles.v_mol().data(), particles.tag().data(),
    particles.type().data(), particles.mask().data(), particles.image().data(),
    particles.molecule().data());
}

/// A table of fields that is known at compile time, so that loops over it are unrolled.
template <const auto& fields>
struct PackTable
{
  static constexpr std::size_t doubles = doubles_of(std::span<const PackField>(fields));
  static constexpr PackFieldSet set = set_of(std::span<const PackField>(fields));

  /// Calls visit(k) with the index of each field as a constant.
  template <class Visit>
  static constexpr void for_each(const Visit& visit)
  {
    [&]<std::size_t... k>(std::index_sequence<k...>)
    {
      (visit(std::integral_constant<std::size_t, k>{}), ...);
    }
    (std::make_index_sequence<fields.size()>{});
  }

  /// Returns the arrays of the fields, in the order of the table.
  template <class Particles>
  static auto arrays_of(Particles& particles) noexcept
  {
    const auto all = granular::arrays_of(particles);
    return [&]<std::size_t... k>(std::index_sequence<k...>)
    {
      return std::tuple(std::get<static_cast<std::size_t>(fields[k])>(all)...);
    }
    (std::make_index_sequence<fields.size()>{});
  }

  /// The index of a field's first double.
  template <std::size_t k>
  static constexpr std::size_t offset = doubles_of(std::span<const PackField>(fields).first(k));

  template <class Arrays, class Numbers>
  static void put(const Arrays& arrays, std::size_t row, double* to, Numbers& numbers)
  {
    for_each(
      [&](auto k)
      {
        if constexpr (is_vector(fields[k]))
        {
          std::memcpy(to + offset<k>, &std::get<k>(arrays)[row], sizeof(Vector3));
        }
        else
        {
          to[offset<k>] = numbers.to_number(std::get<k>(arrays)[row]);
        }
      });
  }

  template <class Arrays>
  static void get_vectors(const double* from, const Arrays& arrays, std::size_t row) noexcept
  {
    for_each(
      [&](auto k)
      {
        if constexpr (is_vector(fields[k]))
        {
          std::memcpy(&std::get<k>(arrays)[row], from + offset<k>, sizeof(Vector3));
        }
      });
  }

  /// Unpacks doubles that have been checked.
  template <class Arrays>
  static void get(const double* from, const Arrays& arrays, std::size_t row) noexcept
  {
    get_vectors(from, arrays, row);
    for_each(
      [&](auto k)
      {
        if constexpr (!is_vector(fields[k]))
        {
          ExactNumbers::from_number(from[offset<k>], std::get<k>(arrays)[row]);
        }
      });
  }

  /// Returns bits that are set if types or masks may be invalid.
  static std::uint64_t look_at_integers(const double* from) noexcept
  {
    std::uint64_t doubts = 0;
    for_each(
      [&](auto k)
      {
        if constexpr (fields[k] == PackField::Type || fields[k] == PackField::Mask)
        {
          doubts |= difference(low_integer(from[offset<k>]), from[offset<k>]);
        }
      });
    return doubts;
  }

  /// Throws FormatError at the first invalid double of the particle that begins at index place of the buffer.
  static void check(std::span<const double> buffer, std::size_t place, std::size_t particle)
  {
    for_each(
      [&](auto k)
      {
        const std::size_t at = place + offset<k>;
        if constexpr (fields[k] == PackField::Type || fields[k] == PackField::Mask)
        {
          if (!is_int32(buffer[at])) [[unlikely]]
          {
            refuse_number("a whole number of 32 bits", particle, at, buffer[at]);
          }
        }
        else if constexpr (fields[k] == PackField::Image)
        {
          if (number_to_id(buffer[at]) < 0) [[unlikely]]
          {
            refuse_number("an image of three counts of 21 bits", particle, at, buffer[at]);
          }
        }
      });
  }
};
}
#endif
