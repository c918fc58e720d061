// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_pack_values_h
#define granular_bonds_pack_values_h

#include "granular/bonds/exchange_packing.h"
#include "granular/bonds/id_numbers.h"

#include <bit>
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

/// Added to this, a number becomes one whose last bits are those of the nearest integer: a conversion that is defined for all
/// doubles, and without a branch.
inline constexpr double integer_bias = 0x1.8p52;

/// A double of an integer of 32 bits as that integer; of any other double some integer.
inline std::int32_t low_integer(double number) noexcept
{
  return static_cast<std::int32_t>(
    static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number + integer_bias)));
}

inline bool is_int32(double number) noexcept
{
  return static_cast<double>(low_integer(number)) == number;
}

inline std::uint64_t difference(double a, double b) noexcept
{
  return std::bit_cast<std::uint64_t>(a) ^ std::bit_cast<std::uint64_t>(b);
}

/// Bits of an image count in a buffer.
inline constexpr int buffer_image_bits = 21;

/// For the values that nearly all have, without a branch: what they add to `doubts` is 0. Else the result may be wrong, and all is
/// done again by the exact ones.
struct FastNumbers
{
  std::uint64_t doubts = 0;

  double to_number(std::int64_t id) noexcept
  {
    constexpr std::int64_t limit = std::int64_t{ 1 } << 52;
    doubts |= (static_cast<std::uint64_t>(id) + limit) >> 53;
    return static_cast<double>(id);
  }
  double to_number(std::int32_t value) noexcept { return value; }
  double to_number(const ImageCounts& counts)
  {
    return id_to_number(pack_image(counts, buffer_image_bits));
  }

  void from_number(double number, std::int64_t& id) noexcept
  {
    const double biased = number + integer_bias;
    const auto bits = std::bit_cast<std::uint64_t>(biased);
    constexpr auto bias = std::bit_cast<std::uint64_t>(integer_bias);
    doubts |= difference(biased - integer_bias, number) | (bits ^ bias) >> 52;
    id = static_cast<std::int64_t>(bits - bias);
  }
  void from_number(double number, std::int32_t& value) noexcept
  {
    value = low_integer(number);
    doubts |= difference(value, number);
  }
  void from_number(double number, ImageCounts& counts) noexcept
  {
    counts = unpack_image(number_to_id(number), buffer_image_bits);
  }
};

/// For all values.
struct ExactNumbers
{
  static double to_number(std::int64_t id) noexcept { return id_to_number(id); }
  static double to_number(std::int32_t value) noexcept { return value; }
  static double to_number(const ImageCounts& counts)
  {
    return id_to_number(pack_image(counts, buffer_image_bits));
  }

  static void from_number(double number, std::int64_t& id) noexcept { id = number_to_id(number); }
  static void from_number(double number, std::int32_t& value) noexcept
  {
    value = low_integer(number);
  }
  static void from_number(double number, ImageCounts& counts) noexcept
  {
    counts = unpack_image(number_to_id(number), buffer_image_bits);
  }
};

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

  /// What is there has no fault.
  template <class Arrays, class Numbers>
  static void get(
    const double* from, const Arrays& arrays, std::size_t row, Numbers& numbers) noexcept
  {
    for_each(
      [&](auto k)
      {
        if constexpr (is_vector(fields[k]))
        {
          std::memcpy(&std::get<k>(arrays)[row], from + offset<k>, sizeof(Vector3));
        }
        else
        {
          numbers.from_number(from[offset<k>], std::get<k>(arrays)[row]);
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
          const double number = buffer[place + offset<k>];
          if (const char* const expected = fault_of<fields[k]>(number)) [[unlikely]]
          {
            refuse_number(expected, particle, place + offset<k>, number);
          }
        }
      });
  }
};
}
#endif
