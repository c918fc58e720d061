// SPDX-License-Identifier: BSD-3-Clause
// Subdomains as voxels, their checks and their text: time for each, and against writing arrays of that size once.
#include "bench.h"

#include "../decomposition/made_subdomains.h"

#include "granular/decomposition/decomposition_text.h"
#include "granular/decomposition/voxels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

namespace bench
{
namespace
{
using namespace granular;

struct Case
{
  const char* name;
  const Subdomains& subdomains;
  bool shared;
};

/// Both arrays, of values that cost nothing to make.
bool write_arrays(
  std::int64_t points, std::size_t subdomains, const std::shared_ptr<BlockPool>& pool)
{
  const auto values = static_cast<std::size_t>(3 * points);
  const Block point_block(values * sizeof(double), pool);
  const Block cell_block(8 * subdomains * sizeof(std::int64_t), pool);
  auto* const point_values = static_cast<double*>(point_block.data());
  auto* const cells = static_cast<std::int64_t*>(cell_block.data());
  std::fill_n(point_values, values, 0.5);
  std::fill_n(cells, 8 * subdomains, 5);
  benchmark::DoNotOptimize(point_values[values - 1]);
  benchmark::DoNotOptimize(cells[8 * subdomains - 1]);
  return true;
}

/// Whether each cell has the corners of its subdomain.
bool is_right(const Voxels& voxels, const Subdomains& subdomains)
{
  const auto* points = static_cast<const Vector3*>(voxels.points.data());
  const auto* cells = static_cast<const std::int64_t*>(voxels.connectivity.data());
  for (std::size_t p = 0; p < subdomains.size(); ++p)
  {
    std::array<Vector3, corners_of_voxel> corners;
    std::transform(cells + 8 * p, cells + 8 * p + 8, corners.begin(),
      [&](std::int64_t point) { return points[point]; });
    Subdomain found;
    if (bounds_of_cell(corners, found) != CornerOrder::Voxel || found.lo != subdomains[p].lo ||
      found.hi != subdomains[p].hi)
    {
      return false;
    }
  }
  return true;
}

/// New memory as at first, and memory of a frame before as when time goes on.
void measure_voxels(benchmark::State& state, const Case& each)
{
  Progress progress;
  const Voxels first = make_voxels(each.subdomains, {}, each.shared, Executor(1), progress);
  if (!is_right(first, each.subdomains))
  {
    fail(state, "a cell without the corners of its subdomain");
    return;
  }
  const std::int64_t points = first.number_of_points;
  const auto pool = std::make_shared<BlockPool>(std::size_t{ 1 } << 30);
  Rounds rounds(wall);
  for (const bool pooled : { false, true })
  {
    const auto from = pooled ? pool : nullptr;
    const std::string memory = pooled ? "pooled" : "new";
    rounds.add(memory + ", writing",
      [&, from] { return write_arrays(points, each.subdomains.size(), from); });
    for (const int threads : { 1, 2 })
    {
      rounds.add(memory + ", " + std::to_string(threads),
        [&, from, threads]
        {
          const Executor executor(threads);
          Progress quiet;
          return make_voxels(each.subdomains, {}, each.shared, executor, quiet, from)
                   .number_of_points == points;
        });
    }
  }
  const auto count = static_cast<double>(each.subdomains.size());
  if (!rounds.run_all(state, "not as many points as before", count))
  {
    return;
  }
  for (const std::string memory : { "new", "pooled" })
  {
    const Samples& writing = rounds.of(memory + ", writing");
    const Samples& one = rounds.of(memory + ", 1");
    tell(state, memory + " memory", 1e9 * median(one), "ns/subdomain");
    tell(state, memory + " memory against writing", median_ratio(one, writing), "1");
    tell(state, memory + " memory against writing, 2 threads",
      median_ratio(rounds.of(memory + ", 2"), writing), "1");
    tell(state, memory + " memory, spread", spread_of_ratio(one, writing), "1");
  }
}

void measure_checks(benchmark::State& state, const Subdomains& subdomains)
{
  Rounds rounds;
  rounds.add("check",
    [&]
    {
      Notices notices;
      Progress progress;
      check_subdomains(subdomains, {}, {}, notices, progress);
      return true;
    });
  const std::int64_t lines = static_cast<std::int64_t>(subdomains.size());
  rounds.add("text",
    [&]
    {
      Progress progress;
      const std::string text = encode_voxels({ subdomains }, progress);
      return std::count(text.begin(), text.end(), '\n') > 2 * lines;
    });
  const auto count = static_cast<double>(subdomains.size());
  if (!rounds.run_all(state, "too few lines", count))
  {
    return;
  }
  tell(state, "check", 1e9 * median(rounds.of("check")), "ns/subdomain");
  tell(state, "text", 1e9 * median(rounds.of("text")), "ns/subdomain");
}
}

void add_benchmarks(const Size& size)
{
  const int edge = static_cast<int>(size.pick(100, 70, 10));
  static const Subdomains grid = made_grid({ edge, edge, edge });
  static const Subdomains divided = made_bisection(edge * edge * edge, 5);
  for (const Case& each : { Case{ "grid", grid, false }, Case{ "grid, shared corners", grid, true },
         Case{ "bisection", divided, false }, Case{ "bisection, shared corners", divided, true } })
  {
    add(std::string("voxels/") + each.name, size.pick(11, 1),
      [each](benchmark::State& state) { measure_voxels(state, each); });
  }
  add("voxels/grid, checks and text", size.pick(3, 1),
    [](benchmark::State& state) { measure_checks(state, grid); });
  add("voxels/bisection, checks and text", size.pick(3, 1),
    [](benchmark::State& state) { measure_checks(state, divided); });
}
}
