// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/decimal.h"

#include <bit>
#include <limits>

namespace granular
{
namespace
{
__extension__ using Wide = unsigned __int128;

/// A power in the tables.
constexpr std::size_t place(int q)
{
  return static_cast<std::size_t>(q - smallest_power);
}

/// A natural number of 1024 bits, lowest limb first; only for the table.
using Natural = std::array<std::uint32_t, 32>;

constexpr void multiply_by_five(Natural& n)
{
  std::uint64_t carry = 0;
  for (std::uint32_t& limb : n)
  {
    carry += std::uint64_t{ limb } * 5;
    limb = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
}

constexpr void divide_by_five(Natural& n)
{
  std::uint64_t rest = 0;
  for (std::size_t i = n.size(); i-- > 0;)
  {
    rest = rest << 32 | n[i];
    n[i] = static_cast<std::uint32_t>(rest / 5);
    rest %= 5;
  }
}

/// The highest 128 bits, the first of them set.
constexpr Wide leading_bits(const Natural& n)
{
  std::size_t top = n.size() - 1;
  while (n[top] == 0)
  {
    --top;
  }
  const auto limb = [&](std::size_t below) { return Wide{ below <= top ? n[top - below] : 0 }; };
  const int zeros = std::countl_zero(n[top]);
  const Wide bits = limb(0) << 96 | limb(1) << 64 | limb(2) << 32 | limb(3);
  return bits << zeros | limb(4) >> (32 - zeros);
}

constexpr std::uint64_t fraction_bits = (std::uint64_t{ 1 } << 52) - 1;

/// mantissa * 2^(exponent - 1023 - 53), rounded up where the last bit of the mantissa is set.
double round_last_bit(std::uint64_t mantissa, int exponent) noexcept
{
  if (exponent <= 0) // subnormal
  {
    mantissa = exponent > -63 ? mantissa >> (1 - exponent) : 0;
    exponent = 0;
  }
  mantissa = (mantissa + (mantissa & 1)) >> 1;
  if (mantissa >> 53 != 0)
  {
    mantissa >>= 1;
    ++exponent;
  }
  exponent += exponent == 0 ? static_cast<int>(mantissa >> 52) : 0; // became normal
  if (exponent >= 2047)
  {
    return std::numeric_limits<double>::infinity();
  }
  return std::bit_cast<double>(
    static_cast<std::uint64_t>(exponent) << 52 | (mantissa & fraction_bits));
}
}

constexpr std::array<PowerOfFive, place(largest_power) + 1> powers_of_five = []
{
  std::array<PowerOfFive, place(largest_power) + 1> table{};
  const auto set = [&](int q, Wide bits) {
    table[place(q)] = { static_cast<std::uint64_t>(bits >> 64), static_cast<std::uint64_t>(bits) };
  };
  Natural power{ 1 };
  for (int q = 0; q <= largest_power; ++q)
  {
    set(q, leading_bits(power));
    multiply_by_five(power);
  }
  Natural inverse{};
  inverse.back() = 0x80000000u; // 2^1023 leaves more than 128 bits after 342 divisions
  for (int q = -1; q >= smallest_power; --q)
  {
    divide_by_five(inverse); // the floor of floors is the floor of all
    set(q, leading_bits(inverse) + 1);
  }
  return table;
}();

constinit const std::array<std::uint64_t, largest_power - smallest_normal_power + 1> least_doubles =
  []
{
  std::array<std::uint64_t, largest_power - smallest_normal_power + 1> table{};
  for (int q = smallest_normal_power; q <= largest_power; ++q)
  {
    const std::uint64_t bits = powers_of_five[place(q)].high;
    const bool is_exact = q >= 0 && q <= 27 && bits % 2048 == 0;
    table[static_cast<std::size_t>(q - smallest_normal_power)] =
      (static_cast<std::uint64_t>(binary_exponent(q) + 1022) << 52) + (bits >> 11) +
      (is_exact ? 0 : 1);
  }
  return table;
}();

constinit const std::array<PowerPair, place(largest_power) + 1> power_pairs = []
{
  std::array<PowerPair, place(largest_power) + 1> table{};
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    const Wide bits = Wide{ powers_of_five[i].high } << 64 | powers_of_five[i].low;
    const Wide first = bits >> 75; // 53 bits; the other 75 are rounded as a sum of two parts
    const auto rest = static_cast<double>(static_cast<std::uint64_t>(bits >> 11)) * 0x1p-116;
    table[i] = { static_cast<double>(static_cast<std::uint64_t>(first)) * 0x1p-52, rest };
  }
  return table;
}();

bool nearest_double(std::uint64_t digits, std::int64_t power, double& value) noexcept
{
  if (digits == 0 || power < smallest_power || power > largest_power)
  {
    value = digits == 0 || power < 0 ? 0 : std::numeric_limits<double>::infinity();
    return true;
  }
  const int q = static_cast<int>(power);
  const PowerOfFive& five = powers_of_five[place(q)];
  const int zeros = std::countl_zero(digits);
  const std::uint64_t normal = digits << zeros;
  Wide product = Wide{ normal } * five.high;
  constexpr std::uint64_t below_rounding =
    0x1ff; // bits of the high half that a double has no use for
  if ((static_cast<std::uint64_t>(product >> 64) & below_rounding) == below_rounding)
  {
    product += Wide{ normal } * five.low >> 64;
  }
  const auto high = static_cast<std::uint64_t>(product >> 64);
  const auto low = static_cast<std::uint64_t>(product);
  if (low == ~std::uint64_t{ 0 } && (q < -27 || q > 55))
  {
    return false; // the bits that are not there could still carry
  }
  const int top = static_cast<int>(high >> 63);
  const int shift = top + 64 - 52 - 3;
  std::uint64_t mantissa = high >> shift; // 54 bits: one more than a double has
  const bool exact_middle =
    low <= 1 && q >= -4 && q <= 23 && (mantissa & 3) == 1 && mantissa << shift == high;
  mantissa -= exact_middle ? 1 : 0;
  value = round_last_bit(mantissa, binary_exponent(q) + 63 + top - zeros + 1023);
  return true;
}
}
