// SPDX-License-Identifier: BSD-3-Clause
// One frame read by more and more ranks together, one thread each, time on the wall between barriers.
#include "bench.h"
#include "dump_frame.h"
#include "helper.h"

#include "granular/parallel/executor.h"

#include <cstdlib>

namespace bench
{
namespace
{
std::string name_of(int ranks)
{
  return std::to_string(ranks) + (ranks == 1 ? " rank" : " ranks");
}

void measure(benchmark::State& state, const std::string& how, std::int64_t rows)
{
  const TextFrame dump(Form::Custom, rows);
  const std::vector<int> counts =
    granular::available_cores() < 4 ? std::vector{ 1, 2 } : std::vector{ 1, 2, 4 };
  Helper helper(GRANULAR_MPIEXEC " " + std::to_string(counts.back()) + " '" +
    program_beside("bench_ranks_helper") + "' '" + dump.file.path() + "' " + std::to_string(rows));
  Rounds rounds;
  for (const int ranks : counts)
  {
    const std::string question = std::to_string(ranks) + " " + how;
    if (helper.ask("check " + question) != "right")
    {
      fail(state, name_of(ranks) + ": values differ from strtod's");
      return;
    }
    rounds.add_timed(name_of(ranks),
      [&helper, question](double& seconds)
      {
        seconds += std::strtod(helper.ask("time " + question).c_str(), nullptr);
        return true;
      });
  }
  for (auto _ : state)
  {
    rounds.run(static_cast<double>(rows));
    state.SetIterationTime(rounds.of(name_of(1)).back() * static_cast<double>(rows));
  }
  for (const int ranks : counts)
  {
    const Samples& one = rounds.of(name_of(1));
    const Samples& ours = rounds.of(name_of(ranks));
    tell(state, name_of(ranks), 1e9 * median(ours), "ns/row");
    tell(state, name_of(ranks) + ", speed against 1 rank", median_ratio(one, ours), "1");
    tell(state, name_of(ranks) + ", spread", spread_of_ratio(one, ours), "1");
  }
}
}

void add_benchmarks(const Size& size)
{
  const std::int64_t rows = size.pick(1'000'000, 10'000);
  for (const std::string how : { "in the file's order", "sorted by id" })
  {
    add("ranks/" + how, size.pick(31, 1),
      [rows, how](benchmark::State& state)
      { measure(state, how.starts_with("sorted") ? "sorted" : "plain", rows); });
  }
}
}
