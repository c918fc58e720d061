// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_decimal_h
#define granular_numbers_decimal_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace granular
{
/// The powers of ten that the digits of a double can need.
constexpr int smallest_power = -342;
constexpr int largest_power = 308;

/// Returns floor(log2(10^q)) for all these powers.
constexpr int binary_exponent(int q) noexcept
{
  return (217706 * q) >> 16;
}

/// 5^q, scaled by a power of two so that the highest of 128 bits is set: below the true value by less than one unit for
/// q >= 0, above it by at most one unit for q < 0. `high` alone is exact up to q = 27, both words up to q = 55.
struct PowerOfFive
{
  std::uint64_t high;
  std::uint64_t low;
};

/// The powers from smallest_power to largest_power.
extern const std::array<PowerOfFive, largest_power - smallest_power + 1> powers_of_five;

/// The bits of the smallest double that is not below 10^q, for normal doubles.
constexpr int smallest_normal_power = -307;
extern const std::array<std::uint64_t, largest_power - smallest_normal_power + 1> least_doubles;

/// 10^q / 2^binary_exponent(q), in [1, 2), as a sum of two doubles with a relative error of at most 2^-104.
struct PowerPair
{
  double high;
  double low;
};

extern const std::array<PowerPair, largest_power - smallest_power + 1> power_pairs;

/// Finds the double nearest to digits * 10^power, ties to even.
///
/// One multiplication of 64 by 64 bits, rarely two, with a power of five of 128 bits determines the double in almost
/// all cases (D. Lemire, "Number parsing at a gigabyte per second", Software: Practice and Experience 51, 2021).
/// Returns false and leaves value unchanged in the remaining cases, where the product is too near to the middle between
/// two doubles.
bool nearest_double(std::uint64_t digits, std::int64_t power, double& value) noexcept;

/// 10^0 to 10^22, the powers of ten that are exact doubles.
inline constexpr auto powers_of_ten = []
{
  std::array<double, 23> powers{};
  double power = 1;
  for (double& entry : powers)
  {
    entry = power;
    power *= 10;
  }
  return powers;
}();

/// Finds the nearest double like nearest_double; faster if both operands are exact, so that one operation rounds once.
inline bool to_double(std::uint64_t digits, std::int64_t power, double& value) noexcept
{
  if (digits >> 53 != 0 || power < -22 || power > 22)
  {
    return nearest_double(digits, power, value);
  }
  const auto whole = static_cast<double>(static_cast<std::int64_t>(digits));
  value = power < 0 ? whole / powers_of_ten[static_cast<std::size_t>(-power)]
                    : whole * powers_of_ten[static_cast<std::size_t>(power)];
  return true;
}
}
#endif
