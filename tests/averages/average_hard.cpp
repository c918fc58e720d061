// SPDX-License-Identifier: BSD-3-Clause
// Averages where numbers are difficult, missing or wrong.
#include "made_particles.h"

#include "../support/error_of.h"
#include "../support/hard_case.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr EulerGrid unit_cell = { { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 } };

std::string error_of(const FrameView& frame, const EulerAverageRequest& request)
{
  return ::error_of([&] { average(frame, request); });
}
}

TEST(EulerAverageHard, VelocitiesCancelAndMassesDiffer)
{
  std::vector<Particle> particles;
  for (int i = 0; i < 1000; ++i)
  {
    const double v = 1 + i * 1e-3;
    const double mass = i % 2 == 0 ? 1e6 : 1e-6;
    particles.push_back({ { 0.5, 0.5, 0.5 }, { v, -v, 0.5 }, 0.01, mass });
    particles.push_back({ { 0.5, 0.5, 0.5 }, { -v, v, 0.5 }, 0.01, mass });
  }
  particles.push_back({ { 0.5, 0.5, 0.5 }, { 1e-12, 0, 0.5 }, 0.01, 1e-6 });
  const EulerCells cells =
    average(Grains(particles).frame(), request_for(unit_cell, CellWeights::Centre)).cells;
  Quad mass = 0;
  for (const Particle& particle : particles)
  {
    mass += particle.mass;
  }
  const Quad momentum = Quad(1e-6 * 1e-12); // one rounded product is left
  HardCase hard("sums",
    "mean velocity, masses 1e12 apart, momenta that cancel to 1e-24: relative error", "1", 1e-15);
  hard.add(std::abs(cells.velocities[0] / static_cast<double>(momentum / mass) - 1), 2001);
  EXPECT_EQ(cells.velocities[1], 0);
  EXPECT_EQ(cells.velocities[2], 0.5);
}

TEST(EulerAverageHard, TenMillionParticlesInOneCell)
{
  // rows that all are the same: step 0
  const Particle particle = { { 0.5, 0.5, 0.5 }, { 0.1, -0.7, 3 }, 1e-3, 0.1 };
  FrameView frame = Grains({ particle }).frame();
  const Grains one({ particle });
  frame = one.frame();
  frame.rows = 10'000'000;
  frame.points->step = 0;
  for (ArrayView& array : frame.arrays)
  {
    array.step = 0;
  }
  EulerAverageRequest request = request_for(unit_cell, CellWeights::Centre);
  request.keep_sums = true;
  const EulerAverages averages = average(frame, request, 2);
  const Quad rows = 1e7;
  HardCase hard(
    "sums", "10^7 particles in one cell: mass or volume not correctly rounded", "sums", 0);
  hard.add(averages.sums.mass[0] == static_cast<double>(rows * particle.mass) ? 0 : 1, frame.rows);
  hard.add(
    averages.cells.volume_fraction[0] == static_cast<double>(rows * sphere_volume(particle.radius))
      ? 0
      : 1,
    0);
  EXPECT_EQ(averages.sums.mass[0], static_cast<double>(rows * particle.mass));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double term = particle.mass * particle.v[axis];
    EXPECT_EQ(averages.sums.momentum[axis], static_cast<double>(rows * term));
  }
  EXPECT_EQ(averages.cells.radius[0], 1e-3);
  EXPECT_EQ(
    averages.cells.volume_fraction[0], static_cast<double>(rows * sphere_volume(particle.radius)));
}

TEST(EulerAverageHard, CellsOneUlpThick)
{
  const double ulp = 0x1p-33; // of a million, rounded up: 2^19 < 10^6 < 2^20
  const Vector3 lo = { 1e6, 0, 0 };
  const Vector3 hi = { 1e6 + 64 * ulp, 1, 1 };
  const EulerGrid grid =
    make_euler_grid({ lo, hi, EulerGridRequest::By::Counts, { 64, 1, 1 }, {} });
  std::vector<Particle> particles;
  for (int i = 0; i < 64; ++i)
  {
    particles.push_back({ { 1e6 + i * ulp, 0.5, 0.5 }, { 1.0 * i, 0, 0 }, 0.25, 1 });
  }
  const EulerCells centre =
    average(Grains(particles).frame(), request_for(grid, CellWeights::Centre)).cells;
  const EulerCells overlap =
    average(Grains(particles).frame(), request_for(grid, CellWeights::Overlap)).cells;
  for (std::size_t i = 0; i < 64; ++i)
  {
    EXPECT_EQ(centre.velocities[3 * i], static_cast<double>(i));
    // 64 particles, each of which is cut through its middle: a disc of radius 1/4 in a face of 1
    EXPECT_NEAR(overlap.volume_fraction[i], 64 * 3.14159265358979324 / 16, 1e-11);
  }
  EXPECT_EQ(error_of({}, request_for(grid, CellWeights::Centre)), "");
  EXPECT_THROW(make_euler_grid({ lo, hi, EulerGridRequest::By::Counts, { 100, 1, 1 }, {} }), Error);
}

TEST(EulerAverageHard, FarFromTheOriginAndSmall)
{
  const double r = 1e-4;
  const Vector3 lo = { 1e6, -1e6, 1e6 };
  const Vector3 hi = { 1e6 + 0x1p-10, -1e6 + 0x1p-10, 1e6 + 0x1p-10 };
  const EulerGrid grid = { lo, hi, { 4, 4, 4 } };
  Particle particle = { {}, { 1, 2, 3 }, r, 1 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    particle.x[axis] = lo[axis] + 0x1p-11; // the corner in the middle
  }
  const EulerCells cells =
    average(Grains({ particle }).frame(), request_for(grid, CellWeights::Overlap)).cells;
  const double cell = std::pow(0x1p-12, 3);
  int touched = 0;
  for (std::size_t i = 0; i < 64; ++i)
  {
    if (cells.volume_fraction[i] > 0)
    {
      ++touched;
      EXPECT_NEAR(cells.volume_fraction[i] * cell / (sphere_volume(r) / 8), 1, 1e-14);
      EXPECT_EQ(cells.velocities[3 * i + 2], 3);
      EXPECT_EQ(cells.radius[i], r);
    }
  }
  EXPECT_EQ(touched, 8);
}

TEST(EulerAverageHard, ParticlesMuchSmallerAndMuchLargerThanCells)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 3, 3, 3 }, { 3, 3, 3 } };
  const Grains small({ { { 1, 1.5, 1.5 }, { 2, 0, 0 }, 1e-6, 1 } }); // on a face
  const EulerCells halves = average(small.frame(), request_for(grid, CellWeights::Overlap)).cells;
  EXPECT_NEAR(halves.volume_fraction[9 + 3] / (sphere_volume(1e-6) / 2), 1, 1e-9);
  EXPECT_NEAR(halves.volume_fraction[9 + 4] / (sphere_volume(1e-6) / 2), 1, 1e-9);
  EXPECT_EQ(halves.velocities[3 * 12], 2);

  const Grains large({ { { 1.5, 1.5, 1e6 + 1.5 }, { 2, 0, 0 }, 1e6, 7 },
    { { 1.5, 1.5, 1.5 }, { 5, 0, 0 }, 1e-3, 7 } });
  const EulerAverages averages = average(large.frame(), request_for(grid, CellWeights::Overlap));
  EXPECT_EQ(averages.outside, 0);
  EXPECT_NEAR(averages.cells.volume_fraction[13], 0.5,
    1e-5); // its surface is almost a plane through the cell
  EXPECT_NEAR(averages.cells.volume_fraction[22], 1, 1e-6);
  EXPECT_NEAR(averages.cells.volume_fraction[4], 0, 1e-6);
  EXPECT_EQ(averages.cells.velocities[3 * 22], 2); // 1e-18 of the particle alone
  EXPECT_EQ(averages.cells.velocities[3 * 13], 5); // and here the whole of a small one
}

/// Exact arithmetic gives 0, which has no sign in files.
TEST(EulerAverageHard, ParticlesOfOneVelocityHaveNoPressure)
{
  std::vector<Particle> particles = random_particles(300, { 0, 0, 0 }, { 1, 1, 1 }, 0.2, 8, 0.1);
  particles.resize(400, { { 0.01, 0.01, 0.01 }, {}, 1e-3, 1 });
  for (Particle& particle : particles)
  {
    particle.v = { 0.1, -1e7 / 3, 3e-11 / 7 };
  }
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    for (const std::int64_t count :
      { 1, 7, 40 }) // of the last one most cells have one particle, or none
    {
      const EulerGrid grid = { { 0, 0, 0 }, { 1, 1, 1 }, { count, count, count } };
      const EulerCells cells = average(Grains(particles).frame(), request_for(grid, weights)).cells;
      for (const double pressure : cells.pressure)
      {
        ASSERT_EQ(pressure, 0) << count;
        ASSERT_FALSE(std::signbit(pressure)) << count;
      }
    }
  }
  for (Particle& particle : particles)
  {
    particle.v[1] += particle.x[0] < 0.5 ? 1e-6 : 0; // some 2000 ulps are a motion
  }
  const EulerCells cells =
    average(Grains(particles).frame(), request_for(unit_cell, CellWeights::Centre)).cells;
  EXPECT_GT(cells.pressure[0], 0);
}

/// A particle that has exploded spoils its own cell alone, by its speed, its mass or its stress.
TEST(EulerAverageHard, HugeNumbersElsewhereTakeNoDigits)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 2, 1, 1 }, { 2, 1, 1 } };
  std::vector<Particle> particles =
    random_particles(50, { 0.2, 0.2, 0.2 }, { 0.8, 0.8, 0.8 }, 0.1, 3); // in the first cell
  HardCase hard("sums",
    "speeds, masses and stresses of 1e20 to 1e85 in another cell: pressure, stress and temperature "
    "that are not as without them",
    "cells", 0);
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    for (const char* stress : { "", "c_stress" })
    {
      EulerAverageRequest request = request_for(grid, weights);
      request.arrays.stress = stress;
      request.tensors = true;
      request.fields.temperature = true;
      const auto first_cell = [&]
      {
        const EulerAverages found = average(Grains(particles).frame(), request, 2);
        return std::array{ found.cells.pressure[0], found.cells.normal_stress[1],
          found.cells.shear_stress[2], found.fields.temperature[0] };
      };
      const auto expected = first_cell();
      for (const double huge : { 1e20, 1e28, 1e60, 1e85 })
      {
        Particle particle = { { 1.5, 0.5, 0.5 }, { 1, 1, 1 }, 0.1, 1e-3 };
        particle.v[1] = huge;
        particles.push_back(particle);
        hard.add(first_cell() == expected ? 0 : 1);
        particles.back() = { { 1.5, 0.5, 0.5 }, { 1, 1, 1 }, 0.1, *stress == 0 ? huge : 1,
          { huge } };
        hard.add(first_cell() == expected ? 0 : 1);
        particles.pop_back();
      }
    }
  }
}

TEST(EulerAverageHard, RowsThatAreNoNumbersAreLeftOutAndCounted)
{
  std::vector<Particle> particles = random_particles(10, { 0, 0, 0 }, { 1, 1, 1 }, 0.1, 1);
  const Grains good(particles);
  for (int i = 0; i < 8; ++i)
  {
    particles.push_back(particles[0]);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  particles[10].x[2] = not_a_number;
  particles[11].v[0] = infinity;
  particles[12].radius = -infinity;
  particles[13].mass = not_a_number;
  particles[14].mass = -1;
  particles[15].radius = -0.1;
  particles[16].stress[5] = not_a_number;
  particles[17].v[1] = 1e300;
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    EulerAverageRequest request = request_for(unit_cell, weights);
    request.arrays.stress = "c_stress";
    const EulerAverages averages = average(Grains(particles).frame(), request, 2);
    EXPECT_EQ(averages.broken, 8);
    EXPECT_EQ(averages.cells, average(good.frame(), request).cells);
  }
}

TEST(EulerAverageHard, DuplicatesOfOtherProcessesAreLeftOutAndNotCounted)
{
  const Grains particles(random_particles(20, { 0, 0, 0 }, { 1, 1, 1 }, 0.1, 1));
  std::vector<unsigned char> ghosts(20);
  FrameView frame = particles.frame();
  for (std::size_t i = 0; i < 10; ++i)
  {
    ghosts[2 * i + 1] = FrameView::duplicate_row | 32;
  }
  frame.ghosts = ghosts.data();
  std::vector<Particle> own;
  for (std::size_t i = 0; i < 10; ++i)
  {
    own.push_back(particles.all[2 * i]);
  }
  const EulerAverageRequest request = request_for(unit_cell, CellWeights::Overlap);
  const EulerAverages averages = average(frame, request);
  EXPECT_EQ(averages.cells, average(Grains(own).frame(), request).cells);
  EXPECT_EQ(averages.broken, 0);
  EXPECT_EQ(averages.outside, 0);
}

TEST(EulerAverageHard, NoParticlesGiveEmptyCells)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 1, 2, 3 }, { 2, 2, 2 } };
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    Notices notices;
    const EulerAverages averages = average({}, request_for(grid, weights), 2, &notices);
    EXPECT_EQ(averages.cells.volume_fraction, std::vector<double>(8));
    EXPECT_EQ(averages.cells.pressure, std::vector<double>(8));
    EXPECT_EQ(averages.cells.centres[5], 0.75);
    EXPECT_TRUE(notices.empty());
  }
}

TEST(EulerAverageHard, WhatIsMissingIsToldOrAnError)
{
  const Grains particles(random_particles(20, { 0, 0, 0 }, { 1, 1, 1 }, 0.1, 1));
  FrameView frame = particles.frame();
  frame.arrays.clear();
  Notices notices;
  const EulerCells cells =
    average(frame, request_for(unit_cell, CellWeights::Centre), 1, &notices).cells;
  ASSERT_EQ(notices.size(), 3U);
  EXPECT_EQ(notices[0].text, "no array 'v' of velocities: v_avg is 0");
  EXPECT_EQ(notices[1].text, "no array 'radius' of radii: radius and volumefraction are 0");
  EXPECT_EQ(notices[2].text,
    "neither an array 'mass' nor density and radius: the mass of each grain is taken as 1");
  EXPECT_EQ(cells.volume_fraction[0], 0);
  EXPECT_EQ(error_of(frame, request_for(unit_cell, CellWeights::Overlap)),
    "expected an array 'radius' of radii, which the weights Overlap need, got none");
  EulerAverageRequest request = request_for(unit_cell, CellWeights::Centre);
  request.arrays.stress = "c_stress";
  EXPECT_EQ(error_of(frame, request),
    "expected an array 'c_stress' with six values a particle, the stress times the volume, got "
    "none");
  request.arrays.stress = "v";
  EXPECT_EQ(
    error_of(particles.frame(), request), "expected an array 'v' with 6 values a particle, got 3");
  frame.points.reset();
  EXPECT_EQ(error_of(frame, request_for(unit_cell, CellWeights::Centre)),
    "expected points to average, got none");
}

TEST(EulerAverageHard, MassesAreMadeOfDensities)
{
  std::vector<Particle> particles = random_particles(20, { 0, 0, 0 }, { 1, 1, 1 }, 0.1, 1);
  std::vector<Particle> heavy = particles;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    heavy[i].mass = particles[i].mass * sphere_volume(particles[i].radius); // density by its name
  }
  const Grains densities(particles);
  FrameView frame = densities.frame();
  frame.arrays[2].name = "density";
  const EulerAverageRequest request = request_for(unit_cell, CellWeights::Centre);
  Notices notices;
  EXPECT_EQ(
    average(frame, request, 1, &notices).cells, average(Grains(heavy).frame(), request).cells);
  EXPECT_TRUE(notices.empty());
}

TEST(EulerAverageHard, GridsThatDoNotFitAreRefusedBeforeAnythingIsAllocated)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 1, 1, 1 }, { 10000, 10000, 10000 } };
  const std::string error = error_of({}, request_for(grid, CellWeights::Centre));
  EXPECT_EQ(
    error.rfind("expected cells that fit into memory, got 10000 x 10000 x 10000 cells, which take "
                "686",
      0),
    0U)
    << error;
}

TEST(EulerAverageHard, GridsThatAreNoneAreErrors)
{
  const auto error = [](const EulerGridRequest& request)
  { return ::error_of([&] { make_euler_grid(request); }); };
  using By = EulerGridRequest::By;
  const Vector3 lo = { 0, 0, 0 };
  const Vector3 hi = { 1, 1, 1 };
  EXPECT_EQ(error({ lo, hi, By::Counts, { 4, 0, 4 }, {} }),
    "expected 1 to 2^31 - 1 cells along each axis, got 4 0 4");
  EXPECT_EQ(error({ lo, hi, By::Size, {}, { 0.1, 0, 0.1 } }),
    "expected edges of cells above 0, got 0.1 0 0.1");
  EXPECT_EQ(error({ lo, hi, By::Size, {}, { 0.1, -1, 0.1 } }),
    "expected edges of cells above 0, got 0.1 -1 0.1");
  EXPECT_EQ(error({ lo, hi, By::Size, {}, { 0.1, not_a_number, 0.1 } }),
    "expected edges of cells above 0, got 0.1 nan 0.1");
  EXPECT_EQ(error({ lo, { 1, 0, 1 }, By::Counts, { 1, 1, 1 }, {} }),
    "expected finite bounds of cells, the lower below the upper, got 0 and 0 along y");
  EXPECT_EQ(error({ lo, hi, By::Counts, { 1 << 20, 1 << 20, 2 }, {} }),
    "expected at most 2^40 cells, got 1048576 x 1048576 x 2");
  EXPECT_EQ(error({ lo, hi, By::Size, {}, { 1e-20, 1, 1 } }),
    "expected less than 2^31 cells along an axis, got edges of 1e-20 in a box of 1");
  EXPECT_EQ(
    make_euler_grid({ lo, hi, By::Size, {}, { 0.3, 2, 1 } }), (EulerGrid{ lo, hi, { 3, 1, 1 } }));
}

TEST(EulerAverageHard, GridsManyPeriodsLongOrFarAwayHaveAllImages)
{
  const Box box = periodic_box({ 0, 0, 0 }, { 1, 1, 1 }, "pp pp pp");
  const Grains particles({ { { 0.25, 0.5, 0.5 }, { 1, 0, 0 }, 0.2, 1 } });
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    for (const double first : { 0.0, 1000.0, -40.0 })
    {
      const EulerGrid grid = { { first, 0, 0 }, { first + 40, 1, 1 }, { 40, 1, 1 } };
      for (const double fraction :
        average(particles.frame(&box), request_for(grid, weights)).cells.volume_fraction)
      {
        EXPECT_NEAR(fraction, sphere_volume(0.2), 1e-14);
      }
    }
    const EulerGrid far = { { 1e30, 0, 0 }, { 2e30, 1, 1 }, { 1, 1, 1 } };
    EXPECT_NE(error_of(particles.frame(&box), request_for(far, weights)).find("too many images"),
      std::string::npos);
  }
}

TEST(EulerAverageHard, ParticlesLargerThanAPeriodHaveAllImagesOrAreRefused)
{
  const Box box = periodic_box({ 0, 0, 0 }, { 1, 1, 1 }, "pp ff ff");
  const auto particles = [](double radius) {
    return Grains({ { { 0.5, 0.5, 0.5 }, { 1, 0, 0 }, radius, 1 } });
  };
  // an endless rod of spheres: 2 r of them cover each place
  for (const double radius : { 16.0, 20.0, 40.0 })
  {
    const Grains all = particles(radius);
    const EulerAverages averages =
      average(all.frame(&box), request_for(unit_cell, CellWeights::Overlap));
    EXPECT_NEAR(averages.cells.volume_fraction[0], 2 * radius, 0.05);
  }
  const Grains huge = particles(1e4);
  EXPECT_NE(error_of(huge.frame(&box), request_for(unit_cell, CellWeights::Overlap))
              .find("expected cells and grains that are not much larger than the periodic box"),
    std::string::npos);
}

TEST(EulerAverageHard, PointsOnFacesOfAGridOnePeriodLongCountOnce)
{
  const Box box = periodic_box({ 0, 0, 0 }, { 1, 1, 1 }, "pp ff ff");
  const Grains particles({ { { 0.5, 0.5, 0.5 }, {}, 0.1, 1 }, { { 0, 0.5, 0.5 }, {}, 0.1, 1 } });
  for (const double first : { -0.5, 0.0, 0.5, -1.0, 3.0 })
  {
    const EulerGrid grid = { { first, 0, 0 }, { first + 1, 1, 1 }, { 2, 1, 1 } };
    const EulerCells cells =
      average(particles.frame(&box), request_for(grid, CellWeights::Centre)).cells;
    EXPECT_NEAR(cells.volume_fraction[0] + cells.volume_fraction[1], 4 * sphere_volume(0.1), 1e-15)
      << first;
  }
}

/// A particle just below the first face has its image just below the last: by hand.
TEST(EulerAverageHard, PointsJustBelowAGridOnePeriodLongAreInItsLastCell)
{
  const Box box = periodic_box({ 0, 0, 0 }, { 1, 1, 1 }, "pp ff ff");
  const double below = std::nextafter(0.25, 0.0);
  const EulerGrid grid = { { 0.25, 0, 0 }, { 1.25, 1, 1 }, { 2, 1, 1 } };
  for (const double x : { below, below - 0.5, std::nextafter(-0.75, -1.0), below + 1 })
  {
    const Grains particles({ { { x, 0.5, 0.5 }, {}, 0.1, 1 } });
    const EulerAverages averages =
      average(particles.frame(&box), request_for(grid, CellWeights::Centre));
    const bool is_below = x != below + 1; // which is rounded to 1.25
    EXPECT_EQ(averages.cells.volume_fraction[0] > 0, !is_below) << x;
    EXPECT_EQ(averages.cells.volume_fraction[1] > 0, is_below) << x;
    EXPECT_EQ(averages.outside, 0) << x;
  }
}

TEST(EulerAverageHard, WhoIsTooFarAwayForPeriodsIsLeftOut)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Box box = periodic_box({ 0, 0, 0 }, { 1, 1, 1 }, "pp ff pp");
  const Grains particles(
    { { { 1e300, 0.5, 0.5 }, {}, 0.1, 1 }, { { 0.5, -infinity, 0.5 }, {}, 0.1, 1 },
      { { 0.5, 0.5, infinity }, {}, 0.1, 1 }, { { 0.5, 0.5, 0.5 }, {}, 0.1, 1 } });
  const EulerAverages averages =
    average(particles.frame(&box), request_for(unit_cell, CellWeights::Centre));
  EXPECT_EQ(averages.broken, 3);
  EXPECT_EQ(averages.outside, 0);
  EXPECT_EQ(averages.cells.volume_fraction[0], sphere_volume(0.1));
}

TEST(EulerAverageHard, EdgesThatDivideTheBoxDoSoWhateverTheRounding)
{
  using By = EulerGridRequest::By;
  const auto count = [](double length, double size)
  {
    return make_euler_grid({ { 0, 0, 0 }, { length, 1, 1 }, By::Size, {}, { size, 1, 1 } })
      .counts[0];
  };
  EXPECT_EQ(count(0.3, 0.1), 3);
  EXPECT_EQ(count(0.15, 0.05), 3);
  EXPECT_EQ(count(0.7, 0.1), 7);
  EXPECT_EQ(count(0.29999, 0.1), 2);
  // as fix ave/euler divides: the quotient of doubles is cut off
  EulerGridRequest request = { { 0, 0, 0 }, { 0.3, 1, 1 }, By::Cutoff };
  request.cutoff = 0.1;
  EXPECT_EQ(make_euler_grid(request).counts, (std::array<std::int64_t, 3>{ 2, 10, 10 }));
  request.cutoff = 0;
  EXPECT_EQ(make_euler_grid(request).counts, (std::array<std::int64_t, 3>{ 1, 1, 1 }));
}
