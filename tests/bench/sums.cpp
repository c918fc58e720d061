// SPDX-License-Identifier: BSD-3-Clause
// What exactness of sums costs, and how wrong others are: one sum of many terms, by += on floats and doubles, pairwise,
// compensated, and as averages make it. The exact sum is made of integers: each term is a multiple of 2^-bottom.
//
// Numbers beside: words read by the loop that many programs have, digits times a power of ten, against the nearest
// double.
#include "bench.h"

#include "granular/geometry/compensated.h"
#include "granular/geometry/reproducible_sum.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace bench
{
namespace
{
/// 113 bits.
__extension__ typedef __float128 Quad;

/// Terms, and their exact sum.
struct Terms
{
  std::vector<double> values;
  Quad exact = 0;
  granular::SumScale::Range range;
};

/// All partial sums of multiples of 2^bottom below 2^(bottom + 113) are exact in 113 bits.
Terms make_terms(const std::vector<double>& values, int top, int bottom)
{
  Terms terms;
  terms.range = { top, bottom };
  for (const double value : values)
  {
    const double rounded = std::ldexp(std::nearbyint(std::ldexp(value, -bottom)), bottom);
    terms.values.push_back(rounded);
    terms.exact += rounded;
  }
  return terms;
}

Terms make_terms(std::string_view kind, std::size_t count)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = unit(random);
    if (kind == "alike")
    {
      values[i] = 0.5 + x;
    }
    else if (kind == "masses 1e12 apart")
    {
      values[i] = i % 2 == 0 ? 1e6 * (1 + x) : 1e-6 * (1 + x);
    }
    else
    { // velocities to and fro, and what is left of them: 1e-12 of the largest
      values[i] = i % 2 == 0 ? 1 + x : -values[i - 1];
    }
  }
  if (kind == "cancelling to 1e-12")
  {
    values.push_back(1e-12);
    std::ranges::shuffle(values, random);
  }
  return make_terms(values, 22, kind == "masses 1e12 apart" ? -72 : -60);
}

template <class T>
T add_pairs(const double* values, std::size_t count)
{
  if (count <= 32)
  {
    T sum = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      sum += static_cast<T>(values[i]);
    }
    return sum;
  }
  return add_pairs<T>(values, count / 2) + add_pairs<T>(values + count / 2, count - count / 2);
}

template <class T>
T add_plainly(const std::vector<double>& values)
{
  T sum = 0;
  for (const double value : values)
  {
    sum += static_cast<T>(value);
  }
  return sum;
}

double add_compensated(const std::vector<double>& values)
{
  granular::CompensatedSum sum;
  for (const double value : values)
  {
    sum.add(value);
  }
  return sum.hi + sum.lo;
}

/// Terms as averages add them: eight sums at once, which are all the same here. The time counts for one.
class ExactSum
{
public:
  explicit ExactSum(const Terms& terms)
    : terms_(terms.values.size())
    , cells_(terms.values.size())
    , scale_(ranges(terms), static_cast<std::int64_t>(terms.values.size()))
    , sums_(scale_.size())
  {
    this->set(terms.values);
  }

  /// Takes the same terms in another order.
  void set(const std::vector<double>& values)
  {
    for (std::size_t i = 0; i < terms_.size(); ++i)
    {
      terms_[i].fill(values[i]);
    }
  }

  double add()
  {
    std::ranges::fill(sums_, 0);
    scale_.add(terms_, cells_.data(), sums_.data());
    return scale_.values(sums_.data())[0];
  }

private:
  static std::array<granular::SumScale::Range, granular::SumScale::lanes> ranges(const Terms& terms)
  {
    std::array<granular::SumScale::Range, granular::SumScale::lanes> found;
    found.fill(terms.range);
    return found;
  }

  std::vector<granular::SumScale::Terms> terms_;
  std::vector<std::int64_t> cells_;
  granular::SumScale scale_;
  std::vector<std::int64_t> sums_;
};

/// A way to add; exact is the one of the same terms.
struct SumWay
{
  const char* name;
  double (*add)(const std::vector<double>& values, ExactSum& exact);
};

constexpr std::array<SumWay, 6> sum_ways = { {
  { "+= float",
    [](const std::vector<double>& values, ExactSum&) -> double
    { return add_plainly<float>(values); } },
  { "+= double",
    [](const std::vector<double>& values, ExactSum&) { return add_plainly<double>(values); } },
  { "pairwise float",
    [](const std::vector<double>& values, ExactSum&) -> double
    { return add_pairs<float>(values.data(), values.size()); } },
  { "pairwise double",
    [](const std::vector<double>& values, ExactSum&)
    { return add_pairs<double>(values.data(), values.size()); } },
  { "compensated",
    [](const std::vector<double>& values, ExactSum&) { return add_compensated(values); } },
  { "exact", [](const std::vector<double>&, ExactSum& exact) { return exact.add(); } },
} };

/// Relative errors of all ways, for terms in random orders. Returns nothing if the exact sum is not correctly rounded.
std::array<Samples, sum_ways.size()> errors_of_orders(Terms terms, std::int64_t orders)
{
  std::array<Samples, sum_ways.size()> errors;
  std::mt19937_64 random(5);
  ExactSum exact(terms);
  for (std::int64_t order = 0; order < orders; ++order)
  {
    std::ranges::shuffle(terms.values, random);
    exact.set(terms.values);
    for (std::size_t i = 0; i < sum_ways.size(); ++i)
    {
      const double sum = sum_ways[i].add(terms.values, exact);
      if (sum_ways[i].name == std::string_view("exact") && sum != static_cast<double>(terms.exact))
      {
        return {};
      }
      errors[i].push_back(std::abs(static_cast<double>((sum - terms.exact) / terms.exact)));
    }
  }
  return errors;
}

void sum_case(
  benchmark::State& state, const std::string& kind, std::size_t count, std::int64_t orders)
{
  const Terms terms = make_terms(kind, count);
  const auto errors = errors_of_orders(terms, orders);
  if (errors[0].empty())
  {
    fail(state, "a sum is not correctly rounded");
    return;
  }
  ExactSum exact(terms);
  Rounds rounds;
  for (const SumWay& way : sum_ways)
  {
    rounds.add(way.name,
      [&way, &terms, &exact]
      {
        benchmark::DoNotOptimize(way.add(terms.values, exact));
        return true;
      });
  }
  if (!rounds.run_all(
        state, "a sum is not correctly rounded", static_cast<double>(terms.values.size())))
  {
    return;
  }
  for (std::size_t i = 0; i < sum_ways.size(); ++i)
  {
    const std::string name = sum_ways[i].name;
    const double at_once = name == "exact" ? granular::SumScale::lanes : 1;
    tell(state, name, 1e9 * median(rounds.of(name)) / at_once, "ns/term");
    tell(state, name + ", time against += double",
      median_ratio(rounds.of(name), rounds.of("+= double")) / at_once, "1");
    const auto [least, largest] = std::ranges::minmax_element(errors[i]);
    tell(state, name + ", relative error, least", *least, "1");
    tell(state, name + ", relative error, median", median(errors[i]), "1");
    tell(state, name + ", relative error, largest", *largest, "1");
  }
}

/// What many programs have: digits into a double, times or by a power of ten.
double parse_plainly(std::string_view word)
{
  double digits = 0;
  int power = 0;
  bool behind_point = false;
  std::size_t i = word.front() == '-' ? 1 : 0;
  for (; i < word.size() && word[i] != 'e'; ++i)
  {
    if (word[i] == '.')
    {
      behind_point = true;
      continue;
    }
    digits = 10 * digits + (word[i] - '0');
    power -= behind_point ? 1 : 0;
  }
  if (i < word.size())
  {
    power += std::stoi(std::string(word.substr(i + 1)));
  }
  const double value = digits * std::pow(10.0, power);
  return word.front() == '-' ? -value : value;
}

/// Words of so many digits; of 0: the hardest, exactly in the middle between two doubles, or a digit of the last place beside.
std::vector<std::string> make_words(int digits, std::size_t count)
{
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<std::string> words(count);
  std::array<char, 100> buffer = {};
  for (std::string& word : words)
  {
    const double value = unit(random);
    if (digits > 0)
    {
      std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
    }
    else
    {
      const long double middle =
        (static_cast<long double>(1 + value / 2) + std::nextafter(1 + value / 2, 2)) / 2;
      std::snprintf(buffer.data(), buffer.size(), "%.*Lf", 56, middle);
    }
    word = buffer.data();
    if (digits == 0 && random() % 2 == 0)
    {
      word.back() = '1';
    }
  }
  return words;
}

void number_case(benchmark::State& state, int digits, std::size_t count)
{
  const std::vector<std::string> words = make_words(digits, count);
  std::vector<double> true_values(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    true_values[i] = std::strtod(words[i].c_str(), nullptr); // glibc rounds correctly
  }
  std::int64_t wrong_plain = 0;
  Rounds rounds;
  rounds.add("digits times a power",
    [&]
    {
      wrong_plain = 0;
      for (std::size_t i = 0; i < count; ++i)
      {
        wrong_plain += parse_plainly(words[i]) != true_values[i] ? 1 : 0;
      }
      return true;
    });
  rounds.add("parse_double",
    [&]
    {
      bool right = true;
      for (std::size_t i = 0; i < count; ++i)
      {
        double value = 0;
        granular::parse_double(words[i].data(), words[i].data() + words[i].size(), value);
        right = right && value == true_values[i];
      }
      return right;
    });
  rounds.add("std::from_chars",
    [&]
    {
      bool right = true;
      for (std::size_t i = 0; i < count; ++i)
      {
        double value = 0;
        std::from_chars(words[i].data(), words[i].data() + words[i].size(), value);
        right = right && value == true_values[i];
      }
      return right;
    });
  if (!rounds.run_all(state, "a number is not the nearest double", static_cast<double>(count)))
  {
    return;
  }
  for (const char* const name : { "digits times a power", "parse_double", "std::from_chars" })
  {
    const double wrong =
      std::string_view(name) == "digits times a power" ? static_cast<double>(wrong_plain) : 0;
    tell(state, name, 1e9 * median(rounds.of(name)), "ns/word");
    tell(state, std::string(name) + ", wrong words of 10^9",
      1e9 * wrong / static_cast<double>(count), "1");
  }
}
}

void add_benchmarks(const Size& size)
{
  for (const char* const kind : { "alike", "masses 1e12 apart", "cancelling to 1e-12" })
  {
    add(std::string("sums/") + kind, size.pick(7, 1),
      [kind, size](benchmark::State& state)
      {
        sum_case(
          state, kind, static_cast<std::size_t>(size.pick(1'000'000, 10'000)), size.pick(50, 3));
      });
  }
  for (const int digits : { 6, 9, 17, 0 })
  {
    add(digits > 0 ? "sums/words of " + std::to_string(digits) + " digits"
                   : "sums/words, the hardest",
      size.pick(5, 1),
      [digits, size](benchmark::State& state)
      { number_case(state, digits, static_cast<std::size_t>(size.pick(1'000'000, 10'000))); });
  }
}
}
