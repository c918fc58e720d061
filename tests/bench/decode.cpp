// SPDX-License-Identifier: BSD-3-Clause
// Rows of text into columns in memory: decode_rows against a plain loop with std::from_chars.
#include "bench.h"
#include "dump_text.h"

#include "granular/text/row_text.h"

#include <cstring>
#include <limits>

namespace bench
{
namespace
{
using granular::ColumnSink;
using granular::Simd;

/// A few milliseconds a round. The text as a whole is larger than the caches.
constexpr std::size_t slice_bytes = std::size_t{ 1 } << 21;

/// A text, its true values, and memory for those of the contenders.
struct Work
{
  Work(Form form, std::int64_t count)
    : rows(make_rows(form, count))
    , text(padded(rows.text))
    , slices(cut(text.data(), text.data() + text.size(), slice_bytes))
    , truth(rows, count)
    , output(rows, count)
  {
    std::vector<ColumnSink> sinks = truth.sinks(0);
    right = parse_slowly(rows.text.c_str(), sinks, count);
    slice = slices.front();
  }

  bool decode(Simd simd, std::size_t first_column, std::size_t columns)
  {
    const std::vector<ColumnSink> all = output.sinks(slice.row);
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(first_column);
    std::vector<ColumnSink> sinks(from, from + static_cast<std::ptrdiff_t>(columns));
    const granular::RowResult result = granular::decode_rows(
      slice.first, slice.last, rows.words(), sinks, std::numeric_limits<std::int64_t>::max(), simd);
    return result.status == granular::RowStatus::Done && result.rows == slice.rows &&
      !result.surplus && result.ptr == slice.last;
  }

  bool decode(Simd simd) { return this->decode(simd, 0, rows.words()); }

  bool parse()
  {
    std::vector<Output::Place> places = output.places(slice.row);
    return parse_plainly(slice.first, slice.last, places, slice.rows) != nullptr;
  }

  /// Whether a contender gets every value right, to the bit.
  template <class Run>
  bool check(Run&& run)
  {
    output.spoil();
    bool good = right;
    for (const Slice& each : slices)
    {
      slice = each;
      good = run() && good;
    }
    return good && output == truth;
  }

  /// Whether what is decoded of some columns is right, and the others are left alone.
  bool check_columns(Simd simd, std::size_t first_column, std::size_t columns)
  {
    output.spoil();
    Output expected = output;
    slice = slices.front();
    const std::vector<ColumnSink> from = truth.sinks(slice.row);
    const std::vector<ColumnSink> to = expected.sinks(slice.row);
    for (std::size_t i = first_column; i < first_column + columns; ++i)
    {
      const std::size_t bytes = from[i].type == ValueType::Int32 ? 4 : 8;
      for (std::ptrdiff_t row = 0; row < slice.rows; ++row)
      {
        std::memcpy(to[i].data + row * to[i].stride, from[i].data + row * from[i].stride, bytes);
      }
    }
    return right && this->decode(simd, first_column, columns) && output == expected;
  }

  Rows rows;
  granular::PaddedBuffer text;
  std::vector<Slice> slices;
  Output truth;
  Output output;
  Slice slice = {};
  bool right = false;
};

/// One slice a round, going through the text as often as there are rounds.
void run_rounds(benchmark::State& state, Work& work, Rounds& rounds, const std::string& judged)
{
  std::size_t next = 0;
  for (auto _ : state)
  {
    work.slice = work.slices[next++ % work.slices.size()];
    const auto bytes = static_cast<double>(work.slice.last - work.slice.first);
    if (!rounds.run(bytes))
    {
      fail(state, "a row was not decoded");
      return;
    }
    state.SetIterationTime(rounds.of(judged).back() * bytes);
  }
}

void speed(benchmark::State& state, Form form, std::int64_t count)
{
  Work work(form, count);
  Rounds rounds;
  rounds.add("from_chars", [&work] { return work.parse(); });
  if (!work.check([&work] { return work.parse(); }))
  {
    fail(state, "from_chars: values differ from strtod's");
    return;
  }
  for (const Simd simd : granular::instruction_sets())
  {
    rounds.add(to_string(simd), [&work, simd] { return work.decode(simd); });
    if (!work.check([&work, simd] { return work.decode(simd); }))
    {
      fail(state, std::string(to_string(simd)) + ": values differ from strtod's");
      return;
    }
  }
  const std::string judged = to_string(granular::best_simd());
  run_rounds(state, work, rounds, judged);
  const Samples& plain = rounds.of("from_chars");
  tell(state, "from_chars", 1e-9 / median(plain), "GB/s");
  for (const Simd simd : granular::instruction_sets())
  {
    const std::string name = to_string(simd);
    const Samples& ours = rounds.of(name);
    tell(state, name, 1e-9 / median(ours), "GB/s");
    tell(state, name + " ratio", median_ratio(plain, ours), "1");
  }
  const Samples& ours = rounds.of(judged);
  tell(state, "ratio", median_ratio(plain, ours), "1");
  tell(state, "ratio spread", spread_of_ratio(plain, ours), "1");
  tell(state, "bytes a row",
    static_cast<double>(work.rows.text.size()) / static_cast<double>(count), "B");
  tell(state, "page faults while timing", static_cast<double>(rounds.faults()), "1");
}

/// Some columns of twelve against all of them.
void columns(benchmark::State& state, std::size_t first, std::int64_t count)
{
  Work work(Form::Custom, count);
  const Simd simd = granular::best_simd();
  if (!work.check_columns(simd, first, 3))
  {
    fail(state, "values of three columns differ from strtod's");
    return;
  }
  Rounds rounds;
  rounds.add("all", [&work, simd] { return work.decode(simd); });
  rounds.add("three", [&work, simd, first] { return work.decode(simd, first, 3); });
  run_rounds(state, work, rounds, "three");
  tell(state, "time against all", median_ratio(rounds.of("three"), rounds.of("all")), "1");
  tell(
    state, "time against all spread", spread_of_ratio(rounds.of("three"), rounds.of("all")), "1");
  tell(state, "page faults while timing", static_cast<double>(rounds.faults()), "1");
}
}

void add_benchmarks(const Size& size)
{
  struct Case
  {
    const char* name;
    Form form;
    std::int64_t rows;
  };
  const std::int64_t million = size.pick(1'000'000, 3'000);
  const std::int64_t some = size.pick(200'000, 3'000);
  const Case cases[] = {
    { "8 columns %g", Form::Atom, million },
    { "12 columns %g", Form::Custom, million },
    { "12 columns %.16e", Form::CustomFull, some },
    { "12 columns %.6f", Form::CustomFixed, some },
    { "12 columns %g, half at rest", Form::CustomAtRest, some },
    { "12 columns %g, tiny values", Form::Tiny, some },
    { "12 columns %g, extreme values", Form::Extreme, some },
    { "12 columns of integers", Form::Integers, some },
  };
  const std::int64_t rounds = size.pick(150, 1);
  for (const Case& each : cases)
  {
    add(std::string("decode/") + each.name, rounds,
      [each](benchmark::State& state) { speed(state, each.form, each.rows); });
  }
  add("decode/first three of 12", rounds,
    [million](benchmark::State& state) { columns(state, 0, million); });
  add("decode/last three of 12", rounds,
    [million](benchmark::State& state) { columns(state, 9, million); });
}
}
