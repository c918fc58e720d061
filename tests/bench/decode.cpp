// SPDX-License-Identifier: BSD-3-Clause
// Rows of text into columns in memory: decode_rows against a plain loop with std::from_chars. Options besides those of Google
// Benchmark: --full, for texts that are larger than the caches.
#include "granular/text/row_text.h"

#include <benchmark/benchmark.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace
{
using granular::ColumnSink;
using granular::Simd;
using granular::ValueType;

using Random = std::mt19937_64;

/// Columns of rows: integers first and last, doubles in the middle.
struct Form
{
  const char* name;
  int integers_before;
  int doubles;
  int integers_behind;
  const char* print;                                  ///< of doubles
  double (*value)(Random& random, bool rests, int k); ///< of double k

  int columns() const { return integers_before + doubles + integers_behind; }
  bool is_double(int column) const
  {
    return column >= integers_before && column < integers_before + doubles;
  }
};

double between(Random& random, double lo, double hi)
{
  return std::uniform_real_distribution<>(lo, hi)(random);
}

/// Places in a box of 1 m, velocities of 0.1 m/s, forces of 10 mN, radii of 1 to 2 mm.
double plain(Random& random, bool, int k)
{
  if (k < 3)
  {
    return between(random, 0, 1);
  }
  return k < 9 ? std::normal_distribution<>(0, k < 6 ? 0.06 : 0.006)(random)
               : between(random, 1e-3, 2e-3);
}

/// Half of the particles do not move.
double at_rest(Random& random, bool rests, int k)
{
  return rests && k >= 3 && k < 9 ? 0.0 : plain(random, rests, k);
}

template <int lowest, int highest>
double any_magnitude(Random& random, bool, int k)
{
  return (k % 2 == 0 ? 1 : -1) * std::pow(10, between(random, lowest, highest));
}

const Form forms[] = {
  { "8 columns %g", 2, 3, 3, "%g", plain },
  { "12 columns %g", 2, 10, 0, "%g", plain },
  { "12 columns %.16e", 2, 10, 0, "%.16e", plain },
  { "12 columns %.6f", 2, 10, 0, "%.6f", plain },
  { "12 columns %g, half at rest", 2, 10, 0, "%g", at_rest },
  { "12 columns %g, 1e-40 to 1e-5", 2, 10, 0, "%g", any_magnitude<-40, -5> },
  { "12 columns %g, 1e-300 to 1e300", 2, 10, 0, "%g", any_magnitude<-300, 300> },
  { "12 columns of integers", 12, 0, 0, "", nullptr },
};

/// An id in no order, a type, image counts; without doubles, integers of one to ten digits.
std::int64_t integer(
  Random& random, const Form& form, std::int64_t row, std::int64_t rows, int column)
{
  if (column == 0)
  {
    return row * 7919 % rows + 1;
  }
  if (column == 1)
  {
    return static_cast<std::int64_t>(random() % 3) + 1;
  }
  if (form.doubles > 0)
  {
    return static_cast<std::int64_t>(random() % 5) - 2;
  }
  const auto range = static_cast<std::uint64_t>(std::pow(10, column - 1));
  return static_cast<std::int64_t>(random() % range) * (column % 3 == 1 ? -1 : 1);
}

std::string text_of(const Form& form, std::int64_t rows)
{
  Random random(7);
  std::string text;
  char word[64];
  for (std::int64_t row = 0; row < rows; ++row)
  {
    const bool rests = random() % 2 == 0;
    for (int column = 0; column < form.columns(); ++column)
    {
      if (form.is_double(column))
      {
        const double value = form.value(random, rests, column - form.integers_before);
        std::snprintf(word, sizeof word, form.print, value);
      }
      else
      {
        std::snprintf(word, sizeof word, "%lld",
          static_cast<long long>(integer(random, form, row, rows, column)));
      }
      text += word;
      text += ' '; // `dump custom` ends its rows so
    }
    text += '\n';
  }
  return text;
}

/// A text and memory for its values, row after row; each value takes eight bytes.
struct Work
{
  Work(const Form& of, std::int64_t count)
    : form(of)
    , rows(count)
    , values(static_cast<std::size_t>(count * of.columns()), -1)
  {
    const std::string made = text_of(of, count);
    text = granular::PaddedBuffer(made.size());
    std::memcpy(text.data(), made.data(), made.size());
  }

  char* place(std::int64_t row, int column)
  {
    return reinterpret_cast<char*>(values.data() + row * form.columns() + column);
  }

  bool decode(Simd simd)
  {
    std::vector<ColumnSink> sinks;
    for (int i = 0; i < form.columns(); ++i)
    {
      sinks.push_back(
        { static_cast<std::uint32_t>(i), form.is_double(i) ? ValueType::Float64 : ValueType::Int64,
          this->place(0, i), 8 * form.columns() });
    }
    granular::RowMemory memory;
    const granular::RowResult result = granular::decode_rows(text.data(), text.data() + text.size(),
      static_cast<std::uint32_t>(form.columns()), sinks, std::numeric_limits<std::int64_t>::max(),
      memory, simd);
    return result.status == granular::RowStatus::Done && result.rows == rows;
  }

  template <class T, class Parse>
  static const char* store(const Parse& parse, const char* first, const char* last, void* to)
  {
    T value{};
    const char* const end = parse(first, last, value);
    std::memcpy(to, &value, sizeof value);
    return end;
  }

  /// The yardstick: one pass, and no thought of anything else. parse reads a word into a value and returns its end, or null.
  template <class Parse>
  bool loop(const Parse& parse)
  {
    const char* at = text.data();
    const char* const end = at + text.size();
    const int first = form.integers_before;
    const int last = first + form.doubles;
    const int columns = form.columns();
    std::int64_t* to = values.data();
    for (std::int64_t row = 0; row < rows; ++row)
    {
      for (int i = 0; i < columns && at; ++i, ++to)
      {
        while (at != end && (*at == ' ' || *at == '\n'))
        {
          ++at;
        }
        at = i >= first && i < last ? store<double>(parse, at, end, to)
                                    : store<std::int64_t>(parse, at, end, to);
      }
      if (!at)
      {
        return false;
      }
    }
    return true;
  }

  bool from_chars()
  {
    return this->loop(
      [](const char* first, const char* last, auto& value) -> const char*
      {
        const std::from_chars_result result = std::from_chars(first, last, value);
        return result.ec == std::errc() ? result.ptr : nullptr;
      });
  }

  /// The truth.
  bool strtod()
  {
    return this->loop(
      [](const char* first, const char*, auto& value) -> const char*
      {
        char* end = nullptr;
        if constexpr (std::is_same_v<decltype(value), double&>)
        {
          value = std::strtod(first, &end);
        }
        else
        {
          value = std::strtoll(first, &end, 10);
        }
        return end == first ? nullptr : end;
      });
  }

  const Form& form;
  std::int64_t rows;
  granular::PaddedBuffer text;
  std::vector<std::int64_t> values;
};

/// Checks the values against the truth, then runs the contender again and again.
void measure(benchmark::State& state, const std::shared_ptr<Work>& work,
  const std::vector<std::int64_t>& truth, const std::function<bool(Work&)>& contender)
{
  work->values.assign(work->values.size(), -1);
  if (!contender(*work) || work->values != truth)
  {
    state.SkipWithError("values differ from strtod's");
    return;
  }
  for (auto _ : state)
  {
    contender(*work);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(work->text.size()));
}

void add_form(const Form& form, std::int64_t rows)
{
  const auto work = std::make_shared<Work>(form, rows);
  if (!work->strtod())
  {
    throw std::logic_error(std::string(form.name) + ": a word is no number");
  }
  std::vector<std::pair<std::string, std::function<bool(Work&)>>> contenders = { { "from_chars",
    [](Work& it) { return it.from_chars(); } } };
  for (const Simd simd : granular::instruction_sets())
  {
    contenders.emplace_back(to_string(simd), [simd](Work& it) { return it.decode(simd); });
  }
  for (const auto& [name, contender] : contenders)
  {
    benchmark::RegisterBenchmark((std::string(form.name) + "/" + name).c_str(),
      [work, truth = work->values, contender = contender](benchmark::State& state)
      { measure(state, work, truth, contender); });
  }
}
}

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  const bool full = argc == 2 && std::string(argv[1]) == "--full";
  if (argc > 1 + full)
  {
    std::fprintf(stderr, "usage: bench_decode [--full] [--benchmark_...]\n");
    return 2;
  }
  for (const Form& form : forms)
  {
    add_form(form, full ? 200'000 : 3'000);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
