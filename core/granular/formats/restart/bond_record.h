// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_bond_record_h
#define granular_formats_restart_bond_record_h

#include "granular/common/error.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// The positions in the record of a particle in a restart file, in doubles from its beginning: first the common part of all
/// atom styles, then that of bond/gran. Source: pack_restart of LIGGGHTS' atom styles.
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

/// Returns a double as a length, an integer from least to most; 0: it is none.
inline std::size_t length_of(double number, std::size_t least, std::size_t most) noexcept
{
  const bool in_range = number >= static_cast<double>(least) && number <= static_cast<double>(most);
  const std::size_t length = in_range ? static_cast<std::size_t>(number) : 0;
  return static_cast<double>(length) == number ? length : 0;
}

/// The form of integers in doubles.
enum class WholeNumbers : std::uint8_t
{
  Values, ///< as doubles that have this value
  Bits    ///< as the bits of 64-bit integers
};

/// Returns the common form of the tag, type and mask of a record. The type tells: as a value it is at least 1, as bits it is
/// a double next to 0. Throws FormatError with the number if it is neither.
WholeNumbers whole_numbers_of(std::span<const double> block);

/// Returns the integer in a double. Throws FormatError if there is none, or if it exceeds 64 bits.
std::int64_t to_whole(double number, WholeNumbers form);

/// Returns the integer of 32 bits in a double; name is for the error: "a bond type". Throws FormatError.
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

/// Packs three image counts. Throws LimitError if a count does not fit into its field: -512 to 511 for 10 bits, -2^20 to 2^20
/// - 1 for 21.
std::int64_t pack_image(const ImageCounts& counts, int field_bits);

/// The bonds in the block of bond/gran, or of another style, as a view.
struct BondBlock
{
  std::int64_t bonds = 0;          ///< b
  std::int64_t history_values = 0; ///< n_h; 0: none are stored
  const double* pairs = nullptr;   ///< b times type and partner
  const double* history = nullptr; ///< b times n_h
  std::size_t size = 0;            ///< doubles of the block, from its length word on
  WholeNumbers form =
    WholeNumbers::Values; ///< of types and partners; others than bond/gran have any
};

/// Views a block that begins at its length word. `length` is the length of the block: from its own word, or, for a record of
/// this style alone, an upper limit, because the data of fixes follow; may_have_more tells which. history_values is that of
/// other records of the file, or -1. A particle without bonds may leave open whether n_h is stored; it is not if the next
/// double differs from it. Throws FormatError if b is not an integer from 0 to most_bonds, n_h differs from the others, or
/// the block is too short or too long. The errors name the wrong double of the record.
BondBlock look_at_bonds(std::span<const double> block, bool may_have_more,
  std::int64_t history_values, std::int64_t most_bonds);
}
#endif
