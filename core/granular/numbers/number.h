// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_number_h
#define granular_numbers_number_h

#include <cstdint>
#include <system_error>

namespace granular
{
/// Where parsing stopped, and why. ec is std::errc{} or std::errc::invalid_argument.
struct ParseResult
{
  const char* ptr;
  std::errc ec;

  explicit operator bool() const noexcept { return ec == std::errc{}; }
};

/// Parses the whole of [first, last) as a decimal floating-point number.
///
/// Gives the nearest double, ties to even, as strtod does in the C locale; too large becomes
/// an infinity, too small a zero or a subnormal number. Accepts a leading '+', nan and inf in any
/// case with an optional sign, and what old Microsoft run-time libraries print for them
/// (1.#QNAN, -1.#IND, 1.#INF, 1.#SNAN, with any trailing digits). Hexadecimal is refused.
/// Never allocates, never looks at the locale. On failure value is left alone.
ParseResult parse_double(const char* first, const char* last, double& value) noexcept;

/// Parses the whole of [first, last) as a decimal integer with an optional sign.
/// A number that is written with a point or an exponent is accepted if its value is an integer.
/// Fails if the value does not fit. On failure value is left alone.
ParseResult parse_int64(const char* first, const char* last, std::int64_t& value) noexcept;
}
#endif
