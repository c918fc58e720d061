// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_number_cells_h
#define granular_numbers_number_cells_h

#include "granular/common/simd.h"
#include "granular/numbers/number_print.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace granular
{
/// Cells for the text of a column: each number into a cell of most_number_chars bytes, with what follows it. A number has at
/// most 24 characters.
struct NumberCells
{
  char* text;              ///< the first cell
  std::uint8_t* lengths;   ///< how much of each cell is used
  std::size_t step;        ///< cells from one number to the next
  std::array<char, 2> end; ///< what follows each number
  std::uint8_t end_chars;  ///< how much of it: 0 to 2
};

/// Prints `count` numbers that are `step` apart as print_number does. whole: integral ones below 2^53 have all their digits.
/// The text is the same for all instruction sets; simd must be one of this processor.
void print_numbers(const double* from, std::int64_t step, std::size_t count, NumberFormat format,
  bool whole, const NumberCells& to, Simd simd = best_simd()) noexcept;

/// Prints `count` integers that are `step` apart as %d does.
void print_integers(
  const std::int32_t* from, std::int64_t step, std::size_t count, const NumberCells& to) noexcept;
void print_integers(
  const std::int64_t* from, std::int64_t step, std::size_t count, const NumberCells& to) noexcept;
}
#endif
