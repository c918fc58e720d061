// SPDX-License-Identifier: BSD-3-Clause
// A frame opened in ParaView, from nothing to its data: a text dump, against the same data in VTK's own
// files.
#include "bench.h"
#include "checksum.h"
#include "dump_frame.h"
#include "helper.h"

#include <cstdlib>

namespace bench
{
namespace
{
/// One for all cases: it takes its time to start.
Helper& paraview()
{
  static Helper helper(GRANULAR_HELPER);
  return helper;
}

/// What is opened again and again.
struct Opening
{
  const char* name;
  std::string file; ///< and, of a dump, the number of threads, 0 for all cores
};

bool open(Helper& helper, const Opening& opening, double& seconds)
{
  seconds += std::strtod(helper.ask("time|" + opening.file).c_str(), nullptr);
  return true;
}

/// The compressor by ParaView's name for it.
void measure(benchmark::State& state, std::int64_t rows, const std::string& compressor)
{
  const TextFrame dump(Form::Custom, rows);
  const std::string truth = checksums(dump.truth, rows);
  const std::string path = dump.file.path();
  const TemporaryFile saved(".vtp");
  Helper& helper = paraview();
  helper.ask("save|" + path + "|" + saved.path() + "|" + compressor);
  const Opening texts[] = { { "text, 1 thread", path + "|1" },
    { "text, all threads", path + "|0" } };
  const Opening vtp = { "vtp", saved.path() };
  const std::string told = helper.ask("look|" + vtp.file);
  // some versions of libexpat refuse what ParaView itself has written
  const bool readable = told != "unreadable";
  Rounds rounds;
  rounds.add_timed("vtp", [&](double& seconds) { return !readable || open(helper, vtp, seconds); });
  bool right = !readable || told == truth;
  for (const Opening& each : texts)
  {
    right = right && helper.ask("look|" + each.file) == truth;
    rounds.add_timed(
      each.name, [&helper, each](double& seconds) { return open(helper, each, seconds); });
  }
  if (!right)
  {
    fail(state, "values differ from strtod's");
    return;
  }
  for (auto _ : state)
  {
    rounds.run(1);
    state.SetIterationTime(rounds.of("text, 1 thread").back());
  }
  for (const std::string name : { "vtp", "text, 1 thread", "text, all threads" })
  {
    if (readable || name != "vtp")
    {
      tell(state, name, 1e3 * median(rounds.of(name)), "ms");
    }
    if (readable && name != "vtp")
    {
      tell(
        state, name + ", time against vtp", median_ratio(rounds.of(name), rounds.of("vtp")), "1");
      tell(state, name + ", spread", spread_of_ratio(rounds.of(name), rounds.of("vtp")), "1");
    }
  }
}
}

void add_benchmarks(const Size& size)
{
  const struct
  {
    const char* name;
    const char* compressor;
  } cases[] = { { "not compressed", "None" }, { "ZLib", "ZLib" } };
  for (const auto& each : cases)
  {
    add(std::string("vtp/") + each.name, size.pick(15, 1),
      [rows = size.pick(1'000'000, 1'000), each](benchmark::State& state)
      { measure(state, rows, each.compressor); });
  }
}
}
