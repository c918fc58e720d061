// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_exact_decimal_h
#define granular_tests_support_exact_decimal_h

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

/// All decimal digits of a double, by multiplication as at school: what printing is compared with
/// beside printf.
class ExactDecimal
{
public:
  /// A finite number, not 0.
  explicit ExactDecimal(double value)
    : negative_(value < 0)
  {
    int power = 0;
    const double mantissa = std::ldexp(std::frexp(std::abs(value), &power), 53);
    power -= 53;
    digits_ = std::to_string(static_cast<unsigned long long>(mantissa));
    std::reverse(digits_.begin(), digits_.end());
    for (int i = 0; i < std::abs(power); ++i)
    {
      this->multiply(power < 0 ? 5 : 2); // 2^-1 is 5 * 10^-1
    }
    std::reverse(digits_.begin(), digits_.end());
    exponent_ = static_cast<int>(digits_.size()) - 1 + std::min(power, 0);
  }

  /// As %.Ng, ties to even.
  std::string text(int digits) const
  {
    std::string kept = digits_ + std::string(static_cast<std::size_t>(digits), '0');
    const std::string rest = kept.substr(static_cast<std::size_t>(digits));
    kept.resize(static_cast<std::size_t>(digits));
    int exponent = exponent_;
    const bool is_half = rest[0] == '5' && rest.find_first_not_of('0', 1) == rest.npos;
    if (is_half ? kept.back() % 2 != 0 : rest[0] >= '5')
    {
      if (kept.find_last_not_of('9') == kept.npos)
      {
        kept.insert(0, "0");
        ++exponent;
      }
      const std::size_t last = kept.find_last_not_of('9');
      ++kept[last];
      std::fill(kept.begin() + static_cast<std::ptrdiff_t>(last) + 1, kept.end(), '0');
    }
    kept.resize(kept.find_last_not_of('0') + 1);
    return (negative_ ? "-" : "") + laid_out(kept, exponent, digits);
  }

private:
  void multiply(int factor)
  {
    int carry = 0;
    for (char& digit : digits_)
    {
      carry += (digit - '0') * factor;
      digit = static_cast<char>('0' + carry % 10);
      carry /= 10;
    }
    if (carry > 0)
    {
      digits_ += static_cast<char>('0' + carry);
    }
  }

  static std::string laid_out(std::string kept, int exponent, int digits)
  {
    if (exponent < -4 || exponent >= digits)
    {
      char tail[16];
      std::snprintf(tail, sizeof tail, "e%c%02d", exponent < 0 ? '-' : '+', std::abs(exponent));
      return kept.substr(0, 1) + (kept.size() > 1 ? "." + kept.substr(1) : "") + tail;
    }
    if (exponent < 0)
    {
      return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + kept;
    }
    const auto before = static_cast<std::size_t>(exponent + 1);
    kept.resize(std::max(kept.size(), before), '0');
    return kept.substr(0, before) + (kept.size() > before ? "." + kept.substr(before) : "");
  }

  bool negative_;
  std::string digits_;
  int exponent_; ///< of the first
};

#endif
