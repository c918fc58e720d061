// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/sphere_cells.h"

#include "exact_sphere_box.h"
#include "granular/grid/sphere_box.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using granular::CellRange;
using granular::CellShare;
using granular::EulerGrid;
using granular::sphere_volume;
using granular::SphereCells;
using granular::Twofold;
using granular::Twofold3;
using granular::Vector3;

using Cell = std::array<std::int64_t, 3>;

CellRange all_of(const EulerGrid& grid)
{
  return { {}, grid.counts };
}

std::vector<CellShare> find(
  const SphereCells& cells, const EulerGrid& grid, const Twofold3& centre, double radius)
{
  std::vector<CellShare> shares;
  cells.find(centre, radius, all_of(grid), shares);
  return shares;
}

double sum(const std::vector<CellShare>& shares)
{
  granular::CompensatedSum sum;
  for (const CellShare& share : shares)
  {
    sum.add(share.volume);
  }
  return sum.value();
}

/// Each cell at most once, of the grid, with a volume.
std::map<std::int64_t, double> by_cell(const std::vector<CellShare>& shares, const EulerGrid& grid)
{
  std::map<std::int64_t, double> volumes;
  for (const CellShare& share : shares)
  {
    EXPECT_TRUE(volumes.emplace(share.cell, share.volume).second) << share.cell;
    EXPECT_TRUE(0 <= share.cell && share.cell < grid.size()) << share.cell;
    EXPECT_GT(share.volume, 0);
  }
  return volumes;
}

Twofold3 twofold(const Vector3& centre)
{
  return { { { centre[0], 0 }, { centre[1], 0 }, { centre[2], 0 } } };
}

struct Random
{
  explicit Random(std::uint64_t seed)
    : random(seed)
  {
  }

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random); }
  double power(double from, double to) { return std::pow(10, from + (to - from) * this->unit()); }
  bool one_in(std::uint64_t n) { return random() % n == 0; }

  std::mt19937_64 random;
};

/// Around a sphere at the origin, of radius 1: so many cells to a diameter, and at least one beyond it on each side.
EulerGrid grid_around(Random& random, const Vector3& cells_a_diameter)
{
  EulerGrid grid;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double edge = 2 / cells_a_diameter[k];
    grid.lo[k] = -1 - edge * (0.1 + random.unit());
    grid.counts[k] = static_cast<std::int64_t>((1 - grid.lo[k]) / edge) + 2;
    grid.hi[k] = grid.lo[k] + static_cast<double>(grid.counts[k]) * edge;
  }
  return grid;
}

Vector3 middle_of(const EulerGrid& grid, const Cell& cell)
{
  return { grid.centre(0, cell[0]), grid.centre(1, cell[1]), grid.centre(2, cell[2]) };
}

// ---- by hand -----------------------------------------------------------------------------------

const EulerGrid six = { { 0, 0, 0 }, { 3, 2, 1 }, { 3, 2, 1 } };

TEST(SphereCells, WhatIsOutsideIsInNone)
{
  const SphereCells cells(six);
  EXPECT_TRUE(find(cells, six, twofold({ 3.5, 0.5, 0.5 }), 0.5).empty()); // touches
  EXPECT_TRUE(find(cells, six, twofold({ -5, 0.5, 0.5 }), 1).empty());
  EXPECT_TRUE(find(cells, six, twofold({ 4, 3, 0.5 }), 1.25).empty()); // beyond an edge
  EXPECT_TRUE(find(cells, six, twofold({ 1, 1, 1 }), 0).empty());
  const auto half = find(cells, six, twofold({ 3, 1.5, 0.5 }), 0.25);
  ASSERT_EQ(half.size(), 1U);
  EXPECT_EQ(half[0].cell, 5);
  EXPECT_DOUBLE_EQ(half[0].volume, sphere_volume(0.25) / 2);
  const auto corner = find(cells, six, twofold({ 0, 0, 0 }), 0.25);
  ASSERT_EQ(corner.size(), 1U);
  EXPECT_EQ(corner[0].cell, 0);
  EXPECT_DOUBLE_EQ(corner[0].volume, sphere_volume(0.25) / 8);
  // a centre beyond the bounds: a cap of height 1/8
  const auto cap = find(cells, six, twofold({ -0.125, 0.5, 0.5 }), 0.25);
  ASSERT_EQ(cap.size(), 1U);
  EXPECT_EQ(cap[0].cell, 0);
  EXPECT_NEAR(cap[0].volume, 5 * sphere_volume(0.25) / 32, 1e-16);
  // around all of it
  const auto inside = by_cell(find(cells, six, twofold({ 1, 1, 1 }), 9), six);
  ASSERT_EQ(inside.size(), 6U);
  for (const auto& [cell, volume] : inside)
  {
    EXPECT_EQ(volume, 1) << cell;
  }
}

TEST(SphereCells, SharesAreAddedToWhatIsThere)
{
  const SphereCells cells(six);
  std::vector<CellShare> shares = { { 77, 7 } };
  cells.find(twofold({ 1.5, 0.5, 0.5 }), 0.25, all_of(six), shares);
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_EQ(shares[0].cell, 77);
  EXPECT_EQ(shares[1].cell, 1);
}

// ---- sums --------------------------------------------------------------------------------------

void expect_whole(Random& random, const Vector3& cells_a_diameter)
{
  const EulerGrid grid = grid_around(random, cells_a_diameter);
  const auto shares = find(SphereCells(grid), grid, {}, 1);
  EXPECT_NEAR(sum(shares) / sphere_volume(1), 1, 1e-13)
    << cells_a_diameter[0] << " " << cells_a_diameter[1] << " " << cells_a_diameter[2] << ", "
    << shares.size() << " cells";
}

TEST(SphereCells, SharesAddUpToTheSphere)
{
  Random random(1);
  for (int i = 0; i < 400; ++i)
  {
    const double n = random.power(-1, 1.3);
    expect_whole(random, { n, n, n });
  }
  for (int i = 0; i < 100; ++i)
  {
    expect_whole(random, { random.power(-1, 1.5), random.power(-1, 1.5), random.power(-1, 1.5) });
  }
  expect_whole(random, { 124, 124, 124 }); // a million
  expect_whole(random, { 1, 1, 1e5 });     // plates
  expect_whole(random, { 0.1, 400, 400 }); // needles
}

// ---- each cell ---------------------------------------------------------------------------------

/// Grains of all sizes, near faces and corners, across the bounds, with centres of 106 bits.
struct Particle
{
  EulerGrid grid;
  Twofold3 centre;
  double radius;
};

Particle make_particle(Random& random, double largest)
{
  Particle particle = { {}, {}, 0 };
  const double place = random.one_in(4) ? 1e4 : 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
  {
    particle.grid.counts[k] = 1 + static_cast<std::int64_t>(9 * random.unit());
    particle.grid.lo[k] = place + random.unit();
    particle.grid.hi[k] = particle.grid.lo[k] +
      static_cast<double>(particle.grid.counts[k]) * (random.one_in(4) ? random.power(-3, 0) : 1);
    smallest = std::min(smallest, particle.grid.spacing(k));
  }
  particle.radius = smallest * random.power(-2, std::log10(largest));
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto faces = particle.grid.faces(k);
    const double length = faces.back() - faces.front();
    double x = faces.front() + length * random.unit();
    if (random.one_in(3))
    {
      x = faces[static_cast<std::size_t>(random.unit() * static_cast<double>(faces.size()))];
      x += random.one_in(2) ? particle.radius * (1 - 2 * random.unit()) : 0;
      x += random.one_in(8) ? particle.radius : 0;
    }
    particle.centre[k] = { x, random.one_in(3) ? 0 : x * 0x1p-53 * (1 - 2 * random.unit()) };
  }
  return particle;
}

/// Centres, radii and faces of few bits: on faces, edges and corners, tangent to others, beside the grid.
Particle make_round_particle(Random& random)
{
  Particle particle = { {}, {}, std::ldexp(1 + static_cast<double>(random.random() % 12), -3) };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double edge = std::ldexp(1, static_cast<int>(random.random() % 12) - 10);
    particle.grid.counts[k] = 1 + static_cast<std::int64_t>(random.random() % 8);
    particle.grid.hi[k] = static_cast<double>(particle.grid.counts[k]) * edge;
    particle.centre[k].hi = random.one_in(3)
      ? particle.grid.face(
          k, static_cast<std::int64_t>(random.random() % 9) % particle.grid.counts[k])
      : std::ldexp(static_cast<double>(random.random() % 64) - 16, -3);
  }
  return particle;
}

std::string to_text(const Particle& particle)
{
  std::ostringstream out;
  out.precision(17);
  for (std::size_t k = 0; k < 3; ++k)
  {
    out << particle.grid.lo[k] << ".." << particle.grid.hi[k] << " / " << particle.grid.counts[k]
        << " at " << particle.centre[k].hi << " + " << particle.centre[k].lo << ", ";
  }
  out << "radius " << particle.radius;
  return out.str();
}

template <typename Visit>
void each_cell(const EulerGrid& grid, const Visit& visit)
{
  std::int64_t number = 0;
  for (std::int64_t k = 0; k < grid.counts[2]; ++k)
  {
    for (std::int64_t j = 0; j < grid.counts[1]; ++j)
    {
      for (std::int64_t i = 0; i < grid.counts[0]; ++i)
      {
        visit(number, Vector3{ grid.face(0, i), grid.face(1, j), grid.face(2, k) },
          Vector3{ grid.face(0, i + 1), grid.face(1, j + 1), grid.face(2, k + 1) });
        ++number;
      }
    }
  }
}

TEST(SphereCells, EachShareIsExact)
{
  Random random(2);
  for (int i = 0; i < 400; ++i)
  {
    const Particle particle = make_particle(random, 6);
    for (const bool short_cuts : { true, false })
    {
      const SphereCells cells(particle.grid, short_cuts);
      auto shares =
        by_cell(find(cells, particle.grid, particle.centre, particle.radius), particle.grid);
      each_cell(particle.grid,
        [&](std::int64_t cell, const Vector3& lo, const Vector3& hi)
        {
          const ExactVolume exact = exact_sphere_box(particle.centre, particle.radius, lo, hi);
          const auto share = shares.find(cell);
          const Quad volume = share == shares.end() ? 0 : share->second;
          EXPECT_TRUE(absolute(volume - exact.value) <= exact.tolerance)
            << to_text(particle) << ", cell " << cell << ": got " << static_cast<double>(volume)
            << ", expected " << static_cast<double>(exact.value);
        });
    }
  }
}

/// A sphere that the corner of a cell touches, but for an ulp or so.
Particle make_touching_particle(Random& random)
{
  Particle particle = make_particle(random, 3);
  const Vector3 direction = { random.unit() - 0.5, random.unit() - 0.5,
    random.one_in(2) ? 0 : random.unit() - 0.5 };
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  const double distance =
    particle.radius * (1 + (random.one_in(2) ? 0 : 1e-15 * (random.unit() - 0.5)));
  for (std::size_t k = 0; k < 3; ++k)
  {
    const bool outer = random.one_in(2);
    const auto face = static_cast<std::int64_t>(
      random.unit() * static_cast<double>(outer ? 2 : particle.grid.counts[k] + 1));
    particle.centre[k] = { particle.grid.face(k, outer ? face * particle.grid.counts[k] : face) +
        direction[k] / length * distance,
      0 };
  }
  return particle;
}

/// Small spheres and large ones, anywhere, on faces, or touching: the short cuts give the bits of the long way.
TEST(SphereCells, ShortCutsChangeNothing)
{
  Random random(3);
  for (int i = 0; i < 60000; ++i)
  {
    const Particle particle = i % 3 == 0 ? make_particle(random, 3)
      : i % 3 == 1                       ? make_round_particle(random)
                                         : make_touching_particle(random);
    const auto quick =
      by_cell(find(SphereCells(particle.grid), particle.grid, particle.centre, particle.radius),
        particle.grid);
    const auto slow = by_cell(
      find(SphereCells(particle.grid, false), particle.grid, particle.centre, particle.radius),
      particle.grid);
    ASSERT_EQ(quick, slow) << to_text(particle);
  }
}

/// What one thread finds in its cells is what it finds in all of them, bit for bit.
TEST(SphereCells, RangesHaveTheirShares)
{
  Random random(4);
  for (int i = 0; i < 2000; ++i)
  {
    const Particle particle = make_particle(random, 4);
    const EulerGrid& grid = particle.grid;
    const SphereCells cells(grid);
    const auto whole = by_cell(find(cells, grid, particle.centre, particle.radius), grid);
    CellRange within;
    Cell sizes = {};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto count = static_cast<double>(grid.counts[k]);
      within.first[k] = static_cast<std::int64_t>(random.unit() * count);
      within.last[k] = within.first[k] +
        static_cast<std::int64_t>(
          random.unit() * static_cast<double>(grid.counts[k] - within.first[k] + 1));
      sizes[k] = within.last[k] - within.first[k];
    }
    std::vector<CellShare> shares;
    cells.find(particle.centre, particle.radius, within, shares);
    std::map<std::int64_t, double> part;
    for (const CellShare& share : shares)
    {
      ASSERT_TRUE(0 <= share.cell && share.cell < sizes[0] * sizes[1] * sizes[2]);
      const std::int64_t x = within.first[0] + share.cell % sizes[0];
      const std::int64_t y = within.first[1] + share.cell / sizes[0] % sizes[1];
      const std::int64_t z = within.first[2] + share.cell / (sizes[0] * sizes[1]);
      part[(z * grid.counts[1] + y) * grid.counts[0] + x] = share.volume;
    }
    ASSERT_EQ(part.size(), shares.size());
    std::size_t expected = 0;
    for (const auto& [cell, volume] : whole)
    {
      const Cell at = { cell % grid.counts[0], cell / grid.counts[0] % grid.counts[1],
        cell / (grid.counts[0] * grid.counts[1]) };
      bool is_within = true;
      for (std::size_t k = 0; k < 3; ++k)
      {
        is_within = is_within && within.first[k] <= at[k] && at[k] < within.last[k];
      }
      if (is_within)
      {
        ++expected;
        ASSERT_EQ(part.count(cell), 1U) << to_text(particle);
        EXPECT_EQ(part.at(cell), volume) << to_text(particle);
      }
    }
    EXPECT_EQ(part.size(), expected) << to_text(particle);
  }
}

// ---- ranges ------------------------------------------------------------------------------------

/// In exact arithmetic: cells whose inside the bounds reach are in the range, and at most one more at each end, which
/// the bounds touch but for rounding. A sphere beside the grid has none, however near its bounds are.
TEST(SphereCells, RangesAreNeverTooSmall)
{
  Random random(5);
  int beside = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Particle particle = make_particle(random, 8);
    const EulerGrid& grid = particle.grid;
    const CellRange range = SphereCells(grid).range(particle.centre, particle.radius);
    std::array<std::int64_t, 3> first = {};
    std::array<std::int64_t, 3> last = {};
    Quad nearest2 = 0;
    bool is_any = true;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Quad centre =
        static_cast<Quad>(particle.centre[k].hi) + static_cast<Quad>(particle.centre[k].lo);
      const Quad radius = particle.radius;
      const Quad distance = std::max({ Quad(0), grid.lo[k] - centre, centre - grid.hi[k] });
      nearest2 += distance * distance;
      first[k] = grid.counts[k];
      for (std::int64_t cell = 0; cell < grid.counts[k]; ++cell)
      {
        const Quad lo = static_cast<Quad>(grid.face(k, cell)) - centre;
        const Quad hi = static_cast<Quad>(grid.face(k, cell + 1)) - centre;
        if (lo < radius && hi > -radius)
        {
          first[k] = std::min(first[k], cell);
          last[k] = cell + 1;
        }
      }
      is_any = is_any && first[k] < last[k];
    }
    const Quad ratio = nearest2 / (static_cast<Quad>(particle.radius) * particle.radius);
    if (absolute(ratio - 1) > 0x1p-40) // else rounding decides
    {
      EXPECT_EQ(range.size() > 0, ratio < 1) << to_text(particle);
      beside += is_any && ratio > 1 ? 1 : 0;
    }
    for (std::size_t k = 0; k < 3 && is_any && ratio < 1 - 0x1p-40; ++k)
    {
      EXPECT_LE(range.first[k], first[k]) << to_text(particle);
      EXPECT_GE(range.last[k], last[k]) << to_text(particle);
      EXPECT_GE(range.first[k], std::max<std::int64_t>(0, first[k] - 1)) << to_text(particle);
      EXPECT_LE(range.last[k], std::min(grid.counts[k], last[k] + 1)) << to_text(particle);
    }
  }
  EXPECT_GT(beside, 20);
  const SphereCells cells(six);
  EXPECT_EQ(cells.range(twofold({ 1.5, 1.5, 0.5 }), 0.25).first, (Cell{ 1, 1, 0 }));
  EXPECT_EQ(cells.range(twofold({ 1.5, 1.5, 0.5 }), 0.25).last, (Cell{ 2, 2, 1 }));
  const CellRange none = cells.range(twofold({ 9, 0.5, 0.5 }), 1);
  EXPECT_EQ(none.first, none.last);
  EXPECT_EQ(cells.range(twofold({ -0.8, -0.8, -0.8 }), 1).size(), 0);
}

/// The bits of a centre below those of a double count.
TEST(SphereCells, CentresHave106Bits)
{
  const double radius = 0x1p-40;
  const double below = -0x1p-41; // by half the radius
  const EulerGrid far = { { 4096, 0, 0 }, { 4098, 1, 1 }, { 2, 1, 1 } };
  const auto shares = by_cell(
    find(SphereCells(far), far, { { { 4097, below }, { 0.5, 0 }, { 0.5, 0 } } }, radius), far);
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_NEAR(shares.at(1) / sphere_volume(radius), 5.0 / 32, 1e-15);
  EXPECT_NEAR(shares.at(0) / sphere_volume(radius), 27.0 / 32, 1e-15);
}

TEST(SphereCells, NumbersOfAnySize)
{
  const EulerGrid huge = { { -1e300, -1e300, -1e300 }, { 1e300, 1e300, 1e300 }, { 4, 4, 4 } };
  EXPECT_EQ(find(SphereCells(huge), huge, twofold({ 1e299, 1e299, 1e299 }), 1).size(), 1U);
  for (const CellShare& share : find(SphereCells(huge), huge, {}, 9e299))
  {
    EXPECT_GT(share.volume, 0); // infinite
  }
  const EulerGrid tiny = { { 0, 0, 0 }, { 1e-100, 1e-100, 1e-100 }, { 3, 3, 3 } };
  const auto middle = middle_of(tiny, { 1, 1, 1 });
  const auto shares = find(SphereCells(tiny), tiny, twofold(middle), 4e-101);
  EXPECT_EQ(shares.size(), 27U);
  EXPECT_NEAR(sum(shares) / sphere_volume(4e-101), 1, 1e-13);
  EXPECT_TRUE(find(SphereCells(tiny), tiny, twofold(middle), 1e-200).empty()); // has no volume
}
}
