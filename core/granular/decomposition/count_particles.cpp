// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/count_particles.h"

#include "granular/base/error.h"
#include "granular/decomposition/slab_finder.h"
#include "granular/decomposition/subdomain_tree.h"
#include "granular/dump/absolute_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t rows_per_chunk = 65536;

/// Each worker has counts of its own, up to 1 GiB of them together: beyond that there are fewer workers.
constexpr std::size_t most_counts = std::size_t{ 1 } << 27;

/// Finds the place of a point in a grid, or -1.
struct InGrid
{
  const std::array<SlabFinder, 3>& slabs;
  std::int64_t px;
  std::int64_t py;

  std::int64_t operator()(const double* x) const noexcept
  {
    std::int32_t i = slabs[0].guess(x[0]);
    std::int32_t j = slabs[1].guess(x[1]);
    std::int32_t k = slabs[2].guess(x[2]);
    if ((i | j | k) < 0)
    {
      i = slabs[0].search(x[0]);
      j = slabs[1].search(x[1]);
      k = slabs[2].search(x[2]);
      if ((i | j | k) < 0)
      {
        return -1;
      }
    }
    return i + px * (j + py * k);
  }
};

bool is_finite(const double* x) noexcept
{
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

/// Finds the number of the subdomain of a point, or -1. Neighbours in a file are mostly in the same one.
struct InTree
{
  const SubdomainTree& tree;
  const SubdomainTree::Box* last = nullptr;

  std::int64_t operator()(const double* x) noexcept
  {
    if (!last || last->inside(x) != 3)
    {
      last = is_finite(x) ? tree.find(x) : nullptr;
    }
    return last ? last->number : -1;
  }
};

template <class Find>
void count_rows(const FrameView& frame, const AbsolutePositions& positions, std::int64_t first,
  std::int64_t last, Find find, ParticleCounts& counts)
{
  constexpr auto most = static_cast<std::int64_t>(AbsolutePositions::most_rows);
  std::array<double, 3 * AbsolutePositions::most_rows> buffer;
  std::int64_t* const particles = counts.particles.data();
  const unsigned char* const ghosts = frame.ghosts;
  std::int64_t outside = 0;
  for (; first < last; first += most)
  {
    const std::int64_t count = std::min(most, last - first);
    const double* x = positions.load(first, static_cast<std::size_t>(count), buffer.data());
    for (std::int64_t row = first; row < first + count; ++row, x += 3)
    {
      if (ghosts && (ghosts[row] & FrameView::duplicate_row) != 0)
      {
        continue;
      }
      const std::int64_t place = find(x);
      if (place >= 0)
      {
        ++particles[place];
      }
      else
      {
        ++outside;
      }
    }
  }
  counts.outside += outside;
}

template <class Find>
ParticleCounts count_rows(const FrameView& frame, std::size_t places, const Find& find,
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
  std::vector<ParticleCounts> counts(own.workers(chunks));
  counts[0].particles.resize(places);
  own.parallel_for(
    chunks,
    [&](std::size_t chunk, std::size_t worker)
    {
      counts[worker].particles.resize(places);
      const std::int64_t first = static_cast<std::int64_t>(chunk) * rows_per_chunk;
      count_rows(frame, positions, first, std::min(first + rows_per_chunk, frame.rows), find,
        counts[worker]);
    },
    progress);
  for (std::size_t worker = 1; worker < counts.size(); ++worker)
  {
    const std::vector<std::int64_t>& particles = counts[worker].particles; // none without a chunk
    std::transform(particles.begin(), particles.end(), counts[0].particles.begin(),
      counts[0].particles.begin(), std::plus<>());
    counts[0].outside += counts[worker].outside;
  }
  return std::move(counts[0]);
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
          ", none below the one before, got " + std::to_string(cuts[i]) + " as number " +
          std::to_string(i));
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
  const auto [px, py, pz] = grid.counts();
  return count_rows(
    frame, static_cast<std::size_t>(grid.size()), InGrid{ slabs, px, py }, executor, progress);
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
  return count_rows(frame, subdomains.size(), InTree{ tree }, executor, progress);
}
}
