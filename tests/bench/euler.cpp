// SPDX-License-Identifier: BSD-3-Clause
// Averages of grains over cells: time of a grain and error of the volume fraction, from cells much smaller than grains to
// cells that hold thousands; against plain sums; for more and more grains; with two threads.
#include "bench.h"

#include "../euler/exact_sphere_box.h"

#include "granular/euler/average.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace bench
{
namespace
{
using namespace granular;
using namespace std::string_literals;

// ---- grains and their averages ------------------------------------------------------------------
/// Grains in no order, anywhere in a cube from 0, but not beyond its walls; they may overlap.
struct Grains
{
  Grains(std::int64_t count, double edge, double largest_radius)
    : positions(static_cast<std::size_t>(count))
    , velocities(positions.size())
    , mass(positions.size())
  {
    for (Vector3& x : positions)
    {
      fill(x, largest_radius, edge - largest_radius);
    }
    for (Vector3& v : velocities)
    {
      fill(v, -0.1, 0.1);
    }
    fill(mass, 0.5, 1);
  }

  template <class Values>
  void fill(Values& values, double least, double most)
  {
    std::uniform_real_distribution<double> between(least, most);
    std::ranges::generate(values, [&] { return between(random); });
  }

  void make_stresses()
  {
    stresses.resize(6 * positions.size());
    fill(stresses, -1e-3, 0);
  }

  /// Cell after cell: nothing else depends on places.
  void sort(double cell)
  {
    const auto slab = [cell](double x) { return static_cast<std::int64_t>(x / cell); };
    std::ranges::sort(positions, {},
      [&](const Vector3& x) {
        return std::array{ slab(x[2]), slab(x[1]), slab(x[0]) };
      });
  }

  std::mt19937_64 random{ 7 };
  std::vector<Vector3> positions;
  std::vector<Vector3> velocities;
  std::vector<double> mass;
  std::vector<double> stresses; ///< six of each, or none
};

EulerGrid cube(double edge, std::int64_t per_axis)
{
  return { {}, { edge, edge, edge }, { per_axis, per_axis, per_axis } };
}

constexpr double pi = std::numbers::pi;
constexpr GrainCells::Options centre = { CellWeights::Centre, true };
constexpr GrainCells::Options overlap = { CellWeights::Overlap, true };
constexpr GrainCells::Options no_short_cuts = { CellWeights::Overlap, false };

/// The first grains, of equal radius, and a grid to average them over.
struct Case
{
  Case(const Grains& of, std::int64_t count, double radius, const EulerGrid& over)
    : grains(of)
    , radii(static_cast<std::size_t>(count), radius)
    , grid(over)
  {
  }

  std::int64_t count() const { return static_cast<std::int64_t>(radii.size()); }

  EulerCells average(const GrainCells::Options& options, int threads = 1) const
  {
    FrameView frame;
    frame.rows = this->count();
    frame.has_box = false;
    frame.points = view_rows("points", ValueType::Float64, grains.positions.data()->data(), 3);
    frame.arrays = { view_rows("v", ValueType::Float64, grains.velocities.data()->data(), 3),
      view_rows("radius", ValueType::Float64, radii.data()),
      view_rows("mass", ValueType::Float64, grains.mass.data()),
      view_rows("stress", ValueType::Float64, grains.stresses.data(), 6) };
    EulerAverageRequest request;
    request.grid = grid;
    request.cells = options;
    request.arrays.stress = grains.stresses.empty() ? "" : "stress";
    request.wanted = WantedCells::all(grid);
    SerialCommunicator alone;
    Notices notices;
    Progress progress;
    return average_in_cells(frame, request, alone, Executor(threads), notices, progress).cells;
  }

  /// Whether the cells have the volume of all grains.
  bool has_all(const EulerCells& cells) const
  {
    const double fractions =
      std::accumulate(cells.volume_fraction.begin(), cells.volume_fraction.end(), 0.0);
    const double cell = box_volume({ grid.spacing(0), grid.spacing(1), grid.spacing(2) });
    const double all = static_cast<double>(this->count()) * sphere_volume(radii.front());
    return std::abs(fractions * cell / all - 1) < 1e-9;
  }

  bool run(const GrainCells::Options& options, int threads = 1) const
  {
    return this->has_all(this->average(options, threads));
  }

  const Grains& grains;
  std::vector<double> radii;
  EulerGrid grid;
};

// ---- speed and error ----------------------------------------------------------------------------
/// The number of cells that a grain of radius 1 touches, on average.
double cells_touched(double edge)
{
  const double part = 1 / edge;
  return 1 + 6 * part + 3 * pi * part * part + 4 * pi / 3 * part * part * part;
}

struct ErrorOfCells
{
  void add(double error)
  {
    largest = std::max(largest, std::abs(error));
    squares += error * error;
    ++cells;
  }

  void tell_as(benchmark::State& state, const std::string& name) const
  {
    tell(state, name + ", error, largest", largest, "1");
    tell(state, name + ", error, rms", std::sqrt(squares / cells), "1");
  }

  double largest = 0;
  double squares = 0;
  double cells = 0;
};

/// The volume fraction of a cell, and by how much one may differ from it.
struct ExactFraction
{
  Quad value = 0;
  Quad tolerance = 0;
  std::int64_t cut = 0; ///< grains that are partly in the cell
};

ExactFraction exact_fraction(const Case& of, std::int64_t number)
{
  const EulerGrid& grid = of.grid;
  const std::int64_t per_axis = grid.counts[0];
  const std::array<std::int64_t, 3> cell = { number % per_axis, number / per_axis % per_axis,
    number / per_axis / per_axis };
  Vector3 lo;
  Vector3 hi;
  Quad volume = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lo[axis] = grid.face(axis, cell[axis]);
    hi[axis] = grid.face(axis, cell[axis] + 1);
    volume *= static_cast<Quad>(hi[axis]) - static_cast<Quad>(lo[axis]);
  }
  const double radius = of.radii.front();
  const double margin = radius * (1 + 1e-9);
  const Quad whole = 4 * quad_pi / 3 * radius * radius * radius;
  ExactFraction exact;
  for (std::size_t i = 0; i < of.radii.size(); ++i)
  {
    const Vector3& x = of.grains.positions[i];
    const auto is_beyond = [&](double by)
    {
      bool beyond = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        beyond |= x[axis] < lo[axis] - by || x[axis] > hi[axis] + by;
      }
      return beyond;
    };
    if (is_beyond(margin))
    {
      continue;
    }
    const bool inside = !is_beyond(-margin);
    const ExactVolume part =
      inside ? ExactVolume{ whole, whole * 1e-12 } : exact_sphere_box(x, radius, lo, hi);
    exact.value += part.value;
    exact.tolerance += part.tolerance;
    exact.cut += inside ? 0 : 1;
  }
  exact.value /= volume;
  exact.tolerance = exact.tolerance / volume + exact.value * 1e-15;
  return exact;
}

/// Averages of the same particles, and how far they are from the exact volume fractions.
struct Sampled
{
  const char* name;
  EulerCells cells;
  bool is_exact; ///< whether it must be within the tolerance
  ErrorOfCells error = {};
};

/// Compares cells at random, as many as take about a second. Returns false if one that should be exact is not.
bool sample_errors(const Case& of, std::vector<Sampled>& averages)
{
  constexpr std::int64_t most_looks = 200'000'000;
  constexpr std::int64_t most_cut = 100'000;
  const std::int64_t most = std::clamp<std::int64_t>(most_looks / of.count(), 1, 2000);
  std::mt19937_64 random(11);
  std::vector<std::int64_t> every(static_cast<std::size_t>(of.grid.size()));
  std::iota(every.begin(), every.end(), 0);
  std::vector<std::int64_t> sample;
  std::ranges::sample(every, std::back_inserter(sample), most, random);
  std::ranges::shuffle(sample, random);
  std::int64_t cut = 0;
  bool right = true;
  for (std::size_t i = 0; i < sample.size() && cut < most_cut; ++i)
  {
    const std::int64_t cell = sample[i];
    const ExactFraction exact = exact_fraction(of, cell);
    for (Sampled& average : averages)
    {
      const Quad error =
        average.cells.volume_fraction[static_cast<std::size_t>(cell)] - exact.value;
      right = right && (!average.is_exact || absolute(error) <= exact.tolerance);
      average.error.add(static_cast<double>(error));
    }
    cut += exact.cut;
  }
  return right;
}

struct CellSize
{
  const char* radii;
  double edge;
  std::int64_t per_axis; ///< cells
  std::int64_t rounds;
};

/// So many grains that they would fill half of the cube if they did not overlap.
std::int64_t half_full(double edge)
{
  return std::llround(0.5 * edge * edge * edge / sphere_volume(1));
}

void speed_and_error(benchmark::State& state, const CellSize& size, std::int64_t most_grains)
{
  const double edge = size.edge * static_cast<double>(size.per_axis);
  const std::int64_t count = std::min(half_full(edge), most_grains);
  const Grains grains(count, edge, 1);
  const Case all(grains, count, 1, cube(edge, size.per_axis));
  {
    std::vector<Sampled> averages;
    averages.push_back({ "Centre", all.average(centre), false });
    averages.push_back({ "Overlap", all.average(overlap), true });
    averages.push_back({ "without short cuts", all.average(no_short_cuts), true });
    if (!sample_errors(all, averages))
    {
      fail(state, "a volume fraction is not that of the spheres in the cell");
      return;
    }
    for (const Sampled& average : averages)
    {
      average.error.tell_as(state, average.name);
    }
    tell(state, "exact cells", averages[0].error.cells, "1");
  }
  Rounds rounds;
  rounds.add("Centre", [&] { return all.run(centre); });
  rounds.add("Overlap", [&] { return all.run(overlap); });
  rounds.add("without short cuts", [&] { return all.run(no_short_cuts); });
  if (!rounds.run_all(
        state, "the cells do not have the volume of the grains", static_cast<double>(count)))
  {
    return;
  }
  tell(state, "particles", static_cast<double>(count), "1");
  tell(state, "cells", static_cast<double>(all.grid.size()), "1");
  tell(state, "cells touched", cells_touched(size.edge), "1");
  for (const char* name : { "Centre", "Overlap", "without short cuts" })
  {
    tell(state, name, 1e9 * median(rounds.of(name)), "ns/particle");
  }
  tell(state, "Overlap, time against Centre",
    median_ratio(rounds.of("Overlap"), rounds.of("Centre")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("Overlap"), rounds.of("Centre")), "1");
  tell(state, "without short cuts, time against Overlap",
    median_ratio(rounds.of("without short cuts"), rounds.of("Overlap")), "1");
}

// ---- plain sums ---------------------------------------------------------------------------------
struct PlainSums
{
  double count = 0;
  double mass = 0;
  Vector3 momentum = {};
  double radius = 0;
  double volume = 0;
};

/// The cell that a computed index says, which is trusted.
std::size_t plain_cell(const EulerGrid& grid, const Vector3& per_length, const Vector3& x)
{
  const auto slab = [&](std::size_t axis)
  {
    const auto index = static_cast<std::int64_t>((x[axis] - grid.lo[axis]) * per_length[axis]);
    return std::clamp<std::int64_t>(index, 0, grid.counts[axis] - 1);
  };
  return static_cast<std::size_t>((slab(2) * grid.counts[1] + slab(1)) * grid.counts[0] + slab(0));
}

void finish_plain_means(
  const EulerGrid& grid, const std::vector<PlainSums>& all, double volume, EulerCells& cells)
{
  std::size_t cell = 0;
  for (std::int64_t k = 0; k < grid.counts[2]; ++k)
  {
    for (std::int64_t j = 0; j < grid.counts[1]; ++j)
    {
      for (std::int64_t i = 0; i < grid.counts[0]; ++i, ++cell)
      {
        const PlainSums& sums = all[cell];
        const double share = sums.count > 0 ? 1 / sums.count : 0;
        const double part = sums.mass > 0 ? 1 / sums.mass : 0;
        cells.centres[3 * cell] = grid.centre(0, i);
        cells.centres[3 * cell + 1] = grid.centre(1, j);
        cells.centres[3 * cell + 2] = grid.centre(2, k);
        cells.velocities[3 * cell] = sums.momentum[0] * part;
        cells.velocities[3 * cell + 1] = sums.momentum[1] * part;
        cells.velocities[3 * cell + 2] = sums.momentum[2] * part;
        cells.radius[cell] = sums.radius * share;
        cells.volume_fraction[cell] = sums.volume / volume;
      }
    }
  }
}

void finish_plain_stresses(
  const std::vector<std::array<double, 6>>& all, bool with_stress, double volume, EulerCells& cells)
{
  cells.normal_stress.resize(with_stress ? 3 * all.size() : 0);
  cells.shear_stress.resize(with_stress ? 3 * all.size() : 0);
  for (std::size_t cell = 0; cell < all.size(); ++cell)
  {
    const std::array<double, 6>& sums = all[cell];
    cells.pressure[cell] = -(sums[0] + sums[1] + sums[2]) / (3 * volume);
    for (std::size_t k = 0; with_stress && k < 3; ++k)
    {
      cells.normal_stress[3 * cell + k] = sums[k] / volume;
      cells.shear_stress[3 * cell + k] = sums[3 + k] / volume;
    }
  }
}

/// As anybody would write it: doubles, added as the grains come.
EulerCells average_plainly(const Case& of)
{
  const Grains& grains = of.grains;
  const EulerGrid& grid = of.grid;
  const Vector3 spacing = { grid.spacing(0), grid.spacing(1), grid.spacing(2) };
  const Vector3 per_length = { 1 / spacing[0], 1 / spacing[1], 1 / spacing[2] };
  const bool with_stress = !grains.stresses.empty();
  EulerCells cells;
  cells.resize(grid.size());
  std::vector<PlainSums> sums(static_cast<std::size_t>(grid.size()));
  for (std::size_t i = 0; i < of.radii.size(); ++i)
  {
    PlainSums& to = sums[plain_cell(grid, per_length, grains.positions[i])];
    const Vector3& v = grains.velocities[i];
    const double mass = grains.mass[i];
    const double radius = of.radii[i];
    to.count += 1;
    to.mass += mass;
    to.momentum[0] += mass * v[0];
    to.momentum[1] += mass * v[1];
    to.momentum[2] += mass * v[2];
    to.radius += radius;
    to.volume += 4 * pi / 3 * radius * radius * radius;
  }
  finish_plain_means(grid, sums, box_volume(spacing), cells);
  std::vector<std::array<double, 6>> stresses(sums.size());
  for (std::size_t i = 0; i < of.radii.size(); ++i)
  {
    const std::size_t cell = plain_cell(grid, per_length, grains.positions[i]);
    const Vector3& v = grains.velocities[i];
    const double* const mean = cells.velocities.data() + 3 * cell;
    const double mass = grains.mass[i];
    const double x = v[0] - mean[0];
    const double y = v[1] - mean[1];
    const double z = v[2] - mean[2];
    std::array<double, 6>& to = stresses[cell];
    to[0] -= mass * x * x;
    to[1] -= mass * y * y;
    to[2] -= mass * z * z;
    to[3] -= mass * x * y;
    to[4] -= mass * x * z;
    to[5] -= mass * y * z;
    for (std::size_t k = 0; with_stress && k < 6; ++k)
    {
      to[k] += grains.stresses[6 * i + k];
    }
  }
  finish_plain_stresses(stresses, with_stress, box_volume(spacing), cells);
  return cells;
}

/// But for rounding, which sums of many terms gather.
bool are_alike(const EulerCells& a, const EulerCells& b)
{
  for (const EulerArray& array : euler_arrays())
  {
    const std::vector<double>& left = a.*array.values;
    const std::vector<double>& right = b.*array.values;
    const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-9; };
    if (!std::ranges::equal(left, right, near))
    {
      return false;
    }
  }
  return true;
}

struct PlainCase
{
  double edge; ///< of a cell, in radii
  std::int64_t per_axis;
  bool with_stress;
  bool
    in_order; ///< grains come cell by cell, as in the dump of a run that sorts them; else in no order
};

void against_plain(benchmark::State& state, const PlainCase& each, std::int64_t most_grains)
{
  const double edge = each.edge * static_cast<double>(each.per_axis);
  const std::int64_t count = std::min(half_full(edge), most_grains);
  Grains grains(count, edge, 1);
  if (each.in_order)
  {
    grains.sort(each.edge);
  }
  if (each.with_stress)
  {
    grains.make_stresses();
  }
  const Case all(grains, count, 1, cube(edge, each.per_axis));
  if (!are_alike(average_plainly(all), all.average(centre)))
  {
    fail(state, "plain sums give something else");
    return;
  }
  Rounds rounds;
  rounds.add("plain", [&] { return all.has_all(average_plainly(all)); });
  rounds.add("Centre", [&] { return all.run(centre); });
  if (!rounds.run_all(
        state, "the cells do not have the volume of the grains", static_cast<double>(count)))
  {
    return;
  }
  tell(state, "plain", 1e9 * median(rounds.of("plain")), "ns/particle");
  tell(state, "Centre", 1e9 * median(rounds.of("Centre")), "ns/particle");
  tell(state, "time against plain", median_ratio(rounds.of("Centre"), rounds.of("plain")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("Centre"), rounds.of("plain")), "1");
}

// ---- more and more grains -----------------------------------------------------------------------
struct Growing
{
  std::string name;
  GrainCells::Options options;
  const Case& of;
  std::int64_t repeats;
  Samples samples = {}; ///< seconds a grain

  bool run()
  {
    bool right = true;
    const double start = now();
    for (std::int64_t i = 0; i < repeats; ++i)
    {
      right = of.run(options) && right;
    }
    samples.push_back((now() - start) / static_cast<double>(repeats * of.count()));
    return right;
  }
};

std::string power_of_ten(std::int64_t count)
{
  return "10^" + std::to_string(std::lround(std::log10(static_cast<double>(count))));
}

/// per_axis: cells for each count, edge radii long.
void growth(benchmark::State& state, const std::vector<std::int64_t>& counts,
  const std::vector<std::int64_t>& per_axis, double edge)
{
  const auto radius = [&](std::size_t i) { return 1 / (edge * static_cast<double>(per_axis[i])); };
  const Grains grains(counts.back(), 1, radius(0));
  std::vector<std::unique_ptr<Case>> cases;
  std::vector<Growing> all;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    cases.push_back(std::make_unique<Case>(grains, counts[i], radius(i), cube(1, per_axis[i])));
    const std::int64_t repeats = std::clamp<std::int64_t>(counts.back() / counts[i] / 20, 1, 20);
    all.push_back({ "Centre", centre, *cases.back(), repeats });
    all.push_back({ "Overlap", overlap, *cases.back(), repeats });
  }
  for (auto _ : state)
  {
    const double start = now();
    for (Growing& each : all)
    {
      if (!each.run())
      {
        fail(state, "the cells do not have the volume of the grains");
        return;
      }
    }
    state.SetIterationTime(now() - start);
  }
  for (const std::string name : { "Centre", "Overlap" })
  {
    Samples times;
    for (const Growing& each : all)
    {
      if (each.name == name)
      {
        times.push_back(median(each.samples));
        tell(state, name + ", " + power_of_ten(each.of.count()), 1e9 * times.back(), "ns/particle");
      }
    }
    const auto [least, most] = std::ranges::minmax_element(times);
    tell(state, name + ", slowest against fastest", *most / *least, "1");
  }
}

// ---- threads ------------------------------------------------------------------------------------
/// What some threads took, round by round.
struct Threaded
{
  GrainCells::Options options;
  int threads;
  Samples on_wall = {};
  Samples of_processor = {}; ///< of all threads

  bool run(const Case& of)
  {
    const double start = wall();
    const double processor_start = processor();
    const bool right = of.run(options, threads);
    of_processor.push_back(processor() - processor_start);
    on_wall.push_back(wall() - start);
    return right;
  }
};

void two_threads(benchmark::State& state, const CellSize& size, std::int64_t most_grains)
{
  const double edge = size.edge * static_cast<double>(size.per_axis);
  const std::int64_t count = std::min(half_full(edge), most_grains);
  const Grains grains(count, edge, 1);
  const Case all(grains, count, 1, cube(edge, size.per_axis));
  std::array<Threaded, 4> contenders = { { { centre, 1 }, { centre, 2 }, { overlap, 1 },
    { overlap, 2 } } };
  std::size_t first = 0;
  for (const GrainCells::Options& options : { centre, overlap })
  {
    if (all.average(options, 2) != all.average(options, 1))
    {
      fail(state, "two threads give something else than one");
      return;
    }
  }
  for (auto _ : state)
  {
    const double start = wall();
    for (std::size_t i = 0; i < contenders.size(); ++i)
    {
      if (!contenders[(first + i) % contenders.size()].run(all))
      {
        fail(state, "the cells do not have the volume of the grains");
        return;
      }
    }
    ++first; // another one begins each round
    state.SetIterationTime(wall() - start);
  }
  const auto tell_pair = [&](const std::string& name, const Threaded& one, const Threaded& two)
  {
    const double grain = 1e9 / static_cast<double>(count);
    tell(state, name + ", 1 thread", grain * median(one.on_wall), "ns/particle");
    tell(state, name + ", 2 threads", grain * median(two.on_wall), "ns/particle");
    tell(state, name + ", speed of 2 threads", median_ratio(one.on_wall, two.on_wall), "1");
    tell(state, name + ", spread", spread_of_ratio(one.on_wall, two.on_wall), "1");
    tell(state, name + ", processor time of 2 threads",
      median_ratio(two.of_processor, one.of_processor), "1");
    tell(
      state, name + ", cores that 2 threads had", median_ratio(two.of_processor, two.on_wall), "1");
  };
  tell_pair("Centre", contenders[0], contenders[1]);
  tell_pair("Overlap", contenders[2], contenders[3]);
}
}

void add_benchmarks(const Size& size)
{
  const std::int64_t most = size.pick(10'000'000, 1'000'000, 3'000);
  // 10^6 grains are in 200 x 200 x 200 radii; where cells are small, there are fewer grains, and many cells
  const auto pick = [&](std::int64_t full, std::int64_t quick)
  { return size.full && size.large ? 200 : size.pick(full, quick); };
  const CellSize sizes[] = {
    { "0.1", 0.1, pick(60, 40), 3 },
    { "0.2", 0.2, pick(60, 20), 3 },
    { "0.5", 0.5, pick(60, 10), 3 },
    { "1", 1, pick(60, 8), 3 },
    { "2", 2, size.pick(100, 68, 6), 3 },
    { "4", 4, size.pick(50, 34, 4), 5 },
    { "10", 10, size.pick(20, 13, 3), 7 },
    { "20", 20, size.pick(10, 7, 2), 11 },
    { "50", 50, size.pick(4, 2), 11 },
    { "100", 100, 2, 11 },
  };
  for (const CellSize& each : sizes)
  {
    add("euler/cells of "s + each.radii + " radii", size.pick(each.rounds, 1),
      [each, most](benchmark::State& state) { speed_and_error(state, each, most); });
  }
  const PlainCase plain[] = {
    { 4, size.pick(50, 34, 4), false, false },
    { 4, size.pick(50, 34, 4), false, true },
    { 20, size.pick(10, 7, 2), false, false },
    { 20, size.pick(10, 7, 2), true, false },
    { 100, 2, false, false },
  };
  for (const PlainCase& each : plain)
  {
    add("euler/plain, cells of " + std::to_string(std::lround(each.edge)) + " radii" +
        (each.with_stress ? ", with stresses" : "") + (each.in_order ? ", in order" : ""),
      size.pick(15, 1),
      [each, most](benchmark::State& state) { against_plain(state, each, most); });
  }
  std::vector<std::int64_t> counts = { 10'000, 100'000, 1'000'000 };
  std::vector<std::int64_t> per_axis = { 11, 24, 51 };
  if (size.large)
  {
    counts.push_back(10'000'000);
    per_axis.push_back(110);
  }
  if (!size.full)
  {
    counts = { 1'000, 10'000 };
    per_axis = { 5, 11 };
  }
  add("euler/more particles in more cells", size.pick(3, 1),
    [counts, per_axis](benchmark::State& state) { growth(state, counts, per_axis, 4); });
  const std::vector<std::int64_t> same(counts.size(), size.pick(10, 4));
  add("euler/more particles in the same cells", size.pick(5, 1),
    [counts, same](benchmark::State& state) { growth(state, counts, same, 20); });
  for (const CellSize& each : { sizes[5], sizes[7] })
  {
    add("euler/two threads, cells of "s + each.radii + " radii", size.pick(5, 1),
      [each, most](benchmark::State& state) { two_threads(state, each, most); });
  }
}
}
