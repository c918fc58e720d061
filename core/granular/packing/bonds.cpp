// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/bonds.h"

#include "granular/base/error.h"
#include "granular/base/executor.h"
#include "granular/packing/grain_rows.h"
#include "granular/packing/near_grains.h"
#include "granular/packing/packing_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
constexpr double least_factor = 1;
constexpr double most_factor =
  3; // so that no bond is longer than six radii: see Regions::rows_near

struct Bond
{
  std::int64_t first; ///< row
  std::int64_t second;
  Vector3 end; ///< the second; the first is where the grain is
  double length;
};

using Bonds = std::vector<Bond>;

/// Adds the bonds of some rows with later ones.
using AddBonds = std::function<void(const RowRange& rows, Bonds& bonds)>;

double distance(const Vector3& a, const Vector3& b)
{
  const double x = b[0] - a[0];
  const double y = b[1] - a[1];
  const double z = b[2] - a[2];
  return std::sqrt(x * x + y * y + z * z);
}

/// Grains around those of a piece, with the memory for them.
struct MadeGrains
{
  RowRange rows;
  std::vector<double> points;
  std::vector<double> radius;

  PlacedGrains placed() const { return { rows, points.data(), radius.data() }; }
};

MadeGrains make_grains(
  const PackingPlan& plan, const RowRange& rows, int threads, Progress& progress)
{
  MadeGrains made = { rows, std::vector<double>(static_cast<std::size_t>(3 * rows.count())),
    std::vector<double>(static_cast<std::size_t>(rows.count())) };
  plan.place_rows({ rows, made.points.data(), made.radius.data() }, threads, progress);
  for (std::size_t i = 0; i < made.points.size(); i += 3)
  {
    const Vector3 point =
      plan.shape.point({ made.points[i], made.points[i + 1], made.points[i + 2] });
    std::copy(point.begin(), point.end(), made.points.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return made;
}

/// Of images that are equally near the one that was moved the least.
bool comes_before(const NearGrains::Grain& a, const NearGrains::Grain& b)
{
  const auto moves = [](const NearGrains::Grain& grain)
  { return std::abs(grain.image[0]) + std::abs(grain.image[1]) + std::abs(grain.image[2]); };
  return std::tuple(a.row, moves(a), a.image) < std::tuple(b.row, moves(b), b.image);
}

/// Bonds of a grain with those after it.
void add_near(const NearGrains& all, const NearGrains::Grain& grain, Bonds& bonds,
  std::vector<NearGrains::Grain>& found)
{
  found.clear();
  all.visit(grain.point, grain.radius,
    [&](const NearGrains::Grain& other)
    {
      if (other.row > grain.row &&
        distance(grain.point, other.point) <= all.limit(grain.radius + other.radius))
      {
        found.push_back(other);
      }
    });
  std::sort(found.begin(), found.end(), comes_before);
  std::int64_t before = grain.row;
  for (const NearGrains::Grain& other : found)
  {
    const double length = distance(grain.point, other.point);
    const Bond bond = { grain.row, other.row, other.point, length };
    if (other.row != before)
    {
      bonds.push_back(bond);
    }
    else if (length < bonds.back().length * (1 - 1e-12))
    {
      bonds.back() = bond;
    }
    before = other.row;
  }
}

/// All bonds of some rows, in chunks.
std::vector<Bonds> find_bonds(
  const RowRange& rows, const AddBonds& add, int threads, Progress& progress)
{
  std::vector<Bonds> chunks(
    static_cast<std::size_t>((rows.count() + rows_a_chunk - 1) / rows_a_chunk));
  for_row_chunks(rows.count(), threads, progress,
    [&](std::int64_t begin, std::int64_t end, std::size_t)
    {
      add({ rows.first + begin, rows.first + end },
        chunks[static_cast<std::size_t>(begin / rows_a_chunk)]);
    });
  return chunks;
}

/// The bonds of all chunks one after the other; the memory of each is given back on the way.
GrainBonds join(
  std::vector<Bonds>& chunks, const PlacedGrains& own, int threads, Progress& progress)
{
  std::vector<std::size_t> starts = { 0 };
  for (const Bonds& bonds : chunks)
  {
    starts.push_back(starts.back() + bonds.size());
  }
  const std::size_t count = starts.back();
  GrainBonds all;
  all.count = static_cast<std::int64_t>(count);
  const auto make = [count](Block& block, auto value, std::size_t size)
  {
    block = Block(count * size * sizeof(value));
    return static_cast<decltype(value)*>(block.data());
  };
  auto* const id1 = make(all.id1, std::int64_t{}, 1);
  auto* const id2 = make(all.id2, std::int64_t{}, 1);
  auto* const btype = make(all.btype, std::int32_t{}, 1);
  auto* const length = make(all.equilibrium_length, double{}, 1);
  auto* const points = make(all.points, double{}, 6);
  Executor(threads).parallel_for(
    chunks.size(),
    [&](std::size_t chunk, std::size_t)
    {
      const Bonds bonds = std::move(chunks[chunk]);
      for (std::size_t i = 0; i < bonds.size(); ++i)
      {
        const std::size_t to = starts[chunk] + i;
        id1[to] = bonds[i].first + 1;
        id2[to] = bonds[i].second + 1;
        btype[to] = 1;
        length[to] = bonds[i].length;
        std::copy_n(own.points + 3 * (bonds[i].first - own.rows.first), 3, points + 6 * to);
        std::copy_n(bonds[i].end.data(), 3, points + 6 * to + 3);
      }
    },
    progress);
  return all;
}

AddBonds along_fibres(const PackingPlan& plan)
{
  return [&plan](const RowRange& rows, Bonds& bonds)
  {
    for (std::int64_t row = rows.first; row < std::min(rows.last, plan.grains - 1); ++row)
    {
      if (plan.fibres->fibre(row + 1) == plan.fibres->fibre(row))
      {
        const Vector3 from = plan.shape.point(plan.fibres->scaled(row));
        const Vector3 to = plan.shape.point(plan.fibres->scaled(row + 1));
        bonds.push_back({ row, row + 1, to, distance(from, to) });
      }
    }
  };
}

/// own: not empty.
std::vector<Bonds> find_near(const PackingPlan& plan, const PlacedGrains& own, double factor,
  int threads, PartialProgress& progress)
{
  progress.set_part(0, 0.4);
  std::vector<MadeGrains> made;
  const double reach = factor * 2 * plan.radii.choice().largest();
  for (const RowRange& rows : plan.rows_near(own.rows, reach * (1 + 1e-9)))
  {
    made.push_back(make_grains(plan, rows, threads, progress));
  }
  std::vector<PlacedGrains> others;
  std::transform(made.begin(), made.end(), std::back_inserter(others),
    [](const MadeGrains& grains) { return grains.placed(); });
  const NearGrains all(plan.shape, factor, own, others);
  made.clear();
  progress.set_part(0.5, 0.9);
  return find_bonds(
    own.rows,
    [&](const RowRange& rows, Bonds& bonds)
    {
      std::vector<NearGrains::Grain> found;
      for (std::int64_t row = rows.first; row < rows.last; ++row)
      {
        const std::int64_t i = row - own.rows.first;
        const double* const at = own.points + 3 * i;
        add_near(all, { { at[0], at[1], at[2] }, own.radius[i], row, {} }, bonds, found);
      }
    },
    threads, progress);
}
}

GrainBonds make_bonds(
  const PackingRequest& request, const DumpFrame& grains, double factor, Progress& progress)
{
  progress.step(0);
  if (!(factor >= least_factor && factor <= most_factor))
  {
    throw LimitError("expected a bond factor from 1 to 3, got " + std::to_string(factor));
  }
  const PackingPlan plan(request);
  const PlacedGrains own = { plan.rows_of_piece(request.piece, request.pieces),
    static_cast<const double*>(grains.points.data()), array_of<double>(grains, "radius") };
  PartialProgress part(progress);
  std::vector<Bonds> chunks;
  if (plan.fibres)
  {
    part.set_part(0, 0.9);
    chunks = find_bonds(own.rows, along_fibres(plan), request.threads, part);
  }
  else if (own.rows.count() > 0)
  {
    chunks = find_near(plan, own, factor, request.threads, part);
  }
  part.set_part(0.9, 1);
  GrainBonds bonds = join(chunks, own, request.threads, part);
  progress.step(1);
  return bonds;
}
}
