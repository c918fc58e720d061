// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_bond_record_h
#define granular_bonds_bond_record_h

#include "granular/common/error.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// Where things are in the record of a particle in a restart file, in doubles from its begin: first what all atom styles have,
/// then what bond/gran adds. Source: pack_restart of LIGGGHTS' atom styles.
struct RecordSlots
{
  static constexpr std::size_t length = 0; ///< of the record, in doubles, itself among them
  static constexpr std::size_t x = 1;      ///< x y z
  static constexpr std::size_t tag = 4;
  static constexpr std::size_t type = 5;
  static constexpr std::size_t mask = 6;
  static constexpr std::size_t image = 7;
  static constexpr std::size_t v = 8;       ///< x y z
  static constexpr std::size_t common = 11; ///< how many doubles all styles have

  static constexpr std::size_t molecule = 11;
  static constexpr std::size_t bonds = 12; ///< how many
  static constexpr std::size_t first_bond =
    13; ///< type and partner of each; then, if n_h > 0, n_h and the history
};

/// A double that is a length, a whole number from least to most; 0: it is none.
inline std::size_t length_of(double number, std::size_t least, std::size_t most) noexcept
{
  const bool in_range = number >= static_cast<double>(least) && number <= static_cast<double>(most);
  const std::size_t length = in_range ? static_cast<std::size_t>(number) : 0;
  return static_cast<double>(length) == number ? length : 0;
}

/// How whole numbers stand in doubles.
enum class WholeNumbers : std::uint8_t
{
  Values, ///< as doubles that have this value
  Bits    ///< as the bits of 64-bit integers
};

/// The form of the tag, type and mask of a record, which is the same for these three. The type tells: as a value it is at least 1,
/// as bits it is a double next to 0. Throws FormatError, with what was got, if it is neither.
WholeNumbers whole_numbers_of(std::span<const double> block);

/// A whole number out of a double. Throws FormatError if it is none, or no 64-bit integer.
std::int64_t to_whole(double number, WholeNumbers form);

/// The same of 32 bits; name is for the error: "a bond type". Throws FormatError.
std::int32_t to_int32(double number, WholeNumbers form, const char* name);

/// The counts of an image: fields of so many bits (10 where ids have 4 bytes, 21 where they have 8), biased by half of their
/// range, x lowest; the third has the bits that are left.
struct ImageCounts
{
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  bool operator==(const ImageCounts&) const = default;
};

ImageCounts unpack_image(std::int64_t image, int field_bits) noexcept;

/// Throws LimitError if a count does not fit into the field: -512 to 511 of 10 bits, -2^20 to 2^20 - 1 of 21.
std::int64_t pack_image(const ImageCounts& counts, int field_bits);

/// The bonds in the block of bond/gran, seen where they are.
struct BondBlock
{
  std::int64_t bonds = 0;          ///< b
  std::int64_t history_values = 0; ///< n_h; 0: none are stored
  const double* pairs = nullptr;   ///< b times type and partner, as values
  const double* history = nullptr; ///< b times n_h
  std::size_t size = 0;            ///< doubles of the block, from its length word on
};

/// Looks at a block that begins at its length word. `length` is how long it is: that of its own word, or, of a record of this style
/// alone, at most that, as what fixes have added comes behind; may_have_more says which. history_values is that of other records of
/// the file, or -1: a particle without bonds may leave open whether n_h is stored, then it is not if the next double is not it.
/// Throws FormatError: b is no whole number from 0 to most_bonds, n_h is not that of the others, the block is too short or too
/// long for what it says. The errors name the double of the record at which it is wrong.
BondBlock look_at_bonds(std::span<const double> block, bool may_have_more,
  std::int64_t history_values, std::int64_t most_bonds);
}
#endif
