// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_six_digits_h
#define granular_numbers_six_digits_h

// Numbers of six digits, several at once. Only for number_cells.cpp.

#include "granular/common/simd.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace granular::number_print
{
/// Numbers, and their six digits.
struct SixDigits
{
  static constexpr std::size_t most = 64;
  static constexpr std::int64_t not_found = std::numeric_limits<std::int64_t>::min();

  alignas(64) std::array<double, most> values;
  alignas(64) std::array<std::uint64_t,
    most> digits; ///< one per byte, the first in the lowest; and two zeros
  alignas(
    64) std::array<std::int64_t, most> k; ///< the first digit has the weight 10^k; or not_found
};

/// Finds the digits of the first `count` values, rounded as by printf's %.6g. Those of numbers that are not between 2^-33 and
/// 10^6, or look like halfway between two, are not found. simd must
/// not be Portable.
void find_six_digits(SixDigits& numbers, std::size_t count, Simd simd) noexcept;
}
#endif
