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

bool is_finite(const double* x) noexcept
{
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

/// Finds the number of the subdomain of a point, or the one behind the last. Neighbours in a file are mostly in the
/// same one.
struct InTree
{
  const SubdomainTree& tree;
  std::int64_t outside;
  const SubdomainTree::Box* last = nullptr;

  std::int64_t operator()(const double* x) noexcept
  {
    if (!last || last->inside(x) != 3)
    {
      last = is_finite(x) ? tree.find(x) : nullptr;
    }
    return last ? last->number : outside;
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
  const std::array<SlabFinder, 3> slabs = { SlabFinder(grid.cuts[0]), SlabFinder(grid.cuts[1]),
    SlabFinder(grid.cuts[2]) };
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
  const SubdomainTree tree(subdomains);
  return count_all(frame, subdomains.size(),
    InTree{ tree, static_cast<std::int64_t>(subdomains.size()) }, executor, progress);
}
}
