// SPDX-License-Identifier: BSD-3-Clause
// What the benchmarks share: times of several things measured in turns, and how they are told.
//
// The machine may be busy, and the clock of its cores may wander: no time is compared with one
// that was taken at another moment. A round runs every contender once, each on the same work, and
// what is judged is the ratio of times within a round, as the median over many short rounds.
// Times are processor time of the calling thread: what others do to the machine counts less. Only where
// several threads work does the clock on the wall count.
#ifndef tests_bench_bench_h
#define tests_bench_bench_h

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace bench
{
/// How much is to be done.
struct Size
{
  bool full = false;  ///< false: just enough to see that results are right
  bool large = false; ///< also what takes many minutes

  /// The number for a full run, or for a quick one.
  std::int64_t pick(std::int64_t for_full, std::int64_t for_quick) const
  {
    return full ? for_full : for_quick;
  }

  /// The number for a large run, a full one, or a quick one.
  std::int64_t pick(std::int64_t for_large, std::int64_t for_full, std::int64_t for_quick) const
  {
    return large ? for_large : this->pick(for_full, for_quick);
  }
};

/// What a part defines: registers its benchmarks. Their names are part/case.
void add_benchmarks(const Size& size);

/// A benchmark of a fixed number of rounds, of which only a large run does all and a full one a fifth, at least three; its
/// state is to be used in manual time.
void add(const std::string& name, std::int64_t rounds, std::function<void(benchmark::State&)> run);

/// Something is wrong with the results: the benchmark is given up, the program will fail.
void fail(benchmark::State& state, const std::string& what);

/// A figure of the report. Each becomes a line of report.csv.
void tell(
  benchmark::State& state, const std::string& metric, double value, const std::string& unit);

/// Processor time of this thread [s].
double now();

/// Time on the wall [s].
double wall();

/// Processor time of all threads of this program [s].
double processor();

/// Page faults of this thread so far that needed no disk.
std::int64_t page_faults();

using Samples = std::vector<double>;

double median(Samples samples);

/// Median of a[i] / b[i].
double median_ratio(const Samples& a, const Samples& b);

/// Half the distance between the quartiles of a[i] / b[i], relative to the median.
double spread_of_ratio(const Samples& a, const Samples& b);

/// Contenders and what they took, round by round.
class Rounds
{
public:
  explicit Rounds(double (*clock)() = now)
    : clock_(clock)
  {
  }

  /// One contender. Does the same work as the others; gives false when the result is wrong.
  void add(std::string name, std::function<bool()> contender);

  /// One that takes its time itself: it adds the seconds of a pass to what it is given.
  void add_timed(std::string name, std::function<bool(double& seconds)> contender);

  /// Runs everyone once, beginning with another one each time, and notes the time divided by work.
  /// Each runs in repeats passes. False if anyone's result is wrong.
  bool run(double work, int repeats = 1);

  /// All rounds of a benchmark, each as above; the benchmark's own time is that of all contenders. Where a result is
  /// wrong, the benchmark fails with what is said here, and this is false.
  bool run_all(
    benchmark::State& state, const std::string& what_is_wrong, double work, int repeats = 1);

  /// Seconds per unit of work, one a round.
  const Samples& of(std::string_view name) const;

  /// Page faults during the timed parts.
  std::int64_t faults() const noexcept { return faults_; }

private:
  struct Contender
  {
    std::string name;
    std::function<bool(double& seconds)> run;
    bool is_timed;
    Samples samples;
  };

  double (*clock_)();
  std::vector<Contender> contenders_;
  std::size_t first_ = 0;
  std::int64_t faults_ = 0;
};
}
#endif
