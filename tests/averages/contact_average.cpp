// SPDX-License-Identifier: BSD-3-Clause
// Stress, coordination and fabric of contacts in cells, against each line in each cell with 113 bits.
#include "exact_parts.h"
#include "made_touches.h"

#include "granular/common/error.h"

#include "../support/hard_case.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr Vector3 lo = { -1, 0, 2 };
constexpr Vector3 hi = { 1, 3, 3 };
constexpr std::size_t axes[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 0, 2 }, { 1, 2 } };

/// The part of a line in a cell: by length.
double clipped_part(
  const EulerGrid& grid, const Line& line, const std::array<std::int64_t, 3>& cell)
{
  Quad from = 0;
  Quad to = 1;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Quad b = line.branch[k];
    const Quad one = (Quad(grid.face(k, cell[k])) - line.start[k]) / b;
    const Quad other = (Quad(grid.face(k, cell[k] + 1)) - line.start[k]) / b;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return static_cast<double>(std::max<Quad>(to - from, 0));
}

/// Of all cells; by length, too, where the kernel has no cell.
std::vector<double> parts_of(const EulerAverageRequest& request, const Line& line)
{
  std::vector<double> parts;
  if (request.cells.weights == CellWeights::Kernel)
  {
    const Smoothing smoothing = { request.grid, request.cells.kernel, request.cells.width,
      request.cells.bounds };
    parts = exact_parts(smoothing, line).parts;
  }
  if (parts.empty())
  {
    CellRange({ {}, request.grid.counts })
      .each([&](const std::array<std::int64_t, 3>& cell)
        { parts.push_back(clipped_part(request.grid, line, cell)); });
  }
  return parts;
}

/// Of a cell.
struct PlainSums
{
  std::array<Quad, 6> stress = {};
  std::array<Quad, 6> terms = {}; ///< sums of the magnitudes of contacts that have a part here
  Quad ends = 0;
  Quad contacts = 0;
  std::array<Quad, 6> normals = {};
};

std::vector<PlainSums> plain_sums(const Scene& scene, const EulerAverageRequest& request)
{
  std::vector<PlainSums> sums(static_cast<std::size_t>(request.grid.size()));
  const auto add = [&](const Touch& touch, bool wall)
  {
    const Vector3 branch = branch_of(touch);
    const QuadVector b = to_quad(branch);
    const Quad square = product_of(b, b);
    const std::vector<double> parts = parts_of(request, { touch.from, branch });
    for (std::size_t cell = 0; cell < parts.size(); ++cell)
    {
      const Quad part = parts[cell];
      sums[cell].ends += part * (wall ? 1 : 2);
      sums[cell].contacts += part;
      for (std::size_t n = 0; n < 6; ++n)
      {
        const auto [i, j] = axes[n];
        // the branch of a wall begins at it, and the force is on the particle
        const Quad term = (wall ? -1 : 1) * b[i] * touch.force[j];
        sums[cell].stress[n] += part * term;
        sums[cell].terms[n] += part > 0 ? absolute(term) : 0;
        sums[cell].normals[n] += part * b[i] * b[j] / square;
      }
    }
  };
  for (const Touch& touch : scene.pairs)
  {
    add(touch, false);
  }
  for (const Touch& touch : scene.walls)
  {
    add(touch, true);
  }
  return sums;
}

double volume_of(const EulerGrid& grid)
{
  return (grid.hi[0] - grid.lo[0]) * (grid.hi[1] - grid.lo[1]) * (grid.hi[2] - grid.lo[2]) /
    static_cast<double>(grid.size());
}

/// The stress of a cell, xx yy zz xy xz yz.
double stress_of(const EulerFields& fields, std::size_t cell, std::size_t n)
{
  return n < 3 ? fields.contact_normal[3 * cell + n] : fields.contact_shear[3 * cell + n - 3];
}

const EulerGrid grid = { lo, hi, { 3, 4, 2 } };

std::vector<EulerAverageRequest> some_requests(const EulerGrid& cells)
{
  std::vector<EulerAverageRequest> requests = { request_of_contacts(cells, CellWeights::Centre),
    request_of_contacts(cells, CellWeights::Overlap) };
  for (const KernelShape shape : all_shapes)
  {
    for (const KernelBounds bounds : { KernelBounds::None, KernelBounds::Inside })
    {
      requests.push_back(request_of_contacts(cells, CellWeights::Kernel, shape, 0.4, bounds));
    }
  }
  return requests;
}
}

TEST(ContactAverage, IsThatOfEveryLineInEveryCell)
{
  HardCase hard("contact averages",
    "stress of contacts in cells, against 113 bits: error by branch times force of its contacts",
    "1", 1e-14);
  for (const unsigned seed : { 1U, 2U })
  {
    const Scene scene = random_scene(20, 25, 9, lo, hi, seed);
    for (const EulerAverageRequest& request : some_requests(grid))
    {
      const std::vector<PlainSums> exact = plain_sums(scene, request);
      const EulerAverages found = average_contacts_of(scene, nullptr, request);
      ASSERT_EQ(found.fields.coordination.size(), exact.size());
      for (std::size_t cell = 0; cell < exact.size(); ++cell)
      {
        const PlainSums& sums = exact[cell];
        for (std::size_t n = 0; n < 6; ++n)
        {
          const Quad stress = sums.stress[n] / volume_of(grid);
          const Quad scale = sums.terms[n] / volume_of(grid) + static_cast<Quad>(1e-10);
          const Quad error = absolute(stress_of(found.fields, cell, n) - stress) / scale;
          hard.add(static_cast<double>(error));
          const Quad fabric = sums.contacts > 0 ? sums.normals[n] / sums.contacts : 0;
          EXPECT_NEAR(found.fields.fabric[6 * cell + n], static_cast<double>(fabric), 1e-12);
        }
        if (sums.contacts > 0)
        {
          const double* const fabric = found.fields.fabric.data() + 6 * cell;
          EXPECT_NEAR(fabric[0] + fabric[1] + fabric[2], 1, 1e-14);
        }
        EXPECT_NEAR(found.sums.ends[cell], static_cast<double>(sums.ends), 1e-13);
        EXPECT_NEAR(found.sums.contacts[cell], static_cast<double>(sums.contacts), 1e-13);
        const double share = found.sums.share[cell];
        EXPECT_EQ(found.fields.coordination[cell], share > 0 ? found.sums.ends[cell] / share : 0.0);
      }
    }
  }
}

TEST(ContactAverage, CellsTogetherHaveTheStressOfAllContacts)
{
  HardCase hard("contact averages",
    "sum of stress times volume over all cells, by branch times force: relative error", "1", 1e-13);
  Box box = Box::from_bounds(lo, hi);
  const Scene scene = with_ends(random_scene(50, 60, 15, lo, hi, 3));
  for (const char* const boundary : { "ff ff ff", "pp ff pp", "pp pp pp" })
  {
    box.boundary = boundary;
    for (const std::array<std::int64_t, 3>& counts :
      { std::array<std::int64_t, 3>{ 5, 6, 4 }, { 1, 1, 9 }, { 1, 1, 1 } })
    {
      const EulerGrid cells = { lo, hi, counts };
      for (const EulerAverageRequest& request : some_requests(cells))
      {
        const bool open = request.cells.weights == CellWeights::Kernel &&
          request.cells.bounds == KernelBounds::None;
        if (open && box.boundary != "pp pp pp")
        {
          continue; // loses what is beyond the faces
        }
        const EulerFields fields = average_contacts_of(scene, &box, request).fields;
        for (std::size_t n = 0; n < 6; ++n)
        {
          Quad all = 0;
          Quad expected = 0;
          Quad terms = 0;
          for (std::size_t cell = 0; cell < static_cast<std::size_t>(cells.size()); ++cell)
          {
            all += Quad(stress_of(fields, cell, n)) * volume_of(cells);
          }
          const auto add = [&](const Touch& touch, int sign)
          {
            const auto [i, j] = axes[n];
            const Quad term = Quad(branch_of(touch)[i]) * touch.force[j] * sign;
            expected += term;
            terms += absolute(term);
          };
          std::ranges::for_each(scene.pairs, [&](const Touch& touch) { add(touch, 1); });
          std::ranges::for_each(scene.walls, [&](const Touch& touch) { add(touch, -1); });
          hard.add(static_cast<double>(absolute(all - expected) / terms));
        }
      }
    }
  }
}

/// A lattice in a periodic box under forces that are the same for all contacts of a direction: sigma_ab = d f^a_b / d^3.
TEST(ContactAverage, ALatticeHasOneStress)
{
  for (const double d : { 0.25, 0.1 })
  {
    constexpr std::int64_t n = 4;
    const Vector3 from = { -d, 0.3, 7 * d };
    const Vector3 to = { from[0] + n * d, from[1] + n * d, from[2] + n * d };
    Box box = Box::from_bounds(from, to);
    box.boundary = "pp pp pp";
    const Vector3 forces[3] = { { -3, 0.5, 0.25 }, { 0.5, -2, 0.75 }, { 0.25, 0.75, -5 } };
    Scene scene;
    for (std::int64_t i = 0; i < n * n * n; ++i)
    {
      const std::array<std::int64_t, 3> at = { i % n, i / n % n, i / (n * n) };
      Vector3 x;
      for (std::size_t k = 0; k < 3; ++k)
      {
        x[k] = from[k] + d * static_cast<double>(at[k]);
      }
      scene.particles.push_back({ x, {}, d / 2, 1 });
      scene.ids.push_back(i + 1);
      for (std::size_t k = 0; k < 3; ++k)
      {
        std::array<std::int64_t, 3> next = at;
        next[k] = (next[k] + 1) % n;
        Touch touch = { i + 1, (next[2] * n + next[1]) * n + next[0] + 1, x, x, forces[k] };
        touch.to[k] += d;
        scene.pairs.push_back(touch);
      }
    }
    for (const std::int64_t cells : { 1, 4 })
    {
      for (EulerAverageRequest request : some_requests({ from, to, { cells, cells, cells } }))
      {
        request.cells.width = 0.9 * d; // also Heaviside has cells
        const EulerFields fields = average_contacts_of(scene, &box, request).fields;
        for (std::size_t cell = 0; cell < fields.coordination.size(); ++cell)
        {
          for (std::size_t m = 0; m < 6; ++m)
          {
            const double expected = forces[axes[m][0]][axes[m][1]] / (d * d);
            EXPECT_NEAR(stress_of(fields, cell, m) / expected, 1, 1e-12) << d << " " << cells;
            EXPECT_NEAR(fields.fabric[6 * cell + m], m < 3 ? 1.0 / 3 : 0, 1e-12);
          }
          EXPECT_NEAR(fields.coordination[cell], 6, 1e-11);
        }
      }
    }
  }
}
