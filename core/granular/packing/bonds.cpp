// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing_plan.h"

#include "granular/common/error.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

namespace granular
{
namespace
{
constexpr double least_factor = 1;
constexpr double most_factor = 3;
constexpr std::size_t rows_a_chunk = 8192;

/// A particle and an image of a later one.
struct Pair
{
  std::int64_t first;
  std::int64_t second;
  PeriodicImage image;
};

using Pairs = std::vector<Pair>;

/// A pair that may be bonded, and the distance of its centres.
struct Candidate
{
  Pair pair;
  double distance;
};

/// The vector from a point to a periodic image, each component rounded once, as lines through faces are made.
Vector3 exact_vector(
  const Vector3& from, const Vector3& to, const PeriodicImage& image, const Box& box)
{
  Vector3 vector;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    CompensatedSum sum;
    sum.add(to[axis]);
    sum.add(-from[axis]);
    for (std::size_t k = 0; k < 3; ++k)
    {
      sum.add_product(static_cast<double>(image[k]), box.vectors[k][axis]);
    }
    vector[axis] = sum.value();
  }
  return vector;
}

/// Returns true if a comes first: of images that are equally near, the one that was moved the least.
bool comes_before(const Candidate& a, const Candidate& b)
{
  const auto moves = [](const PeriodicImage& image)
  { return std::abs(image[0]) + std::abs(image[1]) + std::abs(image[2]); };
  return std::tuple(a.pair.second, moves(a.pair.image), a.pair.image) <
    std::tuple(b.pair.second, moves(b.pair.image), b.pair.image);
}

/// Finds the images of later particles that are near enough to a particle.
void find_candidates(
  const PackingPlan& plan, std::int64_t row, double factor, std::vector<Candidate>& found)
{
  const PlacedParticle own = plan.particle(row);
  const auto limit = [&](double radius)
  { return (own.radius + radius) * factor * (1 + 1e-10) + 2 * plan.shape.rounding(); };
  plan.visit_near(row, limit(plan.request.radii.largest()),
    [&](std::int64_t other, const PeriodicImage& image)
    {
      if (other > row && other < plan.particles)
      {
        const PlacedParticle second = plan.particle(other);
        const Vector3 at = moved(second.point, image, plan.shape);
        const double distance =
          length_of({ at[0] - own.point[0], at[1] - own.point[1], at[2] - own.point[2] });
        if (distance <= limit(second.radius))
        {
          found.push_back({ { row, other, image }, distance });
        }
      }
    });
}

/// Adds the bonds of a particle with those after it, each with the nearest image.
void add_pairs(const PackingPlan& plan, std::int64_t row, double factor,
  std::vector<Candidate>& candidates, Pairs& pairs)
{
  candidates.clear();
  find_candidates(plan, row, factor, candidates);
  std::ranges::sort(candidates, comes_before);
  double least = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const Candidate& each = candidates[i];
    if (i == 0 || candidates[i - 1].pair.second != each.pair.second)
    {
      pairs.push_back(each.pair);
      least = each.distance;
    }
    else if (each.distance < least * (1 - 1e-12))
    {
      pairs.back() = each.pair;
      least = each.distance;
    }
  }
}

/// Bonds with memory for all that is to be said of them.
GrainBonds empty_bonds(std::int64_t count)
{
  const auto size = static_cast<std::size_t>(count);
  return { count, Block(size * sizeof(std::int64_t)), Block(size * sizeof(std::int64_t)),
    Block(size * sizeof(std::int32_t)), Block(size * sizeof(double)),
    Block(size * 6 * sizeof(double)) };
}

void set_bond(GrainBonds& bonds, std::size_t bond, const Pair& pair, const PackingPlan& plan)
{
  const Vector3 first = plan.particle(pair.first).point;
  const Vector3 second = plan.particle(pair.second).point;
  const Vector3 image = moved(second, pair.image, plan.shape);
  const Vector3 vector = exact_vector(first, second, pair.image, plan.box);
  static_cast<std::int64_t*>(bonds.id1.data())[bond] = pair.first + 1;
  static_cast<std::int64_t*>(bonds.id2.data())[bond] = pair.second + 1;
  static_cast<std::int32_t*>(bonds.btype.data())[bond] = 1;
  static_cast<double*>(bonds.equilibrium_length.data())[bond] = std::sqrt(dot(vector, vector));
  auto* const ends = static_cast<double*>(bonds.points.data()) + 6 * bond;
  std::ranges::copy(first, ends);
  std::ranges::copy(image, ends + 3);
}
}

GrainBonds make_bonds(const PackingPlan& plan, double factor, Progress& progress)
{
  progress.step(0);
  if (!(factor >= least_factor && factor <= most_factor))
  {
    throw LimitError("expected a bond factor from 1 to 3, got " + std::to_string(factor));
  }
  const auto rows = static_cast<std::size_t>(plan.last - plan.first);
  const Executor executor(plan.request.threads);
  std::vector<Pairs> chunks((rows + rows_a_chunk - 1) / rows_a_chunk);
  PartialProgress part(progress);
  part.set_part(0, 0.8);
  executor.for_each_stretch(
    rows, rows_a_chunk,
    [&](std::size_t first, std::size_t count, std::size_t)
    {
      std::vector<Candidate> candidates;
      Pairs& pairs = chunks[first / rows_a_chunk];
      for (std::size_t i = first; i < first + count; ++i)
      {
        const std::int64_t row = plan.first + static_cast<std::int64_t>(i);
        if (plan.request.arrangement != Arrangement::Chain)
        {
          add_pairs(plan, row, factor, candidates, pairs);
        }
        else if (row + 1 < plan.particles)
        {
          pairs.push_back({ row, row + 1, {} });
        }
      }
    },
    part);
  std::vector<std::size_t> starts = { 0 };
  for (const Pairs& pairs : chunks)
  {
    starts.push_back(starts.back() + pairs.size());
  }
  GrainBonds bonds = empty_bonds(static_cast<std::int64_t>(starts.back()));
  part.set_part(0.8, 1);
  executor.parallel_for(
    chunks.size(),
    [&](std::size_t chunk, std::size_t)
    {
      for (std::size_t i = 0; i < chunks[chunk].size(); ++i)
      {
        set_bond(bonds, starts[chunk] + i, chunks[chunk][i], plan);
      }
    },
    part);
  progress.step(1);
  return bonds;
}
}
