// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_number_print_h
#define granular_numbers_number_print_h

#include "granular/common/simd.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace granular
{
/// The format of printed real numbers. digits 1 to 17: that many significant digits, with the bytes of printf's %.Ng in
/// the C locale. digits 0: the shortest decimal number that reads back as the same double, as std::to_chars(double)
/// gives it. exact: that many digits if they read back as the same double, otherwise as many more as needed.
struct NumberFormat
{
  int digits = 6;
  bool exact = false;

  bool operator==(const NumberFormat&) const = default;
};

/// The number of digits in the text that a number comes from, and more if needed; the shortest form for other numbers.
inline constexpr NumberFormat automatic_numbers = { 0, true };

/// Parses "Automatic", "%g", "%.Ng" with N from 1 to 17, or "shortest". Throws FormatError.
NumberFormat parse_number_format(std::string_view text);

/// Returns the text of a format: "%g", "%.9g", "shortest".
std::string to_text(NumberFormat format);

/// print_number may write to this many bytes from `to` on, whatever it prints.
inline constexpr std::size_t most_number_chars = 32;

/// Prints a number, with nan and inf as glibc prints them, and returns the end. Never allocates and ignores the locale.
/// format.digits must be 0 to 17.
char* print_number(char* to, double value, NumberFormat format) noexcept;

/// Returns the printed number, for messages: by default the shortest form.
std::string to_text(double value, NumberFormat format = { 0 });

/// Returns the number that is read back after printing value in this format.
double as_printed(double value, NumberFormat format) noexcept;

/// print_fixed may write this many bytes: sign, point and all digits of the largest number.
inline constexpr std::size_t most_fixed_chars = 320;

/// Prints a number with six decimals, with the bytes of printf's %f in the C locale, and returns the end.
char* print_fixed(char* to, double value) noexcept;

/// Returns the number that is read back after print_fixed.
double as_fixed(double value) noexcept;

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

/// Appends a line of words and integers.
template <class... Words>
void add_line(std::string& text, const Words&... words)
{
  const auto add = [&](const auto& word)
  {
    if constexpr (std::is_convertible_v<decltype(word), std::string_view>)
    {
      text += word;
    }
    else
    {
      text += std::to_string(word);
    }
  };
  (add(words), ...);
  text += '\n';
}
}
#endif
