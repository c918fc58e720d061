// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/count_particles.h"

#include "granular/common/error.h"
#include "granular/decomposition/slab_finder.h"
#include "granular/decomposition/subdomain_tree.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/absolute_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t rows_per_chunk = 65536;

/// Each worker has counts of its own, up to 1 GiB of them together: beyond that there are fewer workers.
constexpr std::size_t most_counts = std::size_t{ 1 } << 27;

/// Finds the place of a point in a grid, or the one behind the last: outside.
struct InGrid
{
  InGrid(const std::array<SlabFinder, 3>& finders, const ProcessGrid& grid)
    : slabs(finders)
    , guesses{ finders[0].guess(), finders[1].guess(), finders[2].guess() }
    , py(grid.counts()[1])
    , pz(grid.counts()[2])
    , outside(grid.size())
  {
  }

  std::int64_t operator()(const double* x) const noexcept
  {
    std::int32_t i = guesses[0](x[0]);
    std::int32_t j = guesses[1](x[1]);
    std::int32_t k = guesses[2](x[2]);
    if ((i | j | k) < 0)
    {
      i = slabs[0].search(x[0]);
      j = slabs[1].search(x[1]);
      k = slabs[2].search(x[2]);
      if ((i | j | k) < 0)
      {
        return outside;
      }
    }
    return (i * py + j) * pz + k;
  }

  const std::array<SlabFinder, 3>& slabs;
  const std::array<SlabFinder::Guess, 3> guesses;
  std::int64_t py;
  std::int64_t pz;
  std::int64_t outside;
};

std::array<SlabFinder, 3> slabs_of(const ProcessGrid& grid)
{
  const auto& [x, y, z] = grid.cuts;
  return { SlabFinder(x), SlabFinder(y), SlabFinder(z) };
}

bool is_finite(const double* x) noexcept
{
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

using Entry = SubdomainTree::Entry;
using Node = SubdomainTree::Node;

/// How many axes have lo <= x < hi; -1 where not all have lo <= x <= hi.
int axes_inside(const Entry& entry, const double* x) noexcept
{
  const auto& [lo, hi, number] = entry;
  // & and no &&: one branch that can be foreseen, not six that cannot
  const int closed = int{ lo[0] <= x[0] } & int{ x[0] <= hi[0] } & int{ lo[1] <= x[1] } &
    int{ x[1] <= hi[1] } & int{ lo[2] <= x[2] } & int{ x[2] <= hi[2] };
  return closed != 0 ? int{ x[0] < hi[0] } + int{ x[1] < hi[1] } + int{ x[2] < hi[2] } : -1;
}

/// Finds the number of the subdomain of a point, or the one behind the last. Neighbours in a file are mostly in the
/// same one.
struct InTree
{
  const SubdomainTree& tree;
  std::int64_t outside;
  const Entry* best = nullptr; ///< of the last point
  int most = -1;               ///< its axes inside

  std::int64_t operator()(const double* x) noexcept
  {
    if (!best || axes_inside(*best, x) != 3)
    {
      best = nullptr;
      most = -1;
      if (is_finite(x))
      {
        this->search(x, tree.root());
      }
    }
    return best ? best->number : outside;
  }

  /// Of the closed boxes that have the point, the one with the most axes along which lo <= x < hi; of these
  /// (flat ones among them) the one that begins last along x, then y, then z, then the last.
  void search(const double* x, const Node& node) noexcept
  {
    if (const auto halves = tree.halves(node); !halves.empty())
    {
      const bool second = x[node.axis] >= halves[1].lo[node.axis];
      if (!second || x[node.axis] <= halves[0].hi[node.axis])
      {
        this->search(x, halves[0]);
      }
      if (second && most < 3)
      {
        this->search(x, halves[1]);
      }
    }
    for (const Entry& entry : tree.entries(node))
    {
      const int axes = axes_inside(entry, x);
      if (axes > most ||
        (axes >= 0 && axes == most &&
          std::tie(best->lo, best->number) < std::tie(entry.lo, entry.number)))
      {
        best = &entry;
        most = axes;
      }
    }
  }
};

template <class Find>
void count_rows(const FrameView& frame, const AbsolutePositions& positions, std::int64_t first,
  std::int64_t last, Find find, std::int64_t* counts)
{
  constexpr auto most = static_cast<std::int64_t>(AbsolutePositions::most_rows);
  std::array<double, 3 * AbsolutePositions::most_rows> buffer;
  for (; first < last; first += most)
  {
    const std::int64_t rows = std::min(most, last - first);
    const double* const x = positions.load(first, static_cast<std::size_t>(rows), buffer.data());
    if (!frame.ghosts)
    {
      for (std::int64_t row = 0; row < rows; ++row)
      {
        ++counts[find(x + 3 * row)];
      }
      continue;
    }
    const unsigned char* const ghosts = frame.ghosts + first;
    for (std::int64_t row = 0; row < rows; ++row)
    {
      if ((ghosts[row] & FrameView::duplicate_row) == 0)
      {
        ++counts[find(x + 3 * row)];
      }
    }
  }
}

/// Of each place, and of one more what is outside.
template <class Find>
ParticleCounts count_all(const FrameView& frame, std::size_t places, const Find& find,
  const Executor& executor, Progress& progress)
{
  if (frame.rows > 0 && !frame.points)
  {
    throw Error("expected points to count, got none");
  }
  const AbsolutePositions positions(frame, true);
  const auto chunks = static_cast<std::size_t>((frame.rows + rows_per_chunk - 1) / rows_per_chunk);
  const std::size_t most_workers = std::max<std::size_t>(most_counts / (places + 1), 1);
  const Executor own(
    static_cast<int>(std::min(static_cast<std::size_t>(executor.threads()), most_workers)));
  std::vector<std::vector<std::int64_t>> counts(own.workers(chunks));
  counts[0].resize(places + 1);
  own.parallel_for(
    chunks,
    [&](std::size_t chunk, std::size_t worker)
    {
      counts[worker].resize(places + 1);
      const std::int64_t first = static_cast<std::int64_t>(chunk) * rows_per_chunk;
      count_rows(frame, positions, first, std::min(first + rows_per_chunk, frame.rows), find,
        counts[worker].data());
    },
    progress);
  ParticleCounts sum{ std::move(counts[0]), 0 };
  for (std::size_t worker = 1; worker < counts.size(); ++worker)
  {
    std::ranges::transform( // one that had no chunk has no counts
      counts[worker], sum.particles, sum.particles.begin(), std::plus<>());
  }
  sum.outside = sum.particles.back();
  sum.particles.pop_back();
  return sum;
}

void check_cuts(const ProcessGrid& grid)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& cuts = grid.cuts[axis];
    for (std::size_t i = 0; i < cuts.size(); ++i)
    {
      if (!std::isfinite(cuts[i]) || (i > 0 && cuts[i] < cuts[i - 1]))
      {
        throw Error(std::string("expected finite cuts along ") + "xyz"[axis] +
          ", none below the one before, got " + to_text(cuts[i]) +
          (i > 0 ? " behind " + to_text(cuts[i - 1]) : ""));
      }
    }
  }
}
}

ParticleCounts count_in_grid(
  const FrameView& frame, const ProcessGrid& grid, const Executor& executor, Progress& progress)
{
  check_cuts(grid);
  const std::array<SlabFinder, 3> slabs = slabs_of(grid);
  return count_all(
    frame, static_cast<std::size_t>(grid.size()), InGrid{ slabs, grid }, executor, progress);
}

ParticleCounts count_in_subdomains(const FrameView& frame, std::span<const Subdomain> subdomains,
  const Executor& executor, Progress& progress)
{
  std::vector<std::int64_t> order;
  if (const auto grid = find_process_grid(subdomains, &order))
  {
    ParticleCounts in_grid = count_in_grid(frame, *grid, executor, progress);
    ParticleCounts counts{ std::vector<std::int64_t>(order.size()), in_grid.outside };
    std::ranges::transform(order, counts.particles.begin(),
      [&](std::int64_t place) { return in_grid.particles[static_cast<std::size_t>(place)]; });
    return counts;
  }
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    const auto& [lo, hi, particles, rank] = subdomains[i];
    if (lo[0] <= hi[0] && lo[1] <= hi[1] && lo[2] <= hi[2])
    {
      entries.push_back({ lo, hi, static_cast<std::int64_t>(i) });
    }
  }
  const SubdomainTree tree(std::move(entries), true);
  return count_all(frame, subdomains.size(),
    InTree{ tree, static_cast<std::int64_t>(subdomains.size()) }, executor, progress);
}
}
