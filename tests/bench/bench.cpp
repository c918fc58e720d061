// SPDX-License-Identifier: BSD-3-Clause
#include "bench.h"

#include "granular/parallel/executor.h"
#include "granular/text/row_text.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include <sys/resource.h>

namespace bench
{
namespace
{
bool failed = false;
bool all_rounds = false; ///< in a large run

double read_clock(clockid_t clock)
{
  std::timespec time = {};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Samples ratios(const Samples& a, const Samples& b)
{
  Samples found;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    found.push_back(a[i] / b[i]);
  }
  return found;
}

double quantile(Samples samples, double fraction)
{
  if (samples.empty())
  {
    throw std::logic_error("no samples");
  }
  std::sort(samples.begin(), samples.end());
  const double place = fraction * static_cast<double>(samples.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, samples.size() - 1);
  const double part = place - static_cast<double>(below);
  return samples[below] + part * (samples[above] - samples[below]);
}
}

void add(const std::string& name, std::int64_t rounds, std::function<void(benchmark::State&)> run)
{
  const std::int64_t fewer =
    all_rounds ? rounds : std::min(rounds, std::max<std::int64_t>(3, rounds / 5));
  benchmark::RegisterBenchmark(name.c_str(), std::move(run))->Iterations(fewer)->UseManualTime();
}

void fail(benchmark::State& state, const std::string& what)
{
  failed = true;
  state.SkipWithError(what.c_str());
}

void tell(benchmark::State& state, const std::string& metric, double value, const std::string& unit)
{
  state.counters[metric + ":" + unit] = value;
}

double now()
{
  return read_clock(CLOCK_THREAD_CPUTIME_ID);
}

double wall()
{
  return read_clock(CLOCK_MONOTONIC);
}

double processor()
{
  return read_clock(CLOCK_PROCESS_CPUTIME_ID);
}

std::int64_t page_faults()
{
  struct rusage usage = {};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt;
}

double median(Samples samples)
{
  return quantile(std::move(samples), 0.5);
}

double median_ratio(const Samples& a, const Samples& b)
{
  return quantile(ratios(a, b), 0.5);
}

double spread_of_ratio(const Samples& a, const Samples& b)
{
  const Samples all = ratios(a, b);
  return (quantile(all, 0.75) - quantile(all, 0.25)) / 2 / quantile(all, 0.5);
}

void Rounds::add(std::string name, std::function<bool()> contender)
{
  contenders_.push_back(
    { std::move(name), [run = std::move(contender)](double&) { return run(); }, false, {} });
}

void Rounds::add_timed(std::string name, std::function<bool(double& seconds)> contender)
{
  contenders_.push_back({ std::move(name), std::move(contender), true, {} });
}

bool Rounds::run(double work, int repeats)
{
  bool right = true;
  for (std::size_t i = 0; i < contenders_.size(); ++i)
  {
    Contender& contender = contenders_[(first_ + i) % contenders_.size()];
    const std::int64_t faults = page_faults();
    double seconds = 0;
    const double start = clock_();
    for (int repeat = 0; repeat < repeats; ++repeat)
    {
      right = contender.run(seconds) && right;
      benchmark::ClobberMemory();
    }
    seconds = contender.is_timed ? seconds : clock_() - start;
    contender.samples.push_back(seconds / (work * repeats));
    faults_ += page_faults() - faults;
  }
  ++first_;
  return right;
}

bool Rounds::run_all(
  benchmark::State& state, const std::string& what_is_wrong, double work, int repeats)
{
  for (auto _ : state)
  {
    if (!this->run(work, repeats))
    {
      fail(state, what_is_wrong);
      return false;
    }
    double seconds = 0;
    for (const Contender& contender : contenders_)
    {
      seconds += contender.samples.back() * work * repeats;
    }
    state.SetIterationTime(seconds);
  }
  return true;
}

const Samples& Rounds::of(std::string_view name) const
{
  const auto found = std::find_if(contenders_.begin(), contenders_.end(),
    [name](const Contender& contender) { return contender.name == name; });
  if (found == contenders_.end())
  {
    throw std::logic_error("no contender of that name");
  }
  return found->samples;
}
}

/// program [--full | --large] [flags of Google Benchmark]: fails on wrong results, never on time.
int main(int argc, char** argv)
try
{
  bench::Size size;
  char** const last = std::remove_if(argv + 1, argv + argc,
    [&size](const std::string_view argument)
    {
      const bool large = argument == "--large";
      const bool full = large || argument == "--full";
      size.full = size.full || full;
      size.large = size.large || large;
      return full;
    });
  argc = static_cast<int>(last - argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return 1;
  }
#ifdef __clang__
  benchmark::AddCustomContext("compiler", "Clang " __clang_version__);
#else
  benchmark::AddCustomContext("compiler", "GCC " __VERSION__);
#endif
  benchmark::AddCustomContext("instruction set", to_string(granular::best_simd()));
  benchmark::AddCustomContext("cores", std::to_string(granular::available_cores()));
  bench::all_rounds = size.large;
  bench::add_benchmarks(size);
  benchmark::RunSpecifiedBenchmarks();
  return bench::failed ? 1 : 0;
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
