// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_pack_numbers_h
#define granular_bonds_pack_numbers_h

#include "granular/bonds/bond_record.h"
#include "granular/bonds/id_numbers.h"
#include "granular/bonds/pack_fields.h"

#include <bit>
#include <cstdint>

namespace granular
{
/// Adding this to a double puts the nearest integer into the last bits of the sum: a conversion without a branch that
/// is defined for all doubles.
inline constexpr double integer_bias = 0x1.8p52;

/// Returns the 32-bit integer that the double holds; an arbitrary integer if the double holds none.
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

/// The number of bits of an image count in a buffer.
inline constexpr int buffer_image_bits = 21;

/// Converts values to doubles, and valid doubles back to values.
struct ExactNumbers
{
  static void join(const ExactNumbers&) noexcept {}

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

/// Converts like ExactNumbers, without branches, but only ids below 2^51 and other usual values. If doubtful() then
/// returns true, the result may be wrong and ExactNumbers must convert again.
class FastNumbers
{
public:
  double to_number(std::int64_t id) noexcept
  {
    ranges_ |= static_cast<std::uint64_t>(id) + limit;
    return static_cast<double>(id);
  }
  double to_number(std::int32_t value) noexcept { return value; }

  void from_number(double number, std::int64_t& id) noexcept
  {
    const double biased = number + integer_bias;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(biased) - bias;
    differences_ |= difference(biased - integer_bias, number);
    ranges_ |= bits + limit;
    id = static_cast<std::int64_t>(bits);
  }
  void from_number(double number, std::int32_t& value) noexcept
  {
    const double biased = number + integer_bias;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(biased) - bias;
    differences_ |= difference(biased - integer_bias, number);
    small_ranges_ |= bits + small_limit;
    value = static_cast<std::int32_t>(static_cast<std::uint32_t>(bits));
  }

  /// Takes over the doubts of another object.
  void join(const FastNumbers& other) noexcept
  {
    differences_ |= other.differences_;
    ranges_ |= other.ranges_;
    small_ranges_ |= other.small_ranges_;
  }

  bool doubtful() const noexcept
  {
    return differences_ != 0 || ranges_ >= 2 * limit || small_ranges_ >= 2 * small_limit;
  }

private:
  static constexpr std::uint64_t bias = std::bit_cast<std::uint64_t>(integer_bias);
  static constexpr std::uint64_t limit = std::uint64_t{ 1 } << 51;
  static constexpr std::uint64_t small_limit = std::uint64_t{ 1 } << 31;

  std::uint64_t differences_ = 0;
  std::uint64_t ranges_ = 0;
  std::uint64_t small_ranges_ = 0;
};
}
#endif
