// SPDX-License-Identifier: BSD-3-Clause
// Averages over time against those of the particles of all frames at once, one by one with exact sums.
#include "../grid/sphere_box_volume.h"
#include "made_particles.h"

#include "granular/averages/time_average.h"
#include "granular/common/error.h"

#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace granular;

namespace
{
using Frames = std::vector<std::vector<Particle>>;

EulerAverageRequest request_over_time(const EulerGrid& grid, CellWeights weights)
{
  EulerAverageRequest request = request_for(grid, weights);
  request.arrays.stress = "c_stress";
  request.keep_sums = true;
  return request;
}

EulerCells over_time(const Frames& frames, const EulerAverageRequest& request)
{
  TimeAverage time;
  for (const std::vector<Particle>& particles : frames)
  {
    time.add(
      particles.empty() ? average({}, request) : average(Grains(particles).frame(), request));
  }
  EXPECT_EQ(time.frames(), static_cast<std::int64_t>(frames.size()));
  return time.cells();
}

/// The particles of all frames, in a volume as large as that of the cell in all of them.
template <class ShareOf>
EulerCells at_once(const Frames& frames, const EulerGrid& grid, const ShareOf& share_of)
{
  std::vector<Particle> all;
  for (const std::vector<Particle>& particles : frames)
  {
    all.insert(all.end(), particles.begin(), particles.end());
  }
  EulerCells cells = average_one_by_one(all, grid, share_of);
  for (std::vector<double>* values :
    { &cells.volume_fraction, &cells.pressure, &cells.normal_stress, &cells.shear_stress })
  {
    for (double& value : *values)
    {
      value /= static_cast<double>(frames.size());
    }
  }
  return cells;
}

/// Returns the largest difference, in units of the largest value of the array.
double expect_near(const EulerCells& cells, const EulerCells& expected, double relative)
{
  double worst = 0;
  for (const EulerArray& array : euler_arrays())
  {
    const std::vector<double>& values = cells.*array.values;
    const std::vector<double>& wanted = expected.*array.values;
    EXPECT_EQ(values.size(), wanted.size()) << array.name;
    double largest = 0;
    for (const double value : wanted)
    {
      largest = std::max(largest, std::abs(value));
    }
    for (std::size_t i = 0; i < std::min(values.size(), wanted.size()); ++i)
    {
      EXPECT_NEAR(values[i], wanted[i], relative * largest) << array.name << " " << i;
      worst = std::max(worst, largest > 0 ? std::abs(values[i] - wanted[i]) / largest : 0);
    }
  }
  return worst;
}
}

TEST(TimeAverage, AddsMomentaAndMasses)
{
  const EulerAverageRequest request =
    request_over_time({ { 0, 0, 0 }, { 2, 1, 1 }, { 2, 1, 1 } }, CellWeights::Centre);
  EXPECT_EQ(TimeAverage().cells().count(), 0);
  const EulerCells cells = over_time(
    { { { { 0.5, 0.5, 0.5 }, { 1, 0, 0 }, 0.5, 1 } },
      { { { 0.5, 0.5, 0.5 }, { 4, 0, 0 }, 0.5, 2 }, { { 0.5, 0.5, 0.5 }, { 1, 0, 0 }, 0.5, 1 } } },
    request);
  EXPECT_EQ(cells.velocities[0], (1.0 + 8 + 1) / 4);
  EXPECT_EQ(cells.velocities[3], 0);
  EXPECT_DOUBLE_EQ(cells.volume_fraction[0], 1.5 * sphere_volume(0.5));
  EXPECT_EQ(cells.radius[0], 0.5);
  // two of mass 1 are 1.5 from the mean, one of mass 2 is as much
  EXPECT_DOUBLE_EQ(cells.pressure[0], (1 + 1 + 2) * 1.5 * 1.5 / 3 / 2);
  EXPECT_EQ(cells.pressure[1], 0);
}

TEST(TimeAverage, NeedsTheSameCellsInAllFrames)
{
  EulerAverageRequest request =
    request_over_time({ { 0, 0, 0 }, { 2, 1, 1 }, { 2, 1, 1 } }, CellWeights::Centre);
  TimeAverage time;
  time.add(average({}, request));
  request.grid.hi[0] = 3;
  EXPECT_THROW(time.add(average({}, request)), Error);
}

/// No radius is below that of the smallest particle, however often a cell is empty.
TEST(TimeAverage, RadiusIsThatOfParticlesInAnyFrame)
{
  const EulerAverageRequest request =
    request_over_time({ { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 } }, CellWeights::Overlap);
  const Particle small = { { 0.5, 0.5, 0.5 }, { 1, 0, 0 }, 0.1, 1 };
  const Particle large = { { 0.5, 0.5, 0.5 }, { 1, 0, 0 }, 0.4, 1 };
  EXPECT_EQ(over_time({ {}, { small }, {} }, request).radius[0], 0.1);
  EXPECT_DOUBLE_EQ(
    over_time({ { small, small, small }, {}, { large } }, request).radius[0], (0.3 + 0.4) / 4);
}

TEST(TimeAverage, IsThatOfTheParticlesOfAllFramesAtOnce)
{
  HardCase fast("averages in time",
    "values of cells where all move at 1e6 times the fluctuation: error of the largest value", "1",
    1e-9);
  HardCase hard("averages in time",
    "values of cells, against all particles of all frames at once: error of the largest value", "1",
    1e-11);
  const EulerGrid grid = { { -1, 0, 2 }, { 1, 3, 3 }, { 4, 5, 3 } };
  for (const double speed : { 0.0, 1e6 }) // of all: what fluctuates is known as well as it can be
  {
    Frames frames = { random_particles(40, grid.lo, grid.hi, 0.3, 1), {},
      random_particles(3, grid.lo, grid.hi, 0.3, 2),
      random_particles(80, grid.lo, grid.hi, 0.2, 3) };
    for (std::vector<Particle>& particles : frames)
    {
      for (Particle& particle : particles)
      {
        particle.v[1] += speed;
      }
    }
    const double precision = speed > 0 ? 1e-9 : 1e-13;
    HardCase& row = speed > 0 ? fast : hard;
    row.add(expect_near(over_time(frames, request_over_time(grid, CellWeights::Centre)),
              at_once(frames, grid,
                [&](const Particle& particle, const Vector3& lo, const Vector3& hi)
                {
                  return is_inside(particle, grid, lo, hi)
                    ? Share(1, sphere_volume(particle.radius))
                    : Share(0, 0);
                }),
              precision),
      grid.size());
    row.add(expect_near(over_time(frames, request_over_time(grid, CellWeights::Overlap)),
              at_once(frames, grid,
                [](const Particle& particle, const Vector3& lo, const Vector3& hi)
                {
                  const double volume = sphere_box_volume(particle.x, particle.radius, lo, hi);
                  return Share(volume / sphere_volume(particle.radius), volume);
                }),
              std::max(precision, 1e-11)),
      grid.size());
  }
}

TEST(TimeAverage, OfOneFrameIsThatFrame)
{
  const EulerGrid grid = { { -1, 0, 2 }, { 1, 3, 3 }, { 4, 5, 3 } };
  const std::vector<Particle> particles = random_particles(200, grid.lo, grid.hi, 0.3, 1);
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    const EulerAverageRequest request = request_over_time(grid, weights);
    EXPECT_EQ(over_time({ particles }, request), average(Grains(particles).frame(), request).cells);
  }
}

TEST(TimeAverage, ParticlesOfOneVelocityHaveNoPressure)
{
  const EulerGrid grid = { { -1, 0, 2 }, { 1, 3, 3 }, { 4, 5, 3 } };
  Frames frames;
  for (unsigned seed = 0; seed < 9; ++seed)
  {
    frames.push_back(random_particles(100, grid.lo, grid.hi, 0.3, seed));
    for (Particle& particle : frames.back())
    {
      particle.v = { 0.1, -1e7 / 3, 3e-11 / 7 };
      particle.stress = {};
    }
  }
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    for (const double pressure : over_time(frames, request_over_time(grid, weights)).pressure)
    {
      EXPECT_EQ(pressure, 0);
      EXPECT_FALSE(std::signbit(pressure));
    }
  }
}
