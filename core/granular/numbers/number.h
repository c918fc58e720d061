// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_number_h
#define granular_numbers_number_h

#include <cstdint>
#include <system_error>

namespace granular
{
/// The place where parsing stopped, and the reason. ec is std::errc{} or std::errc::invalid_argument.
struct ParseResult
{
  const char* ptr;
  std::errc ec;

  explicit operator bool() const noexcept { return ec == std::errc{}; }
};

/// Parses the whole of [first, last) as a decimal floating-point number.
///
/// Gives the nearest double, ties to even, as strtod does in the C locale. Too large numbers become infinite, too small
/// ones zero or subnormal. Accepts a leading '+', nan and inf in any case with an optional sign, and the forms that old
/// Microsoft run-time libraries print (1.#QNAN, -1.#IND, 1.#INF, 1.#SNAN, with any trailing digits). Refuses
/// hexadecimal numbers. Never allocates and ignores the locale. On failure value is unchanged.
ParseResult parse_double(const char* first, const char* last, double& value) noexcept;

/// Parses the whole of [first, last) as a decimal integer with an optional sign. Accepts a point or an exponent if the
/// value is an integer. Fails if the value does not fit. On failure value is unchanged.
ParseResult parse_int64(const char* first, const char* last, std::int64_t& value) noexcept;

/// Computes times from timesteps.
class StepClock
{
public:
  /// step_size: the time of one step; finite, greater than 0.
  explicit StepClock(double step_size) noexcept;

  /// Returns the double nearest to step times the shortest decimal number that reads back as step_size, ties to even;
  /// infinite if the product is too large. Three steps of 1e-05 give 3e-05, whereas the product of the two doubles is
  /// 3.0000000000000004e-05.
  double time(std::int64_t step) const noexcept;

private:
  std::uint64_t digits_; ///< at most 17
  int power_;            ///< of ten
};
}
#endif
