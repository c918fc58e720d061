// SPDX-License-Identifier: BSD-3-Clause
// Numbers of 128 bits to compare with. __float128 does not work: clang 14 and the libgcc of MinGW do not agree how functions take it.
#ifndef granular_tests_windows_quad_h
#define granular_tests_windows_quad_h

#include <algorithm>
#include <bit>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>

/// fraction * 2^exponent, where the fraction has its first bit set or is 0. Results are cut behind 127 bits. Without infinity.
class Quad
{
public:
  Quad() = default;

  template <std::integral Number>
  Quad(Number value) // NOLINT: a number is an expression
    : Quad(value < 0, value < 0 ? -static_cast<Wide>(value) : static_cast<Wide>(value), 0)
  {
  }

  template <std::floating_point Number>
  Quad(Number value) // NOLINT
  {
    int exponent = 0;
    const auto part = static_cast<long double>(std::frexp(std::abs(value), &exponent));
    is_nan_ = !std::isfinite(value);
    if (!is_nan_)
    {
      *this = Quad(std::signbit(value), static_cast<Wide>(std::ldexp(part, 64)), exponent - 64);
    }
  }

  explicit operator double() const
  {
    // the last bit is half of the smallest double at least, and one below tells of those that are cut
    const int drop = std::max(bits - 55, -1076 - exponent_);
    if (is_nan_ || drop >= bits)
    {
      return is_nan_ ? std::nan("") : 0.0;
    }
    const Wide cut = fraction_ >> drop;
    const auto seen = static_cast<std::uint64_t>(cut) | ((cut << drop) != fraction_ ? 1U : 0U);
    const std::uint64_t kept = (seen >> 2) + ((seen & 3) + ((seen >> 2) & 1) > 2 ? 1 : 0);
    const double value = std::ldexp(static_cast<double>(kept), exponent_ + drop + 2);
    return is_negative_ ? -value : value;
  }

  explicit operator long double() const
  {
    const auto first = static_cast<long double>(static_cast<std::uint64_t>(fraction_ >> 64));
    return is_nan_ ? std::nan("") : (is_negative_ ? -1 : 1) * std::ldexp(first, exponent_ + 64);
  }

  template <std::integral Number>
  explicit operator Number() const
  {
    const int drop = -exponent_;
    const auto value = static_cast<Number>(drop >= bits ? 0 : fraction_ >> std::max(drop, 0));
    return is_negative_ ? static_cast<Number>(-value) : value;
  }

  Quad operator-() const
  {
    Quad result = *this;
    result.is_negative_ = !is_negative_;
    return result;
  }

  friend Quad operator+(const Quad& a, const Quad& b)
  {
    if (a.is_nan_ || b.is_nan_ || b.fraction_ == 0)
    {
      return b.is_nan_ ? b : a;
    }
    if (a.fraction_ == 0 || is_smaller(a, b))
    {
      return a.fraction_ == 0 ? b : b + a;
    }
    const int down = a.exponent_ - b.exponent_;
    const Wide other = down < bits ? b.fraction_ >> down : 0;
    return a.is_negative_ == b.is_negative_
      ? Quad(a.is_negative_, (a.fraction_ >> 1) + (other >> 1) + (a.fraction_ & other & 1),
          a.exponent_ + 1)
      : Quad(a.is_negative_, a.fraction_ - other, a.exponent_);
  }

  friend Quad operator-(const Quad& a, const Quad& b) { return a + -b; }

  friend Quad operator*(const Quad& a, const Quad& b)
  {
    const Wide high_a = a.fraction_ >> 64;
    const Wide high_b = b.fraction_ >> 64;
    const Wide low_a = static_cast<std::uint64_t>(a.fraction_);
    const Wide low_b = static_cast<std::uint64_t>(b.fraction_);
    Quad result(a.is_negative_ != b.is_negative_,
      high_a * high_b + (high_a * low_b >> 64) + (low_a * high_b >> 64),
      a.exponent_ + b.exponent_ + bits);
    result.is_nan_ = a.is_nan_ || b.is_nan_;
    return result;
  }

  friend Quad operator/(const Quad& a, const Quad& b)
  {
    Wide quotient = 0;
    Wide rest = a.fraction_;
    bool is_over = false; // the rest has one bit more
    for (int i = 0; i < bits; ++i)
    {
      const bool fits = is_over || rest >= b.fraction_;
      quotient = quotient << 1 | (fits ? 1U : 0U);
      rest -= fits ? b.fraction_ : 0;
      is_over = rest >> (bits - 1) != 0;
      rest <<= 1;
    }
    Quad result(a.is_negative_ != b.is_negative_, quotient, a.exponent_ - b.exponent_ - (bits - 1));
    result.is_nan_ = a.is_nan_ || b.is_nan_ || b.fraction_ == 0;
    return result;
  }

  Quad& operator+=(const Quad& b) { return *this = *this + b; }
  Quad& operator-=(const Quad& b) { return *this = *this - b; }
  Quad& operator*=(const Quad& b) { return *this = *this * b; }
  Quad& operator/=(const Quad& b) { return *this = *this / b; }

  friend std::partial_ordering operator<=>(const Quad& a, const Quad& b)
  {
    const Quad rest = a - b;
    return rest.is_nan_     ? std::partial_ordering::unordered
      : rest.fraction_ == 0 ? std::partial_ordering::equivalent
      : rest.is_negative_   ? std::partial_ordering::less
                            : std::partial_ordering::greater;
  }
  friend bool operator==(const Quad& a, const Quad& b) { return (a <=> b) == 0; }

private:
  using Wide = unsigned __int128;
  static constexpr int bits = 128;

  Quad(bool is_negative, Wide fraction, int exponent)
    : is_negative_(is_negative)
  {
    const auto high = static_cast<std::uint64_t>(fraction >> 64);
    const auto low = static_cast<std::uint64_t>(fraction);
    const int up = high != 0 ? std::countl_zero(high) : 64 + std::countl_zero(low);
    fraction_ = up < bits ? fraction << up : 0;
    exponent_ = up < bits ? exponent - up : 0;
  }

  static bool is_smaller(const Quad& a, const Quad& b)
  {
    return a.exponent_ != b.exponent_ ? a.exponent_ < b.exponent_ : a.fraction_ < b.fraction_;
  }

  bool is_negative_ = false;
  bool is_nan_ = false;
  int exponent_ = 0;
  Wide fraction_ = 0;
};
#endif
