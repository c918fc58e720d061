// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_number_print_h
#define granular_numbers_number_print_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace granular
{
/// How real numbers are printed. digits 1 to 17: that many significant digits, with the bytes of
/// printf's %.Ng in the C locale. 0: the shortest decimal number that reads back as the same
/// double, as std::to_chars(double) gives it. exact: with that many digits where these read back as the same
/// double, else with as many more as are needed.
struct NumberFormat
{
  int digits = 6;
  bool exact = false;

  bool operator==(const NumberFormat&) const = default;
};

/// The digits of the text that a number comes from, and more where it needs them; the shortest for a number that comes from none.
inline constexpr NumberFormat automatic_numbers = { 0, true };

/// "Automatic", "%g", "%.Ng" with N from 1 to 17, or "shortest". Throws FormatError.
NumberFormat parse_number_format(std::string_view text);

/// The same backwards: "%g", "%.9g", "shortest".
std::string to_text(NumberFormat format);

/// Both functions below may write to this many bytes from `to` on, whatever they print.
inline constexpr std::size_t most_number_chars = 32;

/// Prints a number, nan and inf as glibc does, and returns the end. Never allocates, never looks at
/// the locale. format.digits must be 0 to 17.
char* print_number(char* to, double value, NumberFormat format) noexcept;

/// The same, for messages: by default as the shortest that reads back.
std::string to_text(double value, NumberFormat format = { 0 });

/// The number that is read back where one is printed so.
double as_printed(double value, NumberFormat format) noexcept;

/// Bytes that the function below may write: sign, point and all digits of the largest number.
inline constexpr std::size_t most_fixed_chars = 320;

/// Prints a number with six decimals, with the bytes of printf's %f in the C locale, and returns the end.
char* print_fixed(char* to, double value) noexcept;

/// The number that is read back where one is printed so.
double as_fixed(double value) noexcept;

/// print_number for an integer, as %d.
char* print_integer(char* to, std::int64_t value) noexcept;
}
#endif
