// SPDX-License-Identifier: BSD-3-Clause
// Numbers to text: print_number and print_integer against std::to_chars and snprintf, and rows of a
// dump against fprintf.
#include "bench.h"
#include "dump_text.h"

#include "granular/numbers/number_print.h"

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace bench
{
namespace
{
using granular::most_number_chars;
using granular::NumberFormat;

constexpr std::size_t values_a_round = 10'000;

/// What grains have.
enum class Values
{
  Position, ///< of six digits, in [-1, 1]
  Velocity, ///< of six digits, about 1e-3
  AtRest,   ///< half of them 0
  Zero,
  Full ///< all 53 bits, in [-1, 1]
};

double as_read(double value)
{
  char word[most_number_chars];
  std::snprintf(word, sizeof word, "%g", value);
  return std::strtod(word, nullptr);
}

double make(Values values, Random& random)
{
  switch (values)
  {
    case Values::Position:
      return as_read(random.between(-1, 1));
    case Values::Velocity:
      return as_read(1e-3 * random.bell());
    case Values::AtRest:
      return random.unit() < 0.5 ? 0 : as_read(random.bell());
    case Values::Zero:
      return 0;
    default:
      return random.between(-1, 1);
  }
}

std::vector<double> make(Values values)
{
  Random random(1);
  std::vector<double> made(values_a_round);
  for (double& value : made)
  {
    value = make(values, random);
  }
  return made;
}

/// Text that contenders print into, each as long as the first.
class Text
{
public:
  explicit Text(std::size_t bytes)
    : memory_(bytes, ' ')
  {
  }

  char* begin() { return memory_.data(); }

  std::string_view until(const char* end) const
  {
    return { memory_.data(), static_cast<std::size_t>(end - memory_.data()) };
  }

private:
  std::vector<char> memory_;
};

/// Prints all values with a blank after each.
template <class Value, class Print>
char* print_all(char* to, const std::vector<Value>& values, Print&& print)
{
  for (const Value value : values)
  {
    to = print(to, value);
    *to++ = ' ';
  }
  return to;
}

/// Measures contenders that print the same, the first of them ours.
template <class Value>
class Contest
{
public:
  Contest(std::vector<Value> values)
    : values_(std::move(values))
    , text_((values_.size() + 1) * most_number_chars)
  {
  }

  template <class Print>
  void add(const std::string& name, Print print)
  {
    const char* const end = print_all(text_.begin(), values_, print);
    const std::string printed(text_.until(end));
    same_ = same_ && (expected_.empty() || printed == expected_);
    expected_ = printed;
    names_.push_back(name);
    rounds_.add(name,
      [this, print]
      {
        const char* const last = print_all(text_.begin(), values_, print);
        return text_.until(last).size() == expected_.size();
      });
  }

  void run(benchmark::State& state)
  {
    if (!same_)
    {
      fail(state, "texts differ");
      return;
    }
    const auto work = static_cast<double>(values_.size());
    if (!rounds_.run_all(state, "a text has another length", work))
    {
      return;
    }
    const Samples& ours = rounds_.of(names_.front());
    for (const std::string& name : names_)
    {
      tell(state, name, 1e9 * median(rounds_.of(name)), "ns");
      if (name != names_.front())
      {
        tell(state, name + " ratio", median_ratio(rounds_.of(name), ours), "1");
      }
    }
    tell(state, "spread", spread_of_ratio(rounds_.of(names_.back()), ours), "1");
  }

private:
  std::vector<Value> values_;
  Text text_;
  std::string expected_;
  std::vector<std::string> names_;
  Rounds rounds_;
  bool same_ = true;
};

void numbers(benchmark::State& state, Values values, int digits)
{
  Contest<double> contest(make(values));
  contest.add("ours",
    [digits](char* to, double value) { return granular::print_number(to, value, { digits }); });
  contest.add("to_chars",
    [digits](char* to, double value)
    {
      char* const last = to + most_number_chars;
      return digits == 0 ? std::to_chars(to, last, value).ptr
                         : std::to_chars(to, last, value, std::chars_format::general, digits).ptr;
    });
  if (digits > 0)
  {
    contest.add("snprintf",
      [digits](char* to, double value)
      { return to + std::snprintf(to, most_number_chars, "%.*g", digits, value); });
  }
  contest.run(state);
}

void integers(benchmark::State& state, std::uint64_t count, std::int64_t least)
{
  Random random(2);
  std::vector<std::int64_t> made(values_a_round);
  for (std::int64_t& value : made)
  {
    value = least + static_cast<std::int64_t>(random.bits() % count);
  }
  Contest<std::int64_t> contest(made);
  contest.add("ours", granular::print_integer);
  contest.add("to_chars",
    [](char* to, std::int64_t value)
    { return std::to_chars(to, to + most_number_chars, value).ptr; });
  contest.add("snprintf",
    [](char* to, std::int64_t value)
    { return to + std::snprintf(to, most_number_chars, "%lld", static_cast<long long>(value)); });
  contest.run(state);
}

struct Row
{
  int id;
  int type;
  double x[3];
  int image[3];
};

char* print_row(char* to, const Row& row)
{
  to = granular::print_integer(to, row.id);
  *to++ = ' ';
  to = granular::print_integer(to, row.type);
  *to++ = ' ';
  for (const double x : row.x)
  {
    to = granular::print_number(to, x, {});
    *to++ = ' ';
  }
  for (const int image : row.image)
  {
    to = granular::print_integer(to, image);
    *to++ = ' ';
  }
  to[-1] = '\n';
  return to;
}

void fprint_row(std::FILE* file, const Row& row)
{
  std::fprintf(file, "%d %d %g %g %g %d %d %d\n", row.id, row.type, row.x[0], row.x[1], row.x[2],
    row.image[0], row.image[1], row.image[2]);
}

/// Rows into memory: fprintf through a stream that stays there.
void rows(benchmark::State& state, Values values)
{
  Random random(3);
  std::vector<Row> made(values_a_round / 4);
  const auto integer = [&random](std::uint64_t count)
  { return static_cast<int>(random.bits() % count); };
  for (Row& row : made)
  {
    row = { 1 + integer(3'000'000), 1 + integer(2), {},
      { integer(3) - 1, integer(3) - 1, integer(3) - 1 } };
    for (double& x : row.x)
    {
      x = make(values, random);
    }
  }
  Text text((made.size() + 1) * 8 * most_number_chars);
  Text stream_text((made.size() + 1) * 8 * most_number_chars);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
    ::fmemopen(stream_text.begin(), (made.size() + 1) * 8 * most_number_chars, "w"), std::fclose);
  std::size_t size = 0;
  std::size_t stream_size = 0;
  const auto ours = [&]
  {
    char* to = text.begin();
    for (const Row& row : made)
    {
      to = print_row(to, row);
    }
    size = text.until(to).size();
    return true;
  };
  const auto theirs = [&]
  {
    std::rewind(file.get());
    for (const Row& row : made)
    {
      fprint_row(file.get(), row);
    }
    std::fflush(file.get());
    stream_size = static_cast<std::size_t>(std::ftell(file.get()));
    return true;
  };
  ours();
  theirs();
  if (text.until(text.begin() + size) != stream_text.until(stream_text.begin() + stream_size))
  {
    fail(state, "texts differ");
    return;
  }
  Rounds rounds;
  rounds.add("ours", ours);
  rounds.add("fprintf", theirs);
  for (auto _ : state)
  {
    rounds.run(static_cast<double>(made.size()));
    state.SetIterationTime(rounds.of("ours").back());
  }
  tell(state, "ours", 1e9 * median(rounds.of("ours")), "ns");
  tell(state, "fprintf", 1e9 * median(rounds.of("fprintf")), "ns");
  tell(state, "fprintf ratio", median_ratio(rounds.of("fprintf"), rounds.of("ours")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("fprintf"), rounds.of("ours")), "1");
}
}

void add_benchmarks(const Size& size)
{
  struct Case
  {
    const char* name;
    Values values;
    int digits;
  };
  const Case cases[] = {
    { "%g, positions", Values::Position, 6 },
    { "%g, velocities", Values::Velocity, 6 },
    { "%g, half at rest", Values::AtRest, 6 },
    { "%g, zeros", Values::Zero, 6 },
    { "%g, full doubles", Values::Full, 6 },
    { "%.9g, full doubles", Values::Full, 9 },
    { "%.17g, full doubles", Values::Full, 17 },
    { "shortest, positions", Values::Position, 0 },
    { "shortest, full doubles", Values::Full, 0 },
  };
  const std::int64_t count = size.pick(100, 1);
  for (const Case& each : cases)
  {
    add(std::string("print/") + each.name, count,
      [each](benchmark::State& state) { numbers(state, each.values, each.digits); });
  }
  add("print/%d, ids", count, [](benchmark::State& state) { integers(state, 3'000'000, 1); });
  add("print/%d, images", count, [](benchmark::State& state) { integers(state, 3, -1); });
  add(
    "print/row, positions", count, [](benchmark::State& state) { rows(state, Values::Position); });
  add("print/row, full doubles", count, [](benchmark::State& state) { rows(state, Values::Full); });
}
}
