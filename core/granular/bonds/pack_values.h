// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_pack_values_h
#define granular_bonds_pack_values_h

#include "granular/bonds/exchange_packing.h"
#include "granular/bonds/id_numbers.h"

#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace granular
{
/// Throws FormatError: expected something else in a double of a buffer.
[[noreturn]] void refuse_number(
  const std::string& expected, std::size_t particle, std::size_t at, double got);

/// "in double 3 of the buffer, of particle 0"
std::string buffer_place(std::size_t particle, std::size_t at);

/// Throws LimitError if not all rows are of particles.
void expect_rows(const BondedParticles& particles, const ParticleRows& rows);

/// Throws LimitError if a buffer is not of the size that is needed.
void expect_size(std::size_t needed, std::size_t size);

/// The array that a field is of.
template <PackField field, class Particles>
auto* array_of(Particles& particles) noexcept
{
  using enum PackField;
  if constexpr (field == X)
  {
    return particles.x().data();
  }
  else if constexpr (field == V)
  {
    return particles.v().data();
  }
  else if constexpr (field == F)
  {
    return particles.f().data();
  }
  else if constexpr (field == XMol)
  {
    return particles.x_mol().data();
  }
  else if constexpr (field == VMol)
  {
    return particles.v_mol().data();
  }
  else if constexpr (field == Tag)
  {
    return particles.tag().data();
  }
  else if constexpr (field == Type)
  {
    return particles.type().data();
  }
  else if constexpr (field == Mask)
  {
    return particles.mask().data();
  }
  else if constexpr (field == Image)
  {
    return particles.image().data();
  }
  else
  {
    static_assert(field == Molecule);
    return particles.molecule().data();
  }
}

/// Bits of an image count in a buffer.
inline constexpr int buffer_image_bits = 21;

inline double to_number(std::int64_t id) noexcept
{
  return id_to_number(id);
}
inline double to_number(std::int32_t value) noexcept
{
  return value;
}
inline double to_number(const ImageCounts& counts)
{
  return id_to_number(pack_image(counts, buffer_image_bits));
}

inline void from_number(double number, std::int64_t& id) noexcept
{
  id = number_to_id(number);
}
inline void from_number(double number, std::int32_t& value) noexcept
{
  value = static_cast<std::int32_t>(number);
}
inline void from_number(double number, ImageCounts& counts) noexcept
{
  counts = unpack_image(number_to_id(number), buffer_image_bits);
}

inline bool is_int32(double number) noexcept
{
  return number >= std::numeric_limits<std::int32_t>::min() &&
    number <= std::numeric_limits<std::int32_t>::max() &&
    static_cast<double>(static_cast<std::int32_t>(number)) == number;
}

/// What is wrong with the number of a field; null: nothing.
template <PackField field>
const char* fault_of(double number) noexcept
{
  if constexpr (field == PackField::Type || field == PackField::Mask)
  {
    return is_int32(number) ? nullptr : "a whole number of 32 bits";
  }
  else if constexpr (field == PackField::Image)
  {
    return number_to_id(number) >= 0 ? nullptr : "an image of three counts of 21 bits";
  }
  return nullptr;
}

/// A table of fields that is known when this is compiled, so that loops over it are none.
template <const auto& fields>
struct PackTable
{
  static constexpr std::size_t size = fields.size();
  static constexpr std::size_t doubles = doubles_of(std::span<const PackField>(fields));

  /// Calls visit(k) with the place of each field as a constant.
  template <class Visit>
  static constexpr void for_each(const Visit& visit)
  {
    [&]<std::size_t... k>(std::index_sequence<k...>)
    {
      (visit(std::integral_constant<std::size_t, k>{}), ...);
    }
    (std::make_index_sequence<size>{});
  }

  /// The arrays of the fields, in turn.
  template <class Particles>
  static auto arrays_of(Particles& particles) noexcept
  {
    return [&]<std::size_t... k>(std::index_sequence<k...>)
    {
      return std::tuple(array_of<fields[k]>(particles)...);
    }
    (std::make_index_sequence<size>{});
  }

  /// Where the doubles of a field are.
  static constexpr std::size_t offset_of(std::size_t k) noexcept
  {
    return doubles_of(std::span<const PackField>(fields).first(k));
  }

  template <class Arrays>
  static void put(const Arrays& arrays, std::size_t row, double* to)
  {
    for_each(
      [&](auto k)
      {
        if constexpr (is_vector(fields[k]))
        {
          std::memcpy(to + offset_of(k), &std::get<k>(arrays)[row], sizeof(Vector3));
        }
        else
        {
          to[offset_of(k)] = to_number(std::get<k>(arrays)[row]);
        }
      });
  }

  /// What is there has no fault.
  template <class Arrays>
  static void get(const double* from, const Arrays& arrays, std::size_t row) noexcept
  {
    for_each(
      [&](auto k)
      {
        if constexpr (is_vector(fields[k]))
        {
          std::memcpy(&std::get<k>(arrays)[row], from + offset_of(k), sizeof(Vector3));
        }
        else
        {
          from_number(from[offset_of(k)], std::get<k>(arrays)[row]);
        }
      });
  }

  /// Throws FormatError at the first fault of a particle whose doubles begin at a place of the buffer.
  static void check(std::span<const double> buffer, std::size_t place, std::size_t particle)
  {
    for_each(
      [&](auto k)
      {
        if constexpr (!is_vector(fields[k]))
        {
          const double number = buffer[place + offset_of(k)];
          if (const char* const expected = fault_of<fields[k]>(number)) [[unlikely]]
          {
            refuse_number(expected, particle, place + offset_of(k), number);
          }
        }
      });
  }
};
}
#endif
