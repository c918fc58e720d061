// SPDX-License-Identifier: BSD-3-Clause
// Counting the particles of subdomains: time of a particle, against a plain pass that trusts computed indices, for
// grids that are uniform, cut at any positions, and for boxes that form no grid.
#include "bench.h"

#include "granular/decomposition/count_particles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace bench
{
namespace
{
using granular::ParticleCounts;
using granular::ProcessGrid;
using granular::Subdomain;

constexpr granular::Vector3 box_lo = { -0.3, 0.1, 2 };
constexpr granular::Vector3 box_hi = { 1.1, 1.7, 4.5 };

struct Case
{
  std::string name;
  int per_axis; ///< subdomains
  std::int64_t particles;
  bool
    by_process; ///< particles lie in the order of the grid's subdomains, as in a dump; else in no order
};

/// Cuts at random positions, in order.
ProcessGrid uneven_grid(int per_axis, std::mt19937_64& random)
{
  granular::GridRequest request{ box_lo, box_hi, 0, { per_axis, per_axis, per_axis }, {} };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::uniform_real_distribution<double> inside(box_lo[axis], box_hi[axis]);
    std::vector<double>& cuts = request.cuts[axis];
    std::generate_n(std::back_inserter(cuts), per_axis - 1, [&] { return inside(random); });
    std::ranges::sort(cuts);
  }
  return make_process_grid(request);
}

/// Recursive bisection: the longest edge is cut where the particles, which are everywhere alike, are divided as the
/// processes are, so that all have as many, give or take a fifth.
void bisect(
  Subdomain box, std::int64_t processes, std::mt19937_64& random, std::vector<Subdomain>& to)
{
  if (processes == 1)
  {
    to.push_back(box);
    return;
  }
  std::size_t axis = 0;
  for (std::size_t other = 1; other < 3; ++other)
  {
    axis = box.hi[other] - box.lo[other] > box.hi[axis] - box.lo[axis] ? other : axis;
  }
  const std::int64_t lower = processes / 2;
  const double part = static_cast<double>(lower) / static_cast<double>(processes) *
    std::uniform_real_distribution<double>(0.8, 1.2)(random);
  const double cut = box.lo[axis] + part * (box.hi[axis] - box.lo[axis]);
  Subdomain half = box;
  half.hi[axis] = cut;
  bisect(half, lower, random, to);
  half = box;
  half.lo[axis] = cut;
  bisect(half, processes - lower, random, to);
}

/// As anybody would write it who trusts the index: no particle is outside, faces fall where rounding puts them.
/// What is not negative is cut off as floor does it, and faster.
std::int64_t plain_pass(const std::vector<double>& points, int per_axis, bool with_floor,
  std::vector<std::int64_t>& counts)
{
  std::ranges::fill(counts, 0);
  std::array<double, 3> scale;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    scale[axis] = per_axis / (box_hi[axis] - box_lo[axis]);
  }
  const auto index = [&](const double* x, std::size_t axis)
  {
    const double slab = (x[axis] - box_lo[axis]) * scale[axis];
    return std::clamp(static_cast<int>(with_floor ? std::floor(slab) : slab), 0, per_axis - 1);
  };
  for (const double* x = points.data(); x != points.data() + points.size(); x += 3)
  {
    const std::int64_t i = index(x, 0);
    const std::int64_t j = index(x, 1);
    const std::int64_t k = index(x, 2);
    ++counts[static_cast<std::size_t>((i * per_axis + j) * per_axis + k)];
  }
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 });
}

std::vector<double> make_points(const Case& each, std::mt19937_64& random)
{
  std::vector<double> points;
  for (std::int64_t i = 0; i < each.particles; ++i)
  {
    std::int64_t rest = i * each.per_axis * each.per_axis * each.per_axis / each.particles;
    granular::Vector3 point;
    for (std::size_t axis = 3; axis-- > 0;)
    {
      double part = std::uniform_real_distribution<double>(0, 1)(random);
      if (each.by_process)
      {
        part = (static_cast<double>(rest % each.per_axis) + part) / each.per_axis;
        rest /= each.per_axis;
      }
      point[axis] = box_lo[axis] + part * (box_hi[axis] - box_lo[axis]);
    }
    points.insert(points.end(), point.begin(), point.end());
  }
  return points;
}

/// Everything of a case, and what each contender has counted.
struct Data
{
  explicit Data(const Case& each)
    : points(make_points(each, random))
    , counts(static_cast<std::size_t>(std::pow(each.per_axis, 3)))
    , even(granular::make_process_grid(
        { box_lo, box_hi, 0, { each.per_axis, each.per_axis, each.per_axis }, {} }))
    , uneven(uneven_grid(each.per_axis, random))
  {
    bisect({ box_lo, box_hi }, static_cast<std::int64_t>(counts.size()), random, bisected);
    std::ranges::shuffle(bisected, random);
    frame.rows = each.particles;
    frame.has_box = false;
    frame.points = granular::view_rows("points", granular::ValueType::Float64, points.data(), 3);
  }

  bool is_all(const ParticleCounts& counted) const
  {
    return counted.outside == 0 &&
      std::accumulate(counted.particles.begin(), counted.particles.end(), std::int64_t{ 0 }) ==
      frame.rows;
  }

  bool count(const ProcessGrid& grid) const
  {
    granular::Progress progress;
    return this->is_all(count_in_grid(frame, grid, granular::Executor(1), progress));
  }

  bool count_bisected(int threads) const
  {
    granular::Progress progress;
    return this->is_all(
      count_in_subdomains(frame, bisected, granular::Executor(threads), progress));
  }

  std::mt19937_64 random{ 3 };
  std::vector<double> points;
  std::vector<std::int64_t> counts;
  ProcessGrid even;
  ProcessGrid uneven;
  std::vector<Subdomain> bisected;
  granular::FrameView frame;
};

void measure(benchmark::State& state, const Case& each)
{
  Data data(each);
  Rounds rounds;
  const auto plain = [&](bool with_floor)
  { return plain_pass(data.points, each.per_axis, with_floor, data.counts) == each.particles; };
  rounds.add("plain", [&] { return plain(false); });
  rounds.add("plain, floor", [&] { return plain(true); });
  rounds.add("even", [&] { return data.count(data.even); });
  rounds.add("uneven", [&] { return data.count(data.uneven); });
  rounds.add("bisection", [&] { return data.count_bisected(1); });
  if (!rounds.run_all(state, "not all particles are counted", static_cast<double>(each.particles)))
  {
    return;
  }
  const Samples& base = rounds.of("plain");
  tell(state, "plain", 1e9 * median(base), "ns/particle");
  for (const std::string name : { "plain, floor", "even", "uneven", "bisection" })
  {
    tell(state, name, 1e9 * median(rounds.of(name)), "ns/particle");
    tell(state, name + ", time against plain", median_ratio(rounds.of(name), base), "1");
  }
  tell(state, "spread", spread_of_ratio(rounds.of("even"), base), "1");
}
}

void add_benchmarks(const Size& size)
{
  const std::int64_t million = size.pick(1'000'000, 3'000);
  const std::int64_t most = size.pick(10'000'000, 2'000'000, 5'000);
  const int hundred = static_cast<int>(size.pick(100, 7));
  const Case cases[] = {
    { "2 x 2 x 2", 2, million, false },
    { "10 x 10 x 10", 10, million, false },
    { "10 x 10 x 10, by process", 10, million, true },
    { "30 x 30 x 30", size.full ? 30 : 5, million, false },
    { "100 x 100 x 100, more", hundred, most, false },
    { "100 x 100 x 100, more, by process", hundred, most, true },
  };
  for (const Case& each : cases)
  {
    add("count/" + each.name, size.pick(each.particles == most ? 5 : 25, 1),
      [each](benchmark::State& state) { measure(state, each); });
  }
}
}
