// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_printed_digits_h
#define granular_numbers_printed_digits_h

#include <string_view>

namespace granular
{
/// Returns the significant digits of a real number as it is written; 0 of an integer, and of what is no number.
int digits_of_real(std::string_view word) noexcept;

/// Returns the digits of a number before an exponent, from the first that is not 0.
int digits_of(std::string_view word) noexcept;

/// The digits of %g, with which LIGGGHTS prints bounds.
constexpr int fewest_digits = 6;

/// Returns how far a number of six digits may be off because %g printed it: half a unit of the last one. Returns 0 for others,
/// and for whole ones that end in 0.
double rounding_of(std::string_view word, double value) noexcept;
}
#endif
