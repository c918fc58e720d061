// SPDX-License-Identifier: BSD-3-Clause
// Grains without a file, and bonds between them: time for each, one thread against two, many against few, and
// what is made against the rules.
#include "bench.h"

#include "granular/packing/bonds.h"
#include "granular/packing/packing.h"
#include "granular/packing/packing_plan.h"

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
  if (!rounds.run_all(state, "not as many grains as asked for", static_cast<double>(each.grains)))
  {
    return;
  }
  tell(state, "1 thread", 1e9 * median(rounds.of("1 thread")), "ns/grain");
  tell(state, "2 threads", 1e9 * median(rounds.of("2 threads")), "ns/grain");
  tell(
    state, "speed of 2 threads", median_ratio(rounds.of("1 thread"), rounds.of("2 threads")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("1 thread"), rounds.of("2 threads")), "1");
}

struct BondCase
{
  const char* name;
  Arrangement arrangement;
  double factor;
  std::int64_t few;
  std::int64_t many;
};

/// Bonds of so many grains, made before, again and again until there were as many as asked for.
class MadeGrains
{
public:
  MadeGrains(const BondCase& each, std::int64_t grains, int threads)
    : factor_(each.factor)
    , times_(each.many / grains)
    , request_(request_of({ each.name, each.arrangement, {}, 0.2, grains }, threads))
    , plan_(request_, alone_, progress_)
    , frame_(granular::make_packing(plan_, progress_))
  {
  }

  bool bond()
  {
    for (std::int64_t i = 0; i < times_; ++i)
    {
      bonds_ = granular::make_bonds(plan_, frame_, factor_, progress_).count;
    }
    return bonds_ > 0;
  }

  double bonds_a_grain() const
  {
    return static_cast<double>(bonds_) / static_cast<double>(request_.grains);
  }

private:
  double factor_;
  std::int64_t times_;
  granular::Progress progress_;
  PackingRequest request_;
  granular::SerialCommunicator alone_;
  granular::PackingPlan plan_;
  granular::DumpFrame frame_;
  std::int64_t bonds_ = 0;
};

void measure_bonds(benchmark::State& state, const BondCase& each)
{
  MadeGrains few(each, each.few, 1);
  MadeGrains many(each, each.many, 1);
  MadeGrains shared(each, each.many, 2);
  Rounds rounds(wall);
  rounds.add("few", [&few] { return few.bond(); });
  rounds.add("many", [&many] { return many.bond(); });
  rounds.add("2 threads", [&shared] { return shared.bond(); });
  const auto grains = static_cast<double>(each.many);
  if (!rounds.run_all(state, "no bonds", grains))
  {
    return;
  }
  tell(state, "bonds a grain", many.bonds_a_grain(), "1");
  tell(state, "few", 1e9 * median(rounds.of("few")) / few.bonds_a_grain(), "ns/bond");
  tell(state, "many", 1e9 * median(rounds.of("many")) / many.bonds_a_grain(), "ns/bond");
  tell(state, "many by few", median_ratio(rounds.of("many"), rounds.of("few")), "1");
  tell(state, "speed of 2 threads", median_ratio(rounds.of("many"), rounds.of("2 threads")), "1");
}
}

void add_benchmarks(const Size& size)
{
  using Kind = granular::RadiusChoice::Kind;
  const std::int64_t million = size.pick(1'000'000, 3'000);
  const std::int64_t most = size.pick(10'000'000, 3'000'000, 5'000);
  const Case cases[] = {
    { "simple cubic", Arrangement::SimpleCubic, Kind::One, 0.2, million },
    { "face-centred cubic", Arrangement::FaceCentredCubic, Kind::One, 0.2, million },
    { "hexagonal, a range of radii", Arrangement::Hexagonal, Kind::Range, 0.2, million },
    { "random, 0.1", Arrangement::Random, Kind::One, 0.1, million },
    { "random, 0.2", Arrangement::Random, Kind::One, 0.2, million },
    { "random, 0.2, two radii", Arrangement::Random, Kind::Two, 0.2, million },
    { "random, 0.3", Arrangement::Random, Kind::One, 0.3, million },
    { "random, 0.2, more", Arrangement::Random, Kind::One, 0.2, most },
  };
  for (const Case& each : cases)
  {
    const bool long_one = each.grains == most || each.solid_fraction > 0.25;
    add(std::string("packing/") + each.name, size.pick(long_one ? 1 : 7, 1),
      [each](benchmark::State& state) { measure(state, each); });
  }
  const std::int64_t few = size.pick(10'000, 1'000);
  const BondCase bonds[] = {
    { "random, 1.5", Arrangement::Random, 1.5, few, million },
    { "simple cubic, 1.05", Arrangement::SimpleCubic, 1.05, few, million },
    { "hexagonal, 1.05", Arrangement::Hexagonal, 1.05, few, million },
    { "bundle", Arrangement::FibreBundle, 1, few, million },
  };
  for (const BondCase& each : bonds)
  {
    add(std::string("bonds/") + each.name, size.pick(5, 1),
      [each](benchmark::State& state) { measure_bonds(state, each); });
  }
}
}
