// SPDX-License-Identifier: BSD-3-Clause
// Smoothing kernels: time of a particle, noise of the volume fraction of particles at random, and blur of a step, against the
// volume of spheres in cells as large as the kernel.
#include "bench.h"

#include "granular/euler/average.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace bench
{
namespace
{
using namespace granular;
using namespace std::string_literals;

constexpr double pi = std::numbers::pi;

struct Way
{
  const char* name;
  GrainCells::Options options;
};

/// Kernels of a width; Overlap is not one.
std::vector<Way> ways(double width)
{
  const auto kernel = [&](KernelShape shape) {
    return GrainCells::Options{ CellWeights::Kernel, true, shape, width, KernelBounds::None };
  };
  return { { "Gaussian", kernel(KernelShape::Gaussian) }, { "Lucy", kernel(KernelShape::Lucy) },
    { "Heaviside", kernel(KernelShape::Heaviside) },
    { "Overlap", { CellWeights::Overlap, true, {}, 0, {} } } };
}

/// The edge of a cell as large as the sphere of Heaviside.
double edge_of_overlap(double width)
{
  return std::cbrt(4 * pi / 3) * width;
}

/// Spheres of radius 1.
struct Spheres
{
  EulerAverages average(const EulerGrid& grid, const GrainCells::Options& options) const
  {
    const std::vector<double> ones(places.size(), 1);
    FrameView frame;
    frame.rows = std::ssize(places);
    frame.has_box = false;
    frame.points = view_rows("points", ValueType::Float64, places.data()->data(), 3);
    frame.arrays = { view_rows("radius", ValueType::Float64, ones.data()),
      view_rows("mass", ValueType::Float64, ones.data()) };
    EulerAverageRequest request;
    request.grid = grid;
    request.cells = options;
    request.wanted = WantedCells::all(grid);
    SerialCommunicator alone;
    Notices notices;
    Progress progress;
    return average_in_cells(frame, request, alone, Executor(1), notices, progress);
  }

  std::vector<Vector3> places;
};

/// At random in a cube, as many as fill half of it if they do not overlap.
Spheres at_random(double edge)
{
  Spheres spheres;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(0, edge);
  spheres.places.resize(static_cast<std::size_t>(0.5 * edge * edge * edge / (4 * pi / 3)));
  for (Vector3& place : spheres.places)
  {
    place = { any(random), any(random), any(random) };
  }
  return spheres;
}

/// Root mean square of the deviations of cells from the mean, relative to it; those near the faces do not count.
double noise_of(const EulerAverages& averages, const EulerGrid& grid, double margin)
{
  double sum = 0;
  double squares = 0;
  double cells = 0;
  std::size_t cell = 0;
  CellRange{ {}, grid.counts }.each(
    [&](const std::array<std::int64_t, 3>& at)
    {
      bool inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double x = grid.centre(axis, at[axis]);
        inside = inside && x > margin && x < grid.hi[axis] - margin;
      }
      const double value = averages.cells.volume_fraction[cell++];
      sum += inside ? value : 0;
      squares += inside ? value * value : 0;
      cells += inside ? 1 : 0;
    });
  const double mean = sum / cells;
  return std::sqrt(std::max(squares / cells - mean * mean, 0.0)) / mean;
}

/// The way from 10 to 90 % of a step of the density, in widths: everywhere below 0, nothing above.
double blur_of(const GrainCells::Options& options)
{
  const bool cells = options.weights == CellWeights::Overlap;
  constexpr double step = 0.25; // of a lattice of particles that are as good as everywhere
  constexpr double side = 8;
  Spheres spheres;
  const double up = cells ? 0.02 : step;
  for (double z = -8 + up / 2; z < 0; z += up)
  {
    for (double y = step / 2; y < side; y += step)
    {
      for (double x = step / 2; x < side; x += step)
      {
        spheres.places.push_back({ x, y, z });
      }
    }
  }
  GrainCells::Options points = options;
  points.weights = cells ? CellWeights::Centre : options.weights; // of particles without size
  const double height = cells ? edge_of_overlap(1) : 0.125;
  // layers of a column in the middle, at many places: an average over cells jumps from one to the next
  std::vector<std::array<double, 2>> profile;
  const int shifts = cells ? 32 : 1;
  const auto layers = static_cast<std::int64_t>(std::ceil(8 / height));
  for (int shift = 0; shift < shifts; ++shift)
  {
    const double lo = -4 + height * shift / shifts;
    const EulerGrid grid = { { 2.5, 2.5, lo },
      { 5.5, 5.5, lo + height * static_cast<double>(layers) },
      { cells ? 1 : 3, cells ? 1 : 3, layers } };
    const EulerAverages averages = spheres.average(grid, points);
    const std::int64_t layer = grid.counts[0] * grid.counts[1];
    for (std::int64_t k = 0; k < layers; ++k)
    {
      profile.push_back({ grid.centre(2, k),
        averages.cells.volume_fraction[static_cast<std::size_t>(k * layer + layer / 2)] });
    }
  }
  std::ranges::sort(profile);
  const double whole = profile.front()[1];
  const auto place_of = [&](double part)
  {
    std::size_t i = 0;
    while (i + 2 < profile.size() && profile[i + 1][1] > part * whole)
    {
      ++i;
    }
    const auto& [x, upper] = profile[i];
    const auto& [y, lower] = profile[i + 1];
    return x + (y - x) * (upper - part * whole) / (upper - lower);
  };
  return place_of(0.1) - place_of(0.9);
}

/// The same for all widths; exact: of particles that are everywhere.
void blur(benchmark::State& state)
{
  const double exact[] = { 2.4941, 1.5171, 1.2168, 0.8 * edge_of_overlap(1) };
  const std::vector<Way> all = ways(1);
  const double begin = now();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const double blurred = blur_of(all[i].options);
    tell(state, all[i].name + ", blur"s, blurred, "widths");
    tell(state, all[i].name + ", blur, exact"s, exact[i], "widths");
    if (!(std::abs(blurred / exact[i] - 1) < 0.06))
    {
      fail(state, "the step is not as blurred as by "s + all[i].name);
    }
  }
  state.SetIterationTime(now() - begin);
}

void time_and_noise(benchmark::State& state, double width, double edge_in_widths)
{
  const double edge = std::max(edge_in_widths * width, 24.0);
  const Spheres spheres = at_random(edge);
  const auto per_axis = static_cast<std::int64_t>(edge / width);
  const EulerGrid of_kernels = { {}, { edge, edge, edge }, { per_axis, per_axis, per_axis } };
  const auto cells = static_cast<std::int64_t>(edge / edge_of_overlap(width));
  const EulerGrid of_overlap = { {}, { edge, edge, edge }, { cells, cells, cells } };
  const auto count = static_cast<double>(spheres.places.size());
  const auto grid_of = [&](const Way& way) -> const EulerGrid&
  { return way.options.weights == CellWeights::Overlap ? of_overlap : of_kernels; };
  const std::vector<Way> all = ways(width);
  Rounds rounds;
  for (const Way& way : all)
  {
    const EulerAverages averages = spheres.average(grid_of(way), way.options);
    tell(state, way.name + ", noise"s, noise_of(averages, grid_of(way), 3 * width + 1), "1");
    rounds.add(
      way.name, [&, way] { return spheres.average(grid_of(way), way.options).broken == 0; });
  }
  if (!rounds.run_all(state, "particles are left out", count))
  {
    return;
  }
  tell(state, "particles", count, "1");
  for (const Way& way : all)
  {
    tell(state, way.name, 1e9 * median(rounds.of(way.name)), "ns/particle");
  }
  tell(state, "Heaviside, time against Overlap",
    median_ratio(rounds.of("Heaviside"), rounds.of("Overlap")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("Heaviside"), rounds.of("Overlap")), "1");
}

// ---- lines --------------------------------------------------------------------------------------
/// The mean of a kernel over lines near it, against its value at their middle.
void lines(benchmark::State& state, KernelShape shape, std::int64_t count)
{
  const Kernel kernel(shape, 1);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  std::vector<std::array<Vector3, 2>> all(static_cast<std::size_t>(count));
  for (auto& [place, branch] : all)
  {
    place = { any(random), any(random), any(random) };
    branch = { any(random), any(random), any(random) };
  }
  double of_lines = 0;
  double of_points = 0;
  Rounds rounds;
  rounds.add("line",
    [&]
    {
      of_lines = 0;
      for (const auto& [place, branch] : all)
      {
        of_lines += kernel.line_mean(place, branch);
      }
      return of_lines > 0;
    });
  rounds.add("point",
    [&]
    {
      of_points = 0;
      for (const auto& [place, branch] : all)
      {
        const Vector3 middle = { place[0] - branch[0] / 2, place[1] - branch[1] / 2,
          place[2] - branch[2] / 2 };
        of_points += kernel.value(dot(middle, middle));
      }
      return of_points > 0;
    });
  if (!rounds.run_all(state, "no line touches the kernel", static_cast<double>(count)))
  {
    return;
  }
  tell(state, "mean over a line", 1e9 * median(rounds.of("line")), "ns");
  tell(state, "value at a point", 1e9 * median(rounds.of("point")), "ns");
}
}

void add_benchmarks(const Size& size)
{
  const std::array<const char*, 6> widths = { "0.5", "1", "2", "3", "5", "10" };
  const double edge = size.full ? 14 : 10;
  for (const char* width : widths)
  {
    if (!size.full && std::stod(width) > 2)
    {
      continue;
    }
    add("kernels/width of "s + width + " radii", 10,
      [=](benchmark::State& state) { time_and_noise(state, std::stod(width), edge); });
  }
  add("kernels/blur of a step", 1,
    [](benchmark::State& state)
    {
      while (state.KeepRunning())
      {
        blur(state);
      }
    });
  const std::int64_t count = size.pick(100'000, 1000);
  add("kernels/lines, Gaussian", 25,
    [=](benchmark::State& state) { lines(state, KernelShape::Gaussian, count); });
  add("kernels/lines, Lucy", 25,
    [=](benchmark::State& state) { lines(state, KernelShape::Lucy, count); });
  add("kernels/lines, Heaviside", 25,
    [=](benchmark::State& state) { lines(state, KernelShape::Heaviside, count); });
}
}
