// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing.h"

#include "granular/common/error.h"
#include "granular/packing/packing_plan.h"
#include "granular/packing/random_numbers.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace granular
{
namespace
{
constexpr std::size_t rows_a_chunk = 8192;
constexpr double least_factor = 1;
constexpr double most_factor = 3;

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

/// The frame, with memory for the rows.
Table empty_frame(const PackingPlan& plan)
{
  std::vector<std::string> columns = { "id", "type", "x", "y", "z", "radius", "vx", "vy", "vz" };
  if (plan.request.arrangement == Arrangement::Chain)
  {
    columns.insert(columns.begin() + 2, "mol");
  }
  Table frame;
  frame.rows = plan.last - plan.first;
  frame.header.rows = plan.particles;
  frame.header.box = plan.box;
  frame.schema = ColumnSchema(columns);
  const auto count = static_cast<std::size_t>(frame.rows);
  frame.points = Block(count * 3 * sizeof(double));
  for (const ArrayInfo& info : frame.schema.arrays())
  {
    if (!info.position_form)
    {
      const std::size_t bytes =
        size_of(info.type) * static_cast<std::size_t>(info.components()) * count;
      frame.arrays.push_back({ info, Block(bytes), {}, {} });
    }
  }
  return frame;
}

/// The values of an array of the frame; null if it has none.
template <typename T>
T* array_of(const Table& frame, std::string_view name)
{
  const auto found = std::ranges::find(
    frame.arrays, name, [](const TableArray& array) { return std::string_view(array.info.name); });
  return found == frame.arrays.end() ? nullptr : static_cast<T*>(found->block.data());
}
}

Table make_packing(const PackingRequest& request, Progress& progress)
{
  PartialProgress part(progress);
  progress.step(0);
  part.set_part(0, 0.8);
  const PackingPlan plan(request, part);
  part.set_part(0.8, 1);
  return make_packing(plan, part);
}

Table make_packing(const PackingPlan& plan, Progress& progress)
{
  progress.step(0);
  Table frame = empty_frame(plan);
  const PackingRequest& request = plan.request;
  auto* const points = static_cast<double*>(frame.points.data());
  auto* const radii = array_of<double>(frame, "radius");
  auto* const types = array_of<std::int32_t>(frame, "type");
  auto* const ids = array_of<std::int64_t>(frame, "id");
  auto* const molecules = array_of<std::int64_t>(frame, "mol");
  auto* const velocities = array_of<double>(frame, "v");
  std::vector<FrameRanges> ranges(static_cast<std::size_t>(request.threads), FrameRanges(frame));
  Executor(request.threads)
    .for_each_stretch(
      static_cast<std::size_t>(frame.rows), rows_a_chunk,
      [&](std::size_t first, std::size_t count, std::size_t worker)
      {
        for (std::size_t i = first; i < first + count; ++i)
        {
          const std::int64_t row = plan.first + static_cast<std::int64_t>(i);
          const PlacedParticle particle = plan.particle(row);
          RandomNumbers numbers(request.seed, Stream::Velocities, row);
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            points[3 * i + axis] = particle.point[axis];
            velocities[3 * i + axis] = request.speed > 0 ? request.speed * numbers.normal() : 0;
          }
          radii[i] = particle.radius;
          types[i] = particle.type;
          ids[i] = row + 1;
          if (molecules)
          {
            molecules[i] = 1;
          }
        }
        if (request.ranges)
        {
          ranges[worker].add(frame, static_cast<std::int64_t>(first), count);
        }
      },
      progress);
  for (std::size_t worker = 1; worker < ranges.size(); ++worker)
  {
    ranges[0].add(ranges[worker]);
  }
  ranges[0].store(frame);
  progress.step(1);
  return frame;
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
