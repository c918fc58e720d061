// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/bonds.h"

#include "granular/common/error.h"
#include "granular/packing/grain_rows.h"
#include "granular/packing/near_grains.h"
#include "granular/packing/packing_plan.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
constexpr double least_factor = 1;
constexpr double most_factor = 3;

/// A grain of the piece and one of NearGrains.
struct Pair
{
  std::uint32_t own;
  std::uint32_t other;
};

using Pairs = std::vector<Pair>;

double distance(const Vector3& a, const Vector3& b)
{
  const Vector3 way = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
  return std::sqrt(dot(way, way));
}

/// The vector from a point to a periodic image, each component rounded once, as lines through faces are made.
Vector3 exact_vector(const Vector3& from, const NearGrains::Grain& to, const Box& box)
{
  Vector3 vector;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    CompensatedSum sum;
    sum.add(to.centre[axis]);
    sum.add(-from[axis]);
    for (std::size_t k = 0; k < 3; ++k)
    {
      sum.add_product(static_cast<double>(to.image[k]), box.vectors[k][axis]);
    }
    vector[axis] = sum.value();
  }
  return vector;
}

/// Grains around those of a piece, with the memory for them.
struct MadeGrains
{
  RowRange rows;
  std::vector<double> points;
  std::vector<double> radius;

  PlacedGrains placed() const { return { rows, points.data(), radius.data() }; }
};

MadeGrains make_grains(const PackingPlan& plan, const RowRange& rows, Progress& progress)
{
  MadeGrains made = { rows, std::vector<double>(static_cast<std::size_t>(3 * rows.count())),
    std::vector<double>(static_cast<std::size_t>(rows.count())) };
  std::vector<std::int32_t> types(made.radius.size());
  plan.place_rows({ rows, made.points.data(), made.radius.data(), types.data() }, progress);
  return made;
}

/// Of images that are equally near the one that was moved the least.
bool comes_before(const NearGrains::Grain& a, const NearGrains::Grain& b)
{
  const auto moves = [](const NearGrains::Grain& grain)
  { return std::abs(grain.image[0]) + std::abs(grain.image[1]) + std::abs(grain.image[2]); };
  return std::tuple(a.row, moves(a), a.image) < std::tuple(b.row, moves(b), b.image);
}

/// Bonds with memory for all that is to be said of them.
GrainBonds empty_bonds(std::int64_t count)
{
  const auto size = static_cast<std::size_t>(count);
  return { count, Block(size * sizeof(std::int64_t)), Block(size * sizeof(std::int64_t)),
    Block(size * sizeof(std::int32_t)), Block(size * sizeof(double)),
    Block(size * 6 * sizeof(double)) };
}

struct End
{
  std::int64_t row;
  Vector3 point;
};

void set_bond(
  GrainBonds& bonds, std::int64_t bond, const End& first, const End& second, double length)
{
  static_cast<std::int64_t*>(bonds.id1.data())[bond] = first.row + 1;
  static_cast<std::int64_t*>(bonds.id2.data())[bond] = second.row + 1;
  static_cast<std::int32_t*>(bonds.btype.data())[bond] = 1;
  static_cast<double*>(bonds.equilibrium_length.data())[bond] = length;
  auto* const ends = static_cast<double*>(bonds.points.data()) + 6 * bond;
  std::copy(first.point.begin(), first.point.end(), ends);
  std::copy(second.point.begin(), second.point.end(), ends + 3);
}

/// Adds the bonds of a grain with those after it. found: memory for those that are near.
void add_pairs(const NearGrains& all, const PlacedGrains& own, std::int64_t i,
  std::vector<std::uint32_t>& found, Pairs& pairs)
{
  const Vector3 point = own.point(i);
  const std::int64_t row = own.rows.first + i;
  found.clear();
  all.visit(point, own.radius[i],
    [&](std::uint32_t number, const NearGrains::Grain& other)
    {
      if (other.row > row &&
        distance(point, all.point(other)) <= all.limit(own.radius[i] + other.radius))
      {
        found.push_back(number);
      }
    });
  std::ranges::sort(
    found, [&](std::uint32_t a, std::uint32_t b) { return comes_before(all[a], all[b]); });
  std::int64_t before = row;
  double length = 0;
  for (const std::uint32_t number : found)
  {
    const NearGrains::Grain& other = all[number];
    const double other_length = distance(point, all.point(other));
    if (other.row != before)
    {
      pairs.push_back({ static_cast<std::uint32_t>(i), number });
      length = other_length;
    }
    else if (other_length < length * (1 - 1e-12))
    {
      pairs.back().other = number;
      length = other_length;
    }
    before = other.row;
  }
}

/// Bonds between near grains; own: not empty.
GrainBonds near_bonds(
  const PackingPlan& plan, const PlacedGrains& own, double factor, PartialProgress& progress)
{
  const int threads = plan.request.threads;
  progress.set_part(0, 0.4);
  std::vector<MadeGrains> made;
  std::vector<PlacedGrains> others;
  const double reach =
    factor * 2 * plan.radii.choice().largest() + 2 * plan.shape.rounding(); // as NearGrains has it
  for (const RowRange& rows : plan.rows_near(own.rows, reach * (1 + 1e-9)))
  {
    made.push_back(make_grains(plan, rows, progress));
    others.push_back(made.back().placed());
  }
  const NearGrains all(plan.shape, factor, own, others);
  made.clear();
  progress.set_part(0.5, 0.9);
  std::vector<Pairs> chunks(chunks_of_rows(own.rows.count()));
  for_row_chunks(own.rows.count(), threads, progress,
    [&](std::int64_t begin, std::int64_t end, std::size_t)
    {
      std::vector<std::uint32_t> found;
      for (std::int64_t i = begin; i < end; ++i)
      {
        add_pairs(all, own, i, found, chunks[static_cast<std::size_t>(begin / rows_a_chunk)]);
      }
    });
  progress.set_part(0.9, 1);
  std::vector<std::int64_t> starts = { 0 };
  for (const Pairs& pairs : chunks)
  {
    starts.push_back(starts.back() + static_cast<std::int64_t>(pairs.size()));
  }
  GrainBonds bonds = empty_bonds(starts.back());
  Executor(threads).parallel_for(
    chunks.size(),
    [&](std::size_t chunk, std::size_t)
    {
      std::int64_t bond = starts[chunk];
      for (const Pair& pair : chunks[chunk])
      {
        const NearGrains::Grain& other = all[pair.other];
        const Vector3 point = own.point(pair.own);
        const Vector3 vector = exact_vector(point, other, plan.box);
        set_bond(bonds, bond++, { own.rows.first + pair.own, point },
          { other.row, all.point(other) }, std::sqrt(dot(vector, vector)));
      }
    },
    progress);
  return bonds;
}

/// Bonds between consecutive grains of each fibre.
GrainBonds fibre_bonds(const PackingPlan& plan, const RowRange& rows, Progress& progress)
{
  const Fibres& fibres = *plan.fibres;
  // of all grains before a row: one each, but for the last ones of fibres
  const auto bonds_before = [&](std::int64_t row)
  { return row - fibres.fibre(row) - (row == plan.grains && fibres.is_inside(row) ? 1 : 0); };
  const std::int64_t first = bonds_before(rows.first);
  GrainBonds bonds = empty_bonds(bonds_before(rows.last) - first);
  for_row_chunks(rows.count(), plan.request.threads, progress,
    [&](std::int64_t begin, std::int64_t end, std::size_t)
    {
      for (std::int64_t row = rows.first + begin; row < rows.first + end; ++row)
      {
        if (row + 1 < plan.grains && fibres.is_inside(row + 1))
        {
          const Vector3 point = fibres.point(row, plan.shape);
          const Vector3 next = fibres.point(row + 1, plan.shape);
          set_bond(bonds, bonds_before(row) - first, { row, point }, { row + 1, next },
            distance(point, next));
        }
      }
    });
  return bonds;
}
}

GrainBonds make_bonds(
  const PackingPlan& plan, const DumpFrame& grains, double factor, Progress& progress)
{
  progress.step(0);
  if (!(factor >= least_factor && factor <= most_factor))
  {
    throw LimitError("expected a bond factor from 1 to 3, got " + std::to_string(factor));
  }
  const PlacedGrains own = { plan.rows(), static_cast<const double*>(grains.points.data()),
    array_of<double>(grains, "radius") };
  PartialProgress part(progress);
  GrainBonds bonds;
  if (plan.fibres)
  {
    bonds = fibre_bonds(plan, own.rows, part);
  }
  else if (own.rows.count() > 0)
  {
    bonds = near_bonds(plan, own, factor, part);
  }
  progress.step(1);
  return bonds;
}
}
