// SPDX-License-Identifier: BSD-3-Clause
#include "../grid/sphere_box_volume.h"
#include "made_particles.h"

#include "granular/common/error.h"

#include "../support/hard_case.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr Vector3 lo = { -1, 0, 2 };
constexpr Vector3 hi = { 1, 3, 3 };

std::vector<EulerGrid> some_grids()
{
  return { { lo, hi, { 1, 1, 1 } }, { lo, hi, { 3, 2, 4 } }, { lo, hi, { 1, 1, 30 } },
    { { -0.7, 0.2, 2.1 }, { 0.9, 2.2, 2.9 }, { 5, 3, 2 } } };
}

void expect_same(const EulerCells& a, const EulerCells& b, const std::string& what)
{
  for (const EulerArray& array : euler_arrays())
  {
    EXPECT_EQ(a.*array.values, b.*array.values) << array.name << ", " << what;
  }
  EXPECT_EQ(a.centres, b.centres) << what;
}

EulerAverageRequest with_stress(EulerAverageRequest request)
{
  request.arrays.stress = "c_stress";
  return request;
}
}

TEST(EulerAverage, ByCentreIsThatOfEveryParticleAgainstEveryCell)
{
  HardCase hard("stresses",
    "pressure by Centre, also of particles on faces, edges and corners: not that of 113 bits, "
    "rounded",
    "cells", 0);
  std::vector<Particle> particles = random_particles(600, lo, hi, 0.1, 1, 0.1);
  for (int i = 0; i < 60; ++i) // on faces, edges and corners of cells of the second grid
  {
    particles[static_cast<std::size_t>(i)].x = { -1 + 2.0 * (i % 4) / 3, 1.5 * (i % 3),
      2 + 0.25 * (i % 5) };
  }
  for (const EulerGrid& grid : some_grids())
  {
    const Grains arrays(particles);
    const EulerAverages averages =
      average(arrays.frame(), with_stress(request_for(grid, CellWeights::Centre)));
    const EulerCells expected = average_by_centre(particles, grid);
    hard.add(averages.cells.pressure == expected.pressure ? 0 : 1, grid.size());
    expect_same(averages.cells, expected, std::to_string(grid.size()));
    const auto outside = std::ranges::count_if(particles,
      [&](const Particle& particle) { return !is_inside(particle, grid, grid.lo, grid.hi); });
    EXPECT_EQ(averages.outside, outside);
    EXPECT_EQ(averages.broken, 0);
  }
}

TEST(EulerAverage, ByOverlapIsThatOfTheVolumesInEachCell)
{
  HardCase hard(
    "stresses", "pressure by Overlap, against the volumes in each cell: difference", "1", 1e-11);
  const std::vector<Particle> particles = random_particles(100, lo, hi, 0.4, 2, 0.1);
  for (const EulerGrid& grid : some_grids())
  {
    const Grains arrays(particles);
    const EulerCells cells =
      average(arrays.frame(), with_stress(request_for(grid, CellWeights::Overlap))).cells;
    const EulerCells expected = average_one_by_one(particles, grid,
      [](const Particle& particle, const Vector3& a, const Vector3& b)
      {
        const double volume = sphere_box_volume(particle.x, particle.radius, a, b);
        return Share(volume / sphere_volume(particle.radius), volume);
      });
    for (const EulerArray& array : euler_arrays())
    {
      const std::vector<double>& values = cells.*array.values;
      const std::vector<double>& wanted = expected.*array.values;
      ASSERT_EQ(values.size(), wanted.size());
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        EXPECT_NEAR(values[i], wanted[i], 1e-11) << array.name << " " << i;
        hard.add(array.values == &EulerCells::pressure ? std::abs(values[i] - wanted[i]) : 0);
      }
    }
  }
}

TEST(EulerAverage, IsTheSameForAnyOrderOfRowsThreadsAndRanks)
{
  const Box box = periodic_box(lo, hi, "pp ff pp");
  std::vector<Particle> particles = random_particles(3000, lo, hi, 0.12, 3, 0.05);
  particles[17].v[1] = not_a_number;
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    for (const std::array<std::int64_t, 3>& counts :
      { std::array<std::int64_t, 3>{ 2, 3, 1 }, { 40, 30, 20 } }) // a block, and several
    {
      const EulerAverageRequest request = with_stress(request_for({ lo, hi, counts }, weights));
      const EulerAverages first = average(Grains(particles).frame(&box), request);
      EXPECT_EQ(first.broken, 1);
      std::mt19937_64 random(5);
      for (int threads = 1; threads < 4; ++threads)
      {
        std::ranges::shuffle(particles, random);
        const Grains arrays(particles);
        expect_same(average(arrays.frame(&box), request, threads).cells, first.cells,
          std::to_string(threads) + " threads");
      }
      const Grains arrays(particles);
      for (int size = 2; size < 5; ++size)
      {
        run_ranks(size,
          [&](Communicator& ranks)
          {
            // the second one has no particles, and each wants other cells
            const auto rank = static_cast<std::size_t>(ranks.rank());
            const std::size_t begin = rank == 0 ? 0 : rank == 1 ? 1000 : 1000 * (rank - 1);
            const std::size_t end = rank + 1 == static_cast<std::size_t>(size)
              ? (rank == 1 ? 1000 : particles.size())
              : std::max<std::size_t>(rank, 1) * 1000;
            EulerAverageRequest own = request;
            own.wanted.first = request.grid.size() * ranks.rank() / size;
            own.wanted.last = request.grid.size() * (ranks.rank() + 1) / size;
            Notices notices;
            Progress progress;
            // with two ranks the last has nothing: all are on the first
            const EulerAverages part = average_in_cells(
              arrays.frame(begin, size == 2 && rank == 0 ? particles.size() : end, &box), own,
              ranks, Executor(1), notices, progress);
            EXPECT_EQ(part.broken, 1);
            EXPECT_EQ(part.outside, first.outside);
            const auto at = static_cast<std::ptrdiff_t>(own.wanted.first);
            const auto to = static_cast<std::ptrdiff_t>(own.wanted.last);
            for (const EulerArray& array : euler_arrays())
            {
              const std::vector<double>& all = first.cells.*array.values;
              EXPECT_TRUE(
                std::equal((part.cells.*array.values).begin(), (part.cells.*array.values).end(),
                  all.begin() + at * array.components, all.begin() + to * array.components))
                << array.name << " on " << rank << " of " << size;
            }
          });
      }
    }
  }
}

TEST(EulerAverage, PartsOfAGridAreThoseOfTheWhole)
{
  const Grains particles(random_particles(500, lo, hi, 0.2, 4));
  EulerAverageRequest request = request_for({ lo, hi, { 20, 30, 40 } }, CellWeights::Overlap);
  const EulerCells all = average(particles.frame(), request).cells;
  request.wanted.range = { { 3, 0, 17 }, { 20, 11, 18 } };
  const EulerCells part = average(particles.frame(), request).cells;
  ASSERT_EQ(part.count(), 17 * 11);
  std::size_t at = 0;
  for (std::size_t j = 0; j < 11; ++j)
  {
    for (std::size_t i = 3; i < 20; ++i, ++at)
    {
      const std::size_t whole = (17 * 30 + j) * 20 + i;
      EXPECT_EQ(part.volume_fraction[at], all.volume_fraction[whole]);
      EXPECT_EQ(part.velocities[3 * at + 1], all.velocities[3 * whole + 1]);
      EXPECT_EQ(part.centres[3 * at + 2], all.centres[3 * whole + 2]);
    }
  }
  request.wanted.range = { { 3, 3, 3 }, { 3, 5, 5 } };
  EXPECT_EQ(average(particles.frame(), request).cells.count(), 0);
}

TEST(EulerAverage, PeriodicImagesKeepTheVolume)
{
  const Box box = periodic_box(lo, hi, "pp pp pp");
  for (const double radius : { 0.01, 0.3, 0.6, 1.3 }) // the last is larger than the box along z
  {
    std::vector<Particle> particles = random_particles(200, lo, hi, radius, 6, 0.9);
    for (const std::array<std::int64_t, 3>& counts :
      { std::array<std::int64_t, 3>{ 1, 1, 1 }, { 3, 7, 5 }, { 20, 20, 20 } })
    {
      const EulerGrid grid = { lo, hi, counts };
      const Grains arrays(particles);
      const EulerAverages averages =
        average(arrays.frame(&box), request_for(grid, CellWeights::Overlap));
      BigSum volume;
      for (const double fraction : averages.cells.volume_fraction)
      {
        volume.add(fraction * (6.0 / static_cast<double>(grid.size())));
      }
      BigSum expected;
      for (const Particle& particle : particles)
      {
        expected.add(sphere_volume(particle.radius));
      }
      EXPECT_NEAR(volume.value() / expected.value(), 1, 1e-12) << radius << " " << grid.size();
      EXPECT_EQ(averages.outside, 0);
    }
  }
}

TEST(EulerAverage, GridsBeyondAPeriodicBoxHaveItsImages)
{
  const Box box = periodic_box(lo, hi, "pp ff ff");
  const Grains particles(random_particles(500, lo, hi, 0.1, 7));
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    const EulerCells once =
      average(particles.frame(&box), request_for({ lo, hi, { 4, 3, 1 } }, weights)).cells;
    const EulerGrid shifted = { { 0, 0, 2 }, { 4, 3, 3 }, { 8, 3, 1 } };
    const EulerCells twice = average(particles.frame(&box), request_for(shifted, weights)).cells;
    for (std::size_t j = 0; j < 3; ++j)
    {
      for (std::size_t i = 0; i < 8; ++i)
      {
        EXPECT_NEAR(
          twice.volume_fraction[8 * j + i], once.volume_fraction[4 * j + (i + 2) % 4], 1e-13);
        EXPECT_NEAR(twice.radius[8 * j + i], once.radius[4 * j + (i + 2) % 4], 1e-13);
      }
    }
  }
}

TEST(EulerAverage, CentresOnPeriodicFacesCountOnce)
{
  const Box box = periodic_box(lo, hi, "pp pp pp");
  const Grains particles({ { lo }, { hi }, { { lo[0], hi[1], 2.5 } }, { { hi[0] + 2, 0, 2 } } });
  const EulerAverages averages =
    average(particles.frame(&box), request_for({ lo, hi, { 2, 2, 2 } }, CellWeights::Centre));
  BigSum count;
  for (const double fraction : averages.cells.volume_fraction)
  {
    count.add(fraction * 6.0 / 8 / sphere_volume(1));
  }
  EXPECT_NEAR(count.value(), 4, 1e-13);
  EXPECT_EQ(averages.outside, 0);
}

TEST(EulerAverage, ParticlesBesideEdgesAndCornersAreOutside)
{
  const Grains particles(
    { { { -0.8, -0.8, -0.8 } }, { { -0.8, 0.5, -0.8 } }, { { -0.5, 0.5, 1.5 } } });
  for (const std::int64_t count : { 1, 17 }) // a block, and several
  {
    const EulerGrid grid = { { 0, 0, 0 }, { 1, 1, 1 }, { count, count, count } };
    const EulerAverages averages =
      average(particles.frame(), request_for(grid, CellWeights::Overlap));
    EXPECT_EQ(averages.outside, 2) << count;
    const Box box = periodic_box({ -2, -2, -2 }, { 2, 2, 2 }, "pp pp pp");
    EXPECT_EQ(average(particles.frame(&box), request_for(grid, CellWeights::Overlap)).outside, 2);
  }
}

/// Places and radii of few bits, so that distances are exact.
TEST(EulerAverage, OutsideIsWhoseDistanceFromTheCellsIsARadiusOrMore)
{
  std::mt19937_64 random(9);
  std::vector<Particle> particles(500);
  std::int64_t outside = 0;
  for (Particle& particle : particles)
  {
    const auto whole = [&](std::uint64_t below)
    { return static_cast<std::int64_t>(random() % below); };
    const std::int64_t radius = 1 + whole(32);
    std::int64_t distance2 = 0;
    for (double& x : particle.x) // in sixteenths; the cells are from 0 to 16
    {
      const std::int64_t place = whole(80) - 32;
      const std::int64_t distance = std::max<std::int64_t>({ 0, -place, place - 16 });
      distance2 += distance * distance;
      x = static_cast<double>(place) / 16;
    }
    particle.radius = static_cast<double>(radius) / 16;
    outside += distance2 >= radius * radius ? 1 : 0;
  }
  for (const std::int64_t count : { 1, 3, 17 }) // the last has several blocks
  {
    const EulerGrid grid = { { 0, 0, 0 }, { 1, 1, 1 }, { count, count, count } };
    EXPECT_EQ(
      average(Grains(particles).frame(), request_for(grid, CellWeights::Overlap), 2).outside,
      outside)
      << count;
  }
}
