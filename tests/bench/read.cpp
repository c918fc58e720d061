// SPDX-License-Identifier: BSD-3-Clause
// The whole way from a file in the page cache to arrays: read_dump against decode_rows alone, for
// more and more rows, and the most memory it takes.
#include "bench.h"
#include "dump_frame.h"
#include "dump_text.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace bench
{
namespace
{
bool is_right(const TextFrame& dump, const granular::DumpFrame& frame)
{
  return frame.rows == dump.count && holds(frame, dump.truth, dump.rows.count);
}

std::string name_of(std::int64_t rows)
{
  int power = 0;
  for (std::int64_t left = rows; left >= 10; left /= 10)
  {
    ++power;
  }
  return "10^" + std::to_string(power) + " rows";
}

/// A number of rows, read once a round; small ones several times.
struct Growing
{
  Growing(std::int64_t count, int times)
    : dump(Form::Custom, count)
    , repeats(times)
  {
  }

  bool run()
  {
    const std::int64_t faults_before = page_faults();
    double seconds = 0;
    for (int repeat = 0; repeat < repeats; ++repeat)
    {
      frame = {}; // given back before the next one is made, and not timed
      const double start = now();
      frame = read_frame(dump.index, 0);
      seconds += now() - start;
    }
    const double rows = static_cast<double>(dump.count) * repeats;
    samples.push_back(seconds / rows);
    faults = static_cast<double>(page_faults() - faults_before) / rows;
    const bool right = is_right(dump, frame);
    frame = {};
    return right;
  }

  TextFrame dump;
  int repeats;
  granular::DumpFrame frame;
  Samples samples;   ///< seconds a row
  double faults = 0; ///< page faults a row
};

void growth(benchmark::State& state, const std::vector<std::int64_t>& counts)
{
  std::vector<std::unique_ptr<Growing>> all;
  for (const std::int64_t count : counts)
  {
    const std::int64_t repeats = std::clamp<std::int64_t>(counts.back() / count / 20, 1, 50);
    all.push_back(std::make_unique<Growing>(count, static_cast<int>(repeats)));
  }
  for (auto _ : state)
  {
    const double start = now();
    for (const auto& each : all)
    {
      if (!each->run())
      {
        fail(state, "values differ from strtod's");
        return;
      }
    }
    state.SetIterationTime(now() - start);
  }
  Samples times;
  for (const auto& each : all)
  {
    const std::string name = name_of(each->dump.count);
    times.push_back(median(each->samples));
    tell(state, name, 1e9 * times.back(), "ns/row");
    tell(state, name + ", page faults a 1000 rows", 1000 * each->faults, "1");
  }
  const auto [least, most] = std::minmax_element(times.begin(), times.end());
  tell(state, "slowest against fastest", *most / *least, "1");
}

void against_decode(benchmark::State& state, Form form, std::int64_t count)
{
  const TextFrame dump(form, count);
  TextInMemory text(dump.rows);
  granular::DumpFrame frame;
  Rounds rounds;
  rounds.add("decode alone", [&text] { return text.decode(); });
  rounds.add("read",
    [&dump, &frame]
    {
      frame = read_frame(dump.index, 0);
      return frame.rows == dump.count;
    });
  for (auto _ : state)
  {
    frame = {};
    if (!rounds.run(static_cast<double>(count)) || !is_right(dump, frame))
    {
      fail(state, "values differ from strtod's");
      return;
    }
    state.SetIterationTime(rounds.of("read").back() * static_cast<double>(count));
  }
  tell(state, "decode alone", 1e9 * median(rounds.of("decode alone")), "ns/row");
  tell(state, "read", 1e9 * median(rounds.of("read")), "ns/row");
  tell(state, "time against decode alone",
    median_ratio(rounds.of("read"), rounds.of("decode alone")), "1");
}

/// What bench_peak_memory, a fresh process, says of a file.
void peak_memory(benchmark::State& state, Form form, std::int64_t count)
{
  const TextFrame dump(form, count);
  const std::string program =
    std::filesystem::read_symlink("/proc/self/exe").replace_filename("bench_peak_memory").string();
  const std::string command = "'" + program + "' '" + dump.file.path() + "'";
  double arrays = 0;
  double kib = 0;
  for (auto _ : state)
  {
    const double start = now();
    std::FILE* const pipe = ::popen(command.c_str(), "r");
    const bool told = pipe && std::fscanf(pipe, "%lf %lf", &arrays, &kib) == 2;
    if (!pipe || ::pclose(pipe) != 0 || !told)
    {
      fail(state, "bench_peak_memory failed");
      return;
    }
    state.SetIterationTime(now() - start);
  }
  std::size_t expected = 0;
  for (std::size_t i = 0; i < dump.rows.arrays.size(); ++i)
  {
    expected += dump.truth.bytes_a_row(i);
  }
  if (arrays != static_cast<double>(expected) * static_cast<double>(count))
  {
    fail(state, "the arrays do not have the size that they should have");
    return;
  }
  constexpr double mib = 1024 * 1024;
  tell(state, "arrays", arrays / mib, "MiB");
  tell(state, "peak", kib / 1024, "MiB");
  tell(state, "above the arrays", kib / 1024 - arrays / mib, "MiB");
}
}

void add_benchmarks(const Size& size)
{
  std::vector<std::int64_t> counts = { 10'000, 100'000, 1'000'000, 10'000'000 };
  if (!size.full)
  {
    counts = { 1'000, 10'000 };
  }
  add("read/more and more rows", size.pick(9, 1),
    [counts](benchmark::State& state) { growth(state, counts); });

  const std::int64_t million = size.pick(1'000'000, 10'000);
  add("read/8 columns", size.pick(21, 1),
    [million](benchmark::State& state) { against_decode(state, Form::Atom, million); });
  add("read/12 columns", size.pick(21, 1),
    [million](benchmark::State& state) { against_decode(state, Form::Custom, million); });

  for (const std::int64_t count : counts)
  {
    if (count >= TextFrame::most_distinct_rows || !size.full)
    {
      add("read/memory, 12 columns, " + name_of(count), 1,
        [count](benchmark::State& state) { peak_memory(state, Form::Custom, count); });
    }
  }
  add("read/memory, 8 columns, " + name_of(million), 1,
    [million](benchmark::State& state) { peak_memory(state, Form::Atom, million); });
}
}
