// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/number_cells.h"

#include "granular/numbers/number_print_few.h"
#include "granular/numbers/six_digits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace granular
{
namespace
{
constexpr std::int64_t ahead = 256; ///< so many numbers later they are fetched from memory, early

/// A loop of its own for each kind of number, so that what is the same for all is asked once.
template <class Number, class Print>
[[gnu::always_inline]] inline void print_all(const Number* from, std::int64_t step,
  std::size_t count, const NumberCells& to, Print&& print) noexcept
{
  const NumberCells cells = to; // not read again after each character
  char* cell = cells.text;
  std::uint8_t* length = cells.lengths;
  for (std::size_t i = 0; i < count; ++i)
  {
    __builtin_prefetch(from + ahead * step);
    char* const end = print(cell, *from);
    std::memcpy(end, cells.end.data(), cells.end.size());
    *length = static_cast<std::uint8_t>(end - cell + cells.end_chars);
    from += step;
    cell += cells.step * most_number_chars;
    length += cells.step;
  }
}

constexpr int few = 6;

char* print_few(char* cell, double value) noexcept
{
  using namespace number_print;
  const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(value) & ~sign_bit;
  if (is_usual(magnitude)) [[likely]]
  {
    const Rounded rounded = round_few(magnitude, few);
    if (rounded.sure) [[likely]]
    {
      return lay_out_few(cell, value, rounded, few);
    }
  }
  return print_number(cell, value, { few });
}

/// Prints numbers whose digits are found together.
void print_together(
  const double* from, std::int64_t step, std::size_t count, const NumberCells& to) noexcept
{
  using number_print::SixDigits;
  SixDigits numbers;
  for (std::size_t first = 0; first < count; first += SixDigits::most)
  {
    const std::size_t some = std::min(SixDigits::most, count - first);
    for (std::size_t i = 0; i < some; ++i, from += step)
    {
      __builtin_prefetch(from + ahead * step);
      numbers.values[i] = *from;
    }
    find_six_digits(numbers, some);
    NumberCells cells = to;
    cells.text += first * to.step * most_number_chars;
    cells.lengths += first * to.step;
    print_all(numbers.values.data(), 1, some, cells,
      [&numbers, i = std::size_t{ 0 }](char* cell, double value) mutable
      {
        const std::size_t at = i++;
        return numbers.k[at] != SixDigits::not_found
          ? number_print::lay_out_six(
              cell, value, numbers.digits[at], static_cast<int>(numbers.k[at]))
          : print_few(cell, value);
      });
  }
}
}

void print_numbers(const double* from, std::int64_t step, std::size_t count, NumberFormat format,
  bool whole, const NumberCells& to, Simd simd) noexcept
{
  constexpr double most_exact = 9007199254740992.0; // 2^53
  constexpr std::size_t many = 4;                   // fewer are printed as fast one by one
  if (whole)
  {
    print_all(from, step, count, to,
      [format](char* cell, double value)
      {
        return std::abs(value) < most_exact && std::trunc(value) == value
          ? number_print::print_whole(cell, static_cast<std::int64_t>(value))
          : print_number(cell, value, format);
      });
  }
  else if (format != NumberFormat{ few })
  {
    print_all(from, step, count, to,
      [format](char* cell, double value) { return print_number(cell, value, format); });
  }
  else if (simd == Simd::Portable || count < many)
  {
    print_all(from, step, count, to, print_few);
  }
  else
  {
    print_together(from, step, count, to);
  }
}

void print_integers(
  const std::int32_t* from, std::int64_t step, std::size_t count, const NumberCells& to) noexcept
{
  print_all(from, step, count, to,
    [](char* cell, std::int32_t value) { return number_print::print_whole(cell, value); });
}

void print_integers(
  const std::int64_t* from, std::int64_t step, std::size_t count, const NumberCells& to) noexcept
{
  print_all(from, step, count, to,
    [](char* cell, std::int64_t value) { return number_print::print_whole(cell, value); });
}
}
