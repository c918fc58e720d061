// SPDX-License-Identifier: BSD-3-Clause
// Particles and contacts divided by a kernel, with their periodic images, and where the kernel has no cell.
#include "exact_parts.h"

#include "granular/averages/line_cells.h"
#include "granular/averages/particle_cells.h"
#include "granular/grid/sphere_box.h"

#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr Vector3 lo = { -1, 0, 2 };
constexpr Vector3 hi = { 1, 3, 3 };

Box periodic_box(const std::array<bool, 3>& periodic)
{
  Box box = Box::from_bounds(lo, hi);
  box.boundary = "";
  for (const bool is : periodic)
  {
    box.boundary += is ? "pp " : "ff ";
  }
  return box;
}

WeightOptions options_of(const Smoothing& smoothing)
{
  WeightOptions options;
  options.weights = CellWeights::Kernel;
  options.kernel = smoothing.shape;
  options.width = smoothing.width;
  options.bounds = smoothing.bounds;
  return options;
}

/// Of all cells: of a particle, if the line is a point, or of a contact; and the cells of each_range.
struct Shares
{
  Shares(const Smoothing& smoothing, const Line& line, bool contact, const Box* other_box = nullptr)
    : shares(smoothing.cells())
    , in_range(smoothing.cells())
  {
    const Box box = other_box ? *other_box : periodic_box(smoothing.periodic);
    const CellRange all = { {}, smoothing.grid.counts };
    const auto add = [&](std::int64_t cell, double share)
    {
      EXPECT_GT(share, 0);
      EXPECT_LE(share, 1);
      shares[static_cast<std::size_t>(cell)] += share;
    };
    const auto visit = [&](const CellRange& range)
    {
      range.each([&](const std::array<std::int64_t, 3>& cell)
        { in_range[static_cast<std::size_t>(all.number(cell))] = true; });
    };
    if (contact)
    {
      const LineCells cells(smoothing.grid, options_of(smoothing), &box);
      EXPECT_GE(cells.check(length_of(line.branch)), 1);
      LineCells::Room room;
      cells.each_share(line.start, line.branch, all, room, add);
      cells.each_range(line.start, line.branch, visit);
      return;
    }
    ParticleCells cells(smoothing.grid, options_of(smoothing), &box);
    EXPECT_GE(cells.check(0.1), 1);
    EXPECT_FALSE(cells.is_direct());
    cells.set_largest_volume(sphere_volume(0.1));
    ParticleCells::Shares room;
    cells.each_share(line.start.data(), 0.1, all, room,
      [&](std::int64_t cell, double share, double volume)
      {
        add(cell, share);
        EXPECT_EQ(volume, sphere_volume(0.1) * share);
        EXPECT_EQ(std::ldexp(share, 64), std::floor(std::ldexp(share, 64)));
      });
    cells.each_range(line.start.data(), 0.1, visit);
  }

  double sum() const
  {
    return static_cast<double>(std::accumulate(shares.begin(), shares.end(), Quad(0)));
  }

  std::vector<double> shares;
  std::vector<bool> in_range;
};

/// No cell is within the support.
bool is_far(const Smoothing& smoothing, const Line& line)
{
  bool far = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double middle = line.start[axis] + line.branch[axis] / 2;
    const double reach = smoothing.support() + std::abs(line.branch[axis]);
    far =
      far || middle < smoothing.grid.lo[axis] - reach || middle > smoothing.grid.hi[axis] + reach;
  }
  return far;
}

Box random_box(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> unit(0, 1);
  const double scale = std::pow(10, 6 * unit(random) - 3);
  Vector3 from;
  Vector3 to;
  for (std::size_t k = 0; k < 3; ++k)
  {
    from[k] = scale * (unit(random) - 0.7);
    to[k] = from[k] + scale * (0.1 + unit(random));
  }
  Box box = Box::from_bounds(from, to);
  box.boundary = "pp pp pp";
  return box;
}

/// Once, and not less or twice.
bool is_one(double sum)
{
  return std::abs(sum - 1) < 1e-14;
}

/// Of all images that are up to two periods away.
std::vector<double> exact_with_images(const Smoothing& smoothing, const Line& line)
{
  std::vector<double> all(smoothing.cells());
  const auto images = [&](std::size_t axis) { return smoothing.periodic[axis] ? 2 : 0; };
  for (int i = -images(0); i <= images(0); ++i)
  {
    for (int j = -images(1); j <= images(1); ++j)
    {
      for (int k = -images(2); k <= images(2); ++k)
      {
        Line image = line;
        image.start[0] += i * (hi[0] - lo[0]);
        image.start[1] += j * (hi[1] - lo[1]);
        image.start[2] += k * (hi[2] - lo[2]);
        if (is_far(smoothing, image))
        {
          continue;
        }
        const std::vector<double> parts = exact_parts(smoothing, image).parts;
        std::transform(parts.begin(), parts.end(), all.begin(), all.begin(), std::plus<>());
      }
    }
  }
  return all;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& exact)
{
  ASSERT_EQ(found.size(), exact.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_NEAR(found[i], exact[i], 1e-13) << i;
  }
}

const std::array<bool, 3> periodicities[] = { { true, true, true }, { true, false, true },
  { false, true, false } };
}

TEST(KernelWeights, ImagesReachThroughPeriodicFaces)
{
  for (const std::array<std::int64_t, 3>& counts :
    { std::array<std::int64_t, 3>{ 5, 6, 3 }, { 4, 1, 7 } })
  {
    for (const std::array<bool, 3>& periodic : periodicities)
    {
      for (const KernelShape shape : all_shapes)
      {
        const Smoothing smoothing = { { lo, hi, counts }, shape, 0.25, KernelBounds::None,
          periodic };
        for (const double length : { 0.0, 0.5 })
        {
          for (const Line& line : random_lines(smoothing.grid, 3, length, 1))
          {
            const Shares found(smoothing, line, length > 0);
            expect_near(found.shares, exact_with_images(smoothing, line));
            for (std::size_t i = 0; i < found.shares.size(); ++i)
            {
              EXPECT_TRUE(found.shares[i] == 0 || found.in_range[i]);
            }
          }
        }
      }
    }
  }
}

TEST(KernelWeights, NothingIsLostInAPeriodicBoxOrInsideWalls)
{
  HardCase hard("kernels", "parts with periodic images, or kept inside: sum minus 1", "1", 1e-13);
  for (const std::array<bool, 3>& periodic : periodicities)
  {
    for (const std::array<std::int64_t, 3>& counts :
      { std::array<std::int64_t, 3>{ 9, 13, 5 }, { 1, 7, 1 }, { 3, 2, 5 } })
    {
      for (const KernelShape shape : all_shapes)
      {
        for (const double width : { 0.01, 0.3, 1.2 })
        {
          const Smoothing smoothing = { { lo, hi, counts }, shape, width, KernelBounds::Inside,
            periodic };
          for (const double length : { 0.0, 0.2 })
          {
            for (const Line& line : random_lines(smoothing.grid, 2, length, 2))
            {
              // particles may be images themselves; what the kernel has no cell for is cut at walls
              Line moved = line;
              moved.start[0] += periodic[0] ? 6 : 0;
              const Shares found(smoothing, moved, length > 0);
              if (width > 0.01 || length == 0)
              {
                hard.add(std::abs(found.sum() - 1));
              }
            }
          }
        }
      }
    }
  }
}

TEST(KernelWeights, NarrowKernelsGiveParticlesToTheCellOfTheirCentre)
{
  const Smoothing smoothing = { { lo, hi, { 4, 6, 2 } }, KernelShape::Lucy, 1e-3,
    KernelBounds::None, { true, false, false } };
  const auto expect_cell = [&](const Vector3& place, std::size_t cell)
  {
    const Shares found(smoothing, { place, {} }, false);
    EXPECT_EQ(found.sum(), cell < 48 ? 1 : 0);
    EXPECT_TRUE(cell >= 48 || (found.shares[cell] == 1 && found.in_range[cell]));
  };
  expect_cell({ 0.1, 1.1, 2.1 }, (0 * 6 + 2) * 4 + 2);
  expect_cell({ 0.5, 1.0, 2.5 }, (1 * 6 + 2) * 4 + 3); // on faces
  expect_cell({ -1, 3, 3 }, (1 * 6 + 5) * 4);
  expect_cell({ 1, 3, 3 }, (1 * 6 + 5) * 4); // the same place, of which there is one
  expect_cell({ 1.2, 0.1, 2.1 }, 0);
  expect_cell({ -2.9, 0.1, 2.1 }, 2 - 2 + 0 + 0 * 4);
  expect_cell({ 0.1, 3.1, 2.1 }, 99);
  expect_cell({ 0.1, 1.1, 1.9 }, 99);
}

TEST(KernelWeights, NarrowKernelsCutContactsAtFaces)
{
  const Smoothing smoothing = { { { 0, 0, 0 }, { 4, 4, 4 }, { 4, 4, 4 } }, KernelShape::Gaussian,
    1e-3 };
  const Shares found(smoothing, { { 1.75, 2.25, 0.1 }, { 1, 0, 0 } }, true);
  EXPECT_EQ(found.shares[2 * 4 + 1], 0.25);
  EXPECT_EQ(found.shares[2 * 4 + 2], 0.75);
  EXPECT_EQ(found.sum(), 1);
}

TEST(KernelWeights, OnFacesOfAPeriodicAxisWithOneCellImagesCountOnce)
{
  for (const KernelShape shape : all_shapes)
  {
    const Smoothing smoothing = { { lo, hi, { 1, 1, 4 } }, shape, 0.3, KernelBounds::Inside,
      { true, true, false } };
    const std::vector<double> expected = Shares(smoothing, { { 0, 1, 2.3 }, {} }, false).shares;
    for (const Vector3& place : { Vector3{ lo[0], lo[1], 2.3 }, Vector3{ hi[0], hi[1], 2.3 },
           Vector3{ hi[0] + 2, 1, 2.3 }, Vector3{ 0, lo[1] - 3, 2.3 } })
    {
      EXPECT_EQ(Shares(smoothing, { place, {} }, false).shares, expected);
    }
    const auto of_line = [&](const Vector3& middle)
    {
      return Shares(smoothing, { { middle[0] - 0.25, middle[1], middle[2] }, { 0.5, 0, 0 } }, true)
        .shares;
    };
    EXPECT_EQ(of_line({ hi[0], hi[1], 2.3 }), of_line({ 0, 1, 2.3 }));
    EXPECT_EQ(of_line({ lo[0], lo[1], 2.3 }), of_line({ 0, 1, 2.3 }));
  }
}

/// As lattices that fit into a box have them: on faces of any numbers, an ulp beside them, and across.
TEST(KernelWeights, OnPeriodicFacesOfAnyNumbersNothingIsLostOrTwice)
{
  HardCase hard("kernels",
    "particles and lines on periodic faces, one cell there: sum other than 1", "sums", 0);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i)
  {
    Box box = random_box(random);
    const BoxBounds bounds = box.bounds();
    const std::size_t axis = random() % 3;
    const double lower = bounds.lo[axis];
    const double upper = bounds.hi[axis];
    const double scale = std::pow(10, 2 * unit(random) - 3);
    Smoothing smoothing = { { bounds.lo, bounds.hi, { 1, 1, 1 } }, KernelShape::Lucy,
      0.1 *
        std::min({ bounds.hi[0] - bounds.lo[0], bounds.hi[1] - bounds.lo[1],
          bounds.hi[2] - bounds.lo[2] }) };
    smoothing.grid.counts[(axis + 1) % 3] = 1 + static_cast<std::int64_t>(random() % 2);
    smoothing.periodic = { true, true, true };
    for (const double face : { lower, upper, std::nextafter(lower, -1e9),
           std::nextafter(lower, 1e9), std::nextafter(upper, -1e9), std::nextafter(upper, 1e9),
           upper - (upper - lower) * 0x1p-56 })
    {
      Line line;
      for (std::size_t k = 0; k < 3; ++k)
      {
        line.start[k] = bounds.lo[k] + (bounds.hi[k] - bounds.lo[k]) * unit(random);
      }
      line.start[axis] = face;
      hard.add(is_one(Shares(smoothing, line, false, &box).sum()) ? 0 : 1);
      line.branch[axis] = scale * (upper - lower);
      line.start[axis] = face - line.branch[axis] / 2; // the middle is there
      hard.add(is_one(Shares(smoothing, line, true, &box).sum()) ? 0 : 1);
    }
  }
}

/// A period that is no multiple of the cells.
TEST(KernelWeights, GridsBesideAPeriodicBoxHaveItsImages)
{
  for (const KernelShape shape : all_shapes)
  {
    const Smoothing smoothing = { { { -1.4, 0.3, 2 }, { 1.9, 2.2, 3 }, { 7, 3, 2 } }, shape, 0.5,
      KernelBounds::None, { true, true, false } };
    for (const double length : { 0.0, 0.5 })
    {
      for (const Line& line : random_lines({ lo, hi, { 1, 1, 1 } }, 10, length, 3))
      {
        expect_near(Shares(smoothing, line, length > 0).shares, exact_with_images(smoothing, line));
      }
    }
  }
}
