// SPDX-License-Identifier: BSD-3-Clause
// The functions of granular_bonds.h that pack and unpack, for objects that are there.
#ifndef granular_bonds_packing_h
#define granular_bonds_packing_h

#include "particles.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace granular
{
/// Rows `first`, first + 1, ... or, with a list, list[first], list[first + 1], ...
struct BondRows
{
  std::size_t first = 0;
  std::size_t count = 0;
  const std::int32_t* list = nullptr;

  std::size_t operator[](std::size_t i) const noexcept
  {
    return list != nullptr ? static_cast<std::size_t>(list[first + i]) : first + i;
  }
};

/// The fields that a routine of the atom style bond/gran sends for a particle, as functions in which they are unrolled.
struct BondMessage
{
  std::size_t doubles;      ///< of a particle
  std::uint32_t set;        ///< of its fields
  std::size_t velocity = 0; ///< the position of v; 0: it is not sent

  /// Writes some rows. Throws LimitError for an image count beyond 21 bits.
  void (*put)(const granular_bonds_arrays& arrays, const BondRows& rows, double* to);

  /// Throws FormatError for a type, mask or image that is none, in `count` particles of a buffer from the double `place` on; the
  /// first of them is called `particle`.
  void (*check)(
    std::span<const double> buffer, std::size_t place, std::size_t particle, std::size_t count);

  /// Reads what has been checked into consecutive rows.
  void (*get)(const granular_bonds_arrays& arrays, std::size_t first, std::size_t count,
    const double* from) noexcept;
};

/// Returns the message of a kind of granular_bonds.h.
const BondMessage& message_of(int kind);

constexpr int routine_of(int kind) noexcept
{
  return kind & ~GRANULAR_BONDS_WITH_BONDS;
}

bool is_int32(double number) noexcept;

/// Throws FormatError: expected something else in a double of a buffer.
[[noreturn]] void refuse_number(
  const std::string& expected, std::size_t particle, std::size_t at, double got);

/// Returns the place for a message: "in double 3 of the buffer, of its particle 0".
std::string buffer_place(std::size_t particle, std::size_t at);

// ids as doubles

/// Ids up to this magnitude are doubles of the same value: 2^53.
inline constexpr std::int64_t largest_id_value = std::int64_t{ 1 } << 53;

constexpr bool is_id_value(std::int64_t id) noexcept
{
  return id >= -largest_id_value && id <= largest_id_value;
}

/// Returns true if the double is an exact integer id (magnitude at most 2^53, not -0.0).
constexpr bool is_id_value(double number) noexcept
{
  constexpr auto largest = static_cast<double>(largest_id_value);
  constexpr auto minus_zero = std::uint64_t{ 1 } << 63;
  // The comparison is false of what is not a number, and the conversion then never done. With -fno-trapping-math GCC may make one
  // rounding of both conversions, which keeps the sign of -0.0: it is looked for by its bits.
  return number >= -largest && number <= largest &&
    static_cast<double>(static_cast<std::int64_t>(number)) == number &&
    std::bit_cast<std::uint64_t>(number) != minus_zero;
}

/// Returns an id as a double for a buffer: up to 2^53 as its value, as codes with 32-bit ids send it; beyond as its bits.
///
/// Some large ids have the bits of a double that is the value of a small id: 4607182418800017408 has those of 1. Such an id
/// changes places with the small one: it gets the bits of the integer 1, which no other id has. So each of the 2^64 ids has a
/// double of its own and comes back from it, and each double is an id. The double may be a signalling nan: copy it, do not
/// calculate.
constexpr double id_to_number(std::int64_t id) noexcept
{
  if (is_id_value(id))
  {
    return static_cast<double>(id);
  }
  const auto number = std::bit_cast<double>(id);
  return is_id_value(number) ? std::bit_cast<double>(static_cast<std::int64_t>(number)) : number;
}

/// Returns the id of such a double.
constexpr std::int64_t number_to_id(double number) noexcept
{
  if (is_id_value(number))
  {
    return static_cast<std::int64_t>(number);
  }
  const auto bits = std::bit_cast<std::int64_t>(number);
  return is_id_value(bits) ? std::bit_cast<std::int64_t>(static_cast<double>(bits)) : bits;
}

// messages, by a kind of granular_bonds.h

std::size_t packed_doubles(const BondedParticles& particles, int kind, const BondRows& rows);
void pack(const BondedParticles& particles, int kind, const BondRows& rows,
  const granular_bonds_shift* shift, double* buffer);

/// Returns the number of particles.
std::size_t unpack(BondedParticles& particles, int kind, std::size_t first,
  const std::int32_t* list, std::span<const double> buffer);

// records of restart files

std::size_t record_doubles(const BondedParticles& particles, std::size_t row);
void pack_record(const BondedParticles& particles, std::size_t row, const granular_bonds_form& form,
  std::span<const double> fixes, double* record);

/// Returns the doubles of the record.
std::size_t unpack_record(BondedParticles& particles, const granular_bonds_form& form,
  std::size_t fix_count, std::span<const double> chunk);
}
#endif
