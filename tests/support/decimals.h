// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_decimals_h
#define granular_tests_support_decimals_h

#include <cstdint>
#include <random>
#include <string>

/// Decimal numbers that a parser may get wrong, of every kind in turn. None is longer than 900
/// characters, all are what strtod reads to the end.
class Decimals
{
public:
  explicit Decimals(std::uint64_t seed);

  /// The next number.
  const std::string& next();

  /// Its kind, for messages.
  const char* kind() const noexcept { return kind_; }

private:
  using Make = void (Decimals::*)();
  struct Kind
  {
    const char* name;
    Make make;
  };
  static const Kind kinds[];

  template <typename... Values>
  void print(const char* format, Values... values);
  std::uint64_t below(std::uint64_t n);
  double any_double();

  void six_digits();
  void seventeen_digits();
  void scientific();
  void coordinate();
  void digits();
  void midpoint();
  void subnormal();
  void border();
  void integer();

  std::mt19937_64 random_;
  std::string text_;
  const char* kind_ = "";
  std::size_t turn_ = 0;
};

/// How many numbers a test tries: the environment variable GRANULAR_NUMBERS, or fallback.
std::int64_t numbers_to_try(std::int64_t fallback);

#endif
