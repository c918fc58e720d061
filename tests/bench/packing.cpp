// SPDX-License-Identifier: BSD-3-Clause
// Grains without a file: time for each, one thread against two, and what is made against the rules.
#include "bench.h"

#include "granular/packing/packing.h"

#include <cstdint>
#include <string>

namespace bench
{
namespace
{
using granular::Arrangement;
using granular::PackingRequest;

struct Case
{
  const char* name;
  Arrangement arrangement;
  granular::RadiusChoice::Kind radii;
  double solid_fraction;
  std::int64_t grains;
};

PackingRequest request_of(const Case& each, int threads)
{
  PackingRequest request;
  request.arrangement = each.arrangement;
  request.grains = each.grains;
  request.boundary = "pp pp pp";
  request.radii = { each.radii, 0.5, 0.3, 0.3 };
  request.solid_fraction = each.solid_fraction;
  request.speed = 1;
  request.threads = threads;
  request.ranges = true;
  return request;
}

bool make(const PackingRequest& request)
{
  granular::Progress progress;
  const granular::DumpFrame frame = granular::make_packing(request, progress);
  return frame.rows == request.grains && frame.points_range.known();
}

/// Memory is new each time, as it is for a user.
void measure(benchmark::State& state, const Case& each)
{
  Rounds rounds(wall);
  rounds.add("1 thread", [&each] { return make(request_of(each, 1)); });
  rounds.add("2 threads", [&each] { return make(request_of(each, 2)); });
  for (auto _ : state)
  {
    if (!rounds.run(static_cast<double>(each.grains)))
    {
      fail(state, "not as many grains as asked for");
      return;
    }
    state.SetIterationTime(rounds.of("1 thread").back() * static_cast<double>(each.grains));
  }
  tell(state, "1 thread", 1e9 * median(rounds.of("1 thread")), "ns/grain");
  tell(state, "2 threads", 1e9 * median(rounds.of("2 threads")), "ns/grain");
  tell(
    state, "speed of 2 threads", median_ratio(rounds.of("1 thread"), rounds.of("2 threads")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("1 thread"), rounds.of("2 threads")), "1");
}
}

void add_benchmarks(const Size& size)
{
  using Kind = granular::RadiusChoice::Kind;
  const std::int64_t million = size.pick(1'000'000, 3'000);
  const std::int64_t most = size.pick(10'000'000, 5'000);
  const Case cases[] = {
    { "simple cubic", Arrangement::SimpleCubic, Kind::One, 0.2, million },
    { "face-centred cubic", Arrangement::FaceCentredCubic, Kind::One, 0.2, million },
    { "hexagonal, a range of radii", Arrangement::Hexagonal, Kind::Range, 0.2, million },
    { "random, 0.1", Arrangement::Random, Kind::One, 0.1, million },
    { "random, 0.2", Arrangement::Random, Kind::One, 0.2, million },
    { "random, 0.2, two radii", Arrangement::Random, Kind::Two, 0.2, million },
    { "random, 0.3", Arrangement::Random, Kind::One, 0.3, million },
    { "random, 0.2, ten times as many", Arrangement::Random, Kind::One, 0.2, most },
  };
  for (const Case& each : cases)
  {
    const bool long_one = each.grains == most || each.solid_fraction > 0.25;
    add(std::string("packing/") + each.name, size.pick(long_one ? 1 : 7, 1),
      [each](benchmark::State& state) { measure(state, each); });
  }
}
}
