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

/// Finds six digits of the first `count` values, rounded as by printf's %.6g, without signs; 0 has six zeros and k = 0. k is
/// not_found for nan, for other magnitudes below 2^-33 or from 10^6 on, and where the value times a power of ten rounds to
/// exactly half. Values from `count` up to a multiple of four may be overwritten. Needs AVX2.
void find_six_digits(SixDigits& numbers, std::size_t count) noexcept;
}
#endif
