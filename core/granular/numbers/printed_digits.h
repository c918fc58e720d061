// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_printed_digits_h
#define granular_numbers_printed_digits_h

#include <string_view>

namespace granular
{
/// Returns the significant digits of a real number as it is written; 0 of an integer, and of what is no number.
int digits_of_real(std::string_view word) noexcept;

/// Returns how far a number may be off because a program printed it with few digits: half a unit of the last one. Returns 0
/// for round numbers: those of fewer than the six digits of %g, and whole ones that it does not print or that end in 0.
double rounding_of(std::string_view word, double value) noexcept;
}
#endif
