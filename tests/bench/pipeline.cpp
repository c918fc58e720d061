// SPDX-License-Identifier: BSD-3-Clause
// A run stepped through in ParaView, against decode_rows alone on the same text.
#include "bench.h"
#include "checksum.h"
#include "dump_frame.h"
#include "helper.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>

namespace bench
{
namespace
{
constexpr int frames = 10;
constexpr int steps =
  4; ///< in a turn; another frame goes before, so that all is as in the middle of a run

/// A file of frames with the same rows; each begins with other ones.
struct Run
{
  explicit Run(std::int64_t count)
    : rows(make_rows(Form::Custom, count))
    , truth(rows, count)
  {
    std::vector<granular::ColumnSink> sinks = truth.sinks(0);
    if (!parse_slowly(rows.text.c_str(), sinks, count))
    {
      throw std::logic_error("the benchmark's own text is wrong");
    }
    const std::vector<Slice> slices =
      cut(rows.text.data(), rows.text.data() + rows.text.size(), rows.text.size() / frames);
    for (int frame = 0; frame < frames; ++frame)
    {
      const Slice& first = slices[static_cast<std::size_t>(frame) % slices.size()];
      const std::string_view text = rows.text;
      const auto at = static_cast<std::size_t>(first.first - rows.text.data());
      file.append(header(frame, count, 0, 1, Print::Full, rows));
      file.append(text.substr(at));
      file.append(text.substr(0, at));
      first_rows.push_back(first.row);
    }
  }

  Rows rows;
  Output truth;
  TemporaryFile file;
  std::vector<std::int64_t> first_rows; ///< of truth, at which each frame begins
};

/// Who takes turns, and whether one thread does all the work.
struct Contender
{
  const char* name;
  bool one_thread;
};

constexpr Contender contenders[] = { { "1 thread", true }, { "1 thread, no pool", true },
  { "1 thread, and data information", true }, { "1 thread, prefetch", false },
  { "1 thread, and a filter", true }, { "1 thread, prefetch, and a filter", false },
  { "all threads", false } };

/// The decoder takes as many frames as the others do steps.
bool decode(TextInMemory& text, double& seconds, Samples& processor)
{
  const double start = wall();
  const double processor_start = now();
  bool right = true;
  for (int step = 0; step < steps; ++step)
  {
    right = text.decode() && right;
  }
  seconds += wall() - start;
  processor.push_back(now() - processor_start);
  return right;
}

/// In ParaView: steps from one half of the run and the other, so that no frame comes twice in a row.
bool step(
  Helper& helper, const std::string& name, std::size_t turn, double& seconds, Samples& processor)
{
  const std::string first = std::to_string(turn % 2 * (frames / 2));
  const std::string answer =
    helper.ask("steps|" + name + "|" + first + "|" + std::to_string(steps));
  char* end = nullptr;
  seconds += std::strtod(answer.c_str(), &end);
  processor.push_back(std::strtod(end, &end));
  return *end == '\0';
}

void tell_times(
  benchmark::State& state, const Rounds& rounds, const std::map<std::string, Samples>& processor)
{
  const std::string alone = "decode alone";
  tell(state, alone, 1e9 * median(rounds.of(alone)), "ns/row");
  for (const Contender& each : contenders)
  {
    const std::string name = each.name;
    const Samples& ours = rounds.of(name);
    tell(state, name, 1e9 * median(ours), "ns/row");
    tell(state, name + ", time against decode", median_ratio(ours, rounds.of(alone)), "1");
    tell(state, name + ", spread", spread_of_ratio(ours, rounds.of(alone)), "1");
    if (each.one_thread)
    {
      tell(state, name + ", processor time against decode",
        median_ratio(processor.at(name), processor.at(alone)), "1");
    }
  }
}

void measure(benchmark::State& state, std::int64_t rows)
{
  const Run run(rows);
  TextInMemory text(run.rows);
  Helper helper(GRANULAR_HELPER);
  helper.ask("open|" + run.file.path());
  Rounds rounds;
  std::map<std::string, Samples> processor;
  rounds.add_timed("decode alone",
    [&](double& seconds) { return decode(text, seconds, processor["decode alone"]); });
  for (const Contender& each : contenders)
  {
    const std::string name = each.name;
    for (int frame = 0; frame < frames; frame += 3)
    {
      const std::string told = helper.ask("check|" + name + "|" + std::to_string(frame));
      if (told != checksums(run.truth, rows, run.first_rows[static_cast<std::size_t>(frame)]))
      {
        fail(state, name + ": values differ from strtod's");
        return;
      }
    }
    rounds.add_timed(name,
      [&helper, &processor, name, turn = std::size_t{ 0 }](double& seconds) mutable
      { return step(helper, name, turn++, seconds, processor[name]); });
  }
  if (!rounds.run_all(state, "frames are missing", static_cast<double>(rows * steps)))
  {
    return;
  }
  tell_times(state, rounds, processor);
}
}

void add_benchmarks(const Size& size)
{
  add("pipeline/12 columns", size.pick(7, 1),
    [rows = size.pick(1'000'000, 300'000, 1'000)](benchmark::State& state)
    { measure(state, rows); });
}
}
