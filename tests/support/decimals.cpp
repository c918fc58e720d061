// SPDX-License-Identifier: BSD-3-Clause
#include "decimals.h"

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>

const Decimals::Kind Decimals::kinds[] = {
  { "%g of any double", &Decimals::six_digits },
  { "%.17g of any double", &Decimals::seventeen_digits },
  { "%.{0..20}e", &Decimals::scientific },
  { "a coordinate", &Decimals::coordinate },
  { "any digits", &Decimals::digits },
  { "a point midway between two doubles, or next to it", &Decimals::midpoint },
  { "subnormal", &Decimals::subnormal },
  { "close to where doubles end", &Decimals::border },
  { "integer", &Decimals::integer },
};

Decimals::Decimals(std::uint64_t seed)
  : random_(seed)
{
}

const std::string& Decimals::next()
{
  const Kind& kind = kinds[turn_++ % std::size(kinds)];
  kind_ = kind.name;
  (this->*kind.make)();
  const bool has_sign = text_[0] == '-' || text_[0] == '+';
  if (!has_sign && this->below(16) == 0)
  {
    text_.insert(text_.begin(), '+');
  }
  const std::size_t exponent = text_.find('e');
  if (exponent != text_.npos && this->below(8) == 0)
  {
    text_[exponent] = 'E';
  }
  if (exponent != text_.npos && exponent + 2 < text_.size() && this->below(16) == 0 &&
    (text_[exponent + 1] == '-' || text_[exponent + 1] == '+'))
  {
    text_.insert(exponent + 2, "0"); // old Microsoft libraries print three digits
  }
  return text_;
}

template <typename... Values>
void Decimals::print(const char* format, Values... values)
{
  char buffer[1200];
  const int length = std::snprintf(buffer, sizeof buffer, format, values...);
  text_.assign(buffer, static_cast<std::size_t>(length));
}

std::uint64_t Decimals::below(std::uint64_t n)
{
  return random_() % n;
}

double Decimals::any_double()
{
  for (;;)
  {
    const auto value = std::bit_cast<double>(random_());
    if (std::isfinite(value))
    {
      return value;
    }
  }
}

void Decimals::six_digits()
{
  this->print("%g", this->any_double());
}

void Decimals::seventeen_digits()
{
  this->print("%.17g", this->any_double());
}

void Decimals::scientific()
{
  this->print("%.*e", static_cast<int>(this->below(21)), this->any_double());
}

void Decimals::coordinate()
{
  constexpr const char* formats[] = { "%g", "%.8g", "%.10g", "%.15g", "%.16g", "%-1.16e", "%f",
    "%.3f", "%.12f", "%20.15g" };
  const double unit = static_cast<double>(random_() >> 11) * 0x1p-53;
  const double size = std::pow(10.0, static_cast<double>(this->below(16)) - 8);
  const char* const format = formats[this->below(std::size(formats))];
  char buffer[100];
  std::snprintf(buffer, sizeof buffer, format, (2 * unit - 1) * size);
  const std::string text = buffer;
  text_ = text.substr(text.find_first_not_of(' '));
}

void Decimals::digits()
{
  const std::uint64_t count = 1 + this->below(40);
  const std::uint64_t point = this->below(count + 4); // of which three mean: none
  text_ = this->below(3) == 0 ? "-" : "";
  for (std::uint64_t i = 0; i < count; ++i)
  {
    text_ += i == point ? "." : "";
    text_ += static_cast<char>('0' + (this->below(4) == 0 ? 0 : this->below(10)));
  }
  text_ += point == count ? "." : "";
  if (this->below(2) == 0)
  {
    const auto exponent = static_cast<int>(this->below(801)) - 400;
    text_ +=
      "e" + std::string(exponent >= 0 && this->below(2) == 0 ? "+" : "") + std::to_string(exponent);
  }
}

/// A long double holds the 54 bits of the midpoint, and printf prints all decimals it has.
void Decimals::midpoint()
{
  static_assert(LDBL_MANT_DIG >= 54);
  const double low = std::abs(this->any_double());
  const double high = std::nextafter(low, std::numeric_limits<double>::infinity());
  const long double middle = std::isfinite(high)
    ? (static_cast<long double>(low) + static_cast<long double>(high)) / 2
    : static_cast<long double>(low);
  this->print("%.*Le", 770, middle);
  const std::size_t exponent = text_.find('e');
  std::size_t last = text_.find_last_not_of('0', exponent - 1);
  const std::uint64_t which = this->below(4);
  if (which == 1)
  {
    ++text_[exponent - 1]; // the last of 770 decimals was 0: a hair above
  }
  else if (which == 2)
  {
    --text_[last]; // at least 1 before
  }
  else if (which == 3)
  {
    text_.erase(last + 1, exponent - last - 1);
  }
}

void Decimals::subnormal()
{
  const std::uint64_t sign = random_() & std::uint64_t{ 1 } << 63;
  const auto value = std::bit_cast<double>(sign | random_() >> (11 + this->below(52)));
  this->print("%.*e", static_cast<int>(this->below(26)), value);
}

void Decimals::border()
{
  constexpr const char* starts[] = { "1.797693134862315", "2.225073858507201", "4.940656458412465",
    "2.470328229206232", "1.7976931348623158079", "2.4703282292062327208" };
  constexpr const char* exponents[] = { "e308", "e-308", "e-324", "e-324", "e308", "e-324" };
  const std::uint64_t which = this->below(std::size(starts));
  text_ = starts[which];
  for (std::uint64_t count = this->below(12); count > 0; --count)
  {
    text_ += static_cast<char>('0' + this->below(10));
  }
  text_ += exponents[which];
}

void Decimals::integer()
{
  const auto value = static_cast<std::int64_t>(random_() >> this->below(64));
  this->print("%lld", static_cast<long long>(this->below(2) == 0 ? value : -(value >> 1)));
}

std::int64_t numbers_to_try(std::int64_t fallback)
{
  const char* const count = std::getenv("GRANULAR_NUMBERS");
  return count ? std::atoll(count) : fallback;
}
