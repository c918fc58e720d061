// SPDX-License-Identifier: BSD-3-Clause
// The correctly rounded sum of doubles by other means than the library: as one large integer.
#ifndef granular_tests_support_big_sum_h
#define granular_tests_support_big_sum_h

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// A multiple of 2^-1074, the unit of all doubles, in two's complement.
class BigSum
{
public:
  /// A finite term.
  void add(double term)
  {
    int exponent = 0;
    const double fraction = std::frexp(std::abs(term), &exponent);
    const int shift = exponent - 53 + 1074; // of the 53 bits; below 0 where the last of them are 0
    auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    bits = shift < 0 ? bits >> std::min(-shift, 63) : bits;
    const int up = std::max(shift, 0);
    const auto at = static_cast<std::size_t>(up / 64);
    const int rest = up % 64;
    const std::uint64_t low = bits << rest;
    const std::uint64_t high = rest == 0 ? 0 : bits >> (64 - rest);
    this->add_at(at, low, high, term < 0);
  }

  /// The nearest double, halfway the even one.
  double value() const
  {
    const bool negative = (words_.back() >> 63) != 0;
    const BigSum magnitude = negative ? this->negated() : *this;
    const int top = magnitude.highest_bit();
    const int first = std::max(top - 52, 0); // the lowest bit that is kept
    std::uint64_t kept = 0;
    for (int i = top; i >= first; --i)
    {
      kept = 2 * kept + (magnitude.bit(i) ? 1 : 0);
    }
    bool below = false;
    for (int i = first - 2; i >= 0; --i)
    {
      below = below || magnitude.bit(i);
    }
    const bool half = first > 0 && magnitude.bit(first - 1);
    kept += half && (below || kept % 2 == 1) ? std::uint64_t{ 1 } : 0;
    const double value = std::ldexp(static_cast<double>(kept), first - 1074);
    return negative ? -value : value;
  }

private:
  /// Adds or subtracts two words, and carries on as far as it goes.
  void add_at(std::size_t at, std::uint64_t low, std::uint64_t high, bool negative)
  {
    std::uint64_t carry = 0;
    for (std::size_t i = at; i < words_.size() && (i < at + 2 || carry != 0); ++i)
    {
      const std::uint64_t term = i == at ? low : i == at + 1 ? high : 0;
      const std::uint64_t before = words_[i];
      const std::uint64_t after = negative ? before - term : before + term;
      const bool over = negative ? after > before : after < before;
      words_[i] = negative ? after - carry : after + carry;
      carry = over || (negative ? words_[i] > after : words_[i] < after) ? 1 : 0;
    }
  }

  BigSum negated() const
  {
    BigSum other;
    std::uint64_t carry = 1;
    for (std::size_t i = 0; i < words_.size(); ++i)
    {
      other.words_[i] = ~words_[i] + carry;
      carry = carry == 1 && other.words_[i] == 0 ? 1 : 0;
    }
    return other;
  }

  bool bit(int i) const
  {
    const auto at = static_cast<std::size_t>(i);
    return (words_[at / 64] >> (at % 64) & 1) != 0;
  }

  /// 0 for no bits at all.
  int highest_bit() const
  {
    for (std::size_t i = words_.size(); i-- > 0;)
    {
      if (words_[i] != 0)
      {
        return static_cast<int>(64 * i) + static_cast<int>(std::bit_width(words_[i])) - 1;
      }
    }
    return 0;
  }

  std::array<std::uint64_t, 36> words_ = {}; ///< 2304 bits, the lowest first
};
#endif
