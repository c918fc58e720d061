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
/// Numbers and their digits. Digits are one per byte, the first in the lowest, and then two zeros; the first one has the weight
/// 10^k.
struct alignas(64) SixDigits
{
  static constexpr std::size_t most = 64;
  static constexpr std::int64_t not_found = std::numeric_limits<std::int64_t>::min(); ///< as k

  std::array<double, most> values;
  std::array<std::uint64_t, most> digits;
  std::array<std::int64_t, most> k;
};

/// Finds the digits of the first `count` values, rounded as by printf's %.6g. It leaves out numbers that are neither 0 nor between
/// 2^-33 and 10^6, and those that look like halfway between two: their k is not_found. simd must not be Portable.
void find_six_digits(SixDigits& numbers, std::size_t count, Simd simd) noexcept;
}
#endif
