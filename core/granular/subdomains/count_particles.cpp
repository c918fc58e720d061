// SPDX-License-Identifier: BSD-3-Clause
#include "granular/subdomains/count_particles.h"

#include "granular/common/error.h"
#include "granular/grid/subdomain_tree.h"
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
constexpr std::size_t rows_per_chunk = 65536;
constexpr std::size_t bins_per_slab = 8;

/// Each worker has counts of its own, up to 1 GiB of them together: beyond that there are fewer workers.
constexpr std::size_t most_counts = std::size_t{ 1 } << 27;

/// Finds the slab between cuts that holds a coordinate: lo <= x < hi, in the last one x <= hi, and where cuts coincide the
/// last that begins there. Only comparisons with cuts decide; bins tell with which. The bin of a coordinate never falls as x
/// grows, in any rounding, so all cuts in lower bins are below x, and all in higher ones above.
class Slabs
{
public:
  /// Throws Error.
  Slabs(const std::vector<double>& cuts, char axis)
  {
    if (!std::ranges::all_of(cuts, [](double cut) { return std::isfinite(cut); }) ||
      !std::ranges::is_sorted(cuts))
    {
      throw Error(
        std::string("expected finite cuts along ") + axis + ", none below the one before");
    }
    if (cuts.size() < 2)
    {
      return;
    }
    lo_ = cuts.front();
    hi_ = cuts.back();
    inner_ = std::span(cuts).subspan(1, cuts.size() - 2);
    bins_.resize(bins_per_slab * (cuts.size() - 1) + 1);
    const double scale = static_cast<double>(bins_.size() - 1) / (hi_ - lo_);
    if (std::isnormal(scale)) // else the length is 0, or too small or too large to divide by
    {
      origin_ = lo_;
      scale_ = scale;
    }
    std::vector<std::int64_t> counts(bins_.size());
    for (const double cut : inner_)
    {
      bins_[this->bin_of(cut)].cut = cut;
      ++counts[this->bin_of(cut)];
    }
    std::int64_t below = 0;
    for (std::size_t bin = 0; bin < bins_.size(); below += counts[bin++])
    {
      bins_[bin].slab = counts[bin] > 1 ? -1 : below;
    }
  }

  /// Returns the number of the slab, or -1 if none holds the coordinate.
  std::int64_t find(double x) const noexcept
  {
    if (!(lo_ <= x && x <= hi_))
    {
      return -1;
    }
    const Bin& bin = bins_[this->bin_of(x)];
    return bin.slab < 0 ? std::ranges::upper_bound(inner_, x) - inner_.begin()
                        : bin.slab + std::int64_t{ x >= bin.cut };
  }

private:
  struct Bin
  {
    double cut = HUGE_VAL; ///< the only one in the bin
    std::int64_t slab = 0; ///< below it; -1: there are several
  };

  std::size_t bin_of(double x) const noexcept
  {
    return static_cast<std::size_t>(static_cast<std::int64_t>((x - origin_) * scale_));
  }

  double lo_ = HUGE_VAL;
  double hi_ = -HUGE_VAL;
  double origin_ = 0;
  double scale_ = 0;              ///< bins a unit of length
  std::span<const double> inner_; ///< the cuts between the first and the last
  std::vector<Bin> bins_;
};

/// Finds the place of a point in a grid, or the one behind the last: outside.
struct InGrid
{
  std::int64_t operator()(const double* x) const noexcept
  {
    const std::int64_t i = slabs[0].find(x[0]);
    const std::int64_t j = slabs[1].find(x[1]);
    const std::int64_t k = slabs[2].find(x[2]);
    return (i | j | k) < 0 ? outside : (i * py + j) * pz + k;
  }

  const std::array<Slabs, 3>& slabs;
  std::int64_t py;
  std::int64_t pz;
  std::int64_t outside;
};

bool is_finite(const double* x) noexcept
{
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

using Node = SubdomainTree::Node;

/// Returns how many axes have lo <= x < hi; -1 where not all have lo <= x <= hi.
int axes_inside(const Node& box, const double* x) noexcept
{
  const auto& [lo, hi, number, behind] = box;
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
  const Node* best = nullptr; ///< of the last point

  /// Returns, of the closed boxes that have the point, the one with the most axes along which lo <= x < hi; of these
  /// (flat ones among them) the one that begins last along x, then y, then z, then the last.
  std::int64_t operator()(const double* x) noexcept
  {
    if (best && axes_inside(*best, x) == 3)
    {
      return best->number;
    }
    best = nullptr;
    int most = -1;
    if (is_finite(x))
    {
      tree.search([x](const Node& node) { return axes_inside(node, x) >= 0; },
        [&](const Node& leaf)
        {
          const int axes = axes_inside(leaf, x);
          if (axes > most ||
            (axes == most && std::tie(best->lo, best->number) < std::tie(leaf.lo, leaf.number)))
          {
            best = &leaf;
            most = axes;
          }
          return most == 3;
        });
    }
    return best ? best->number : outside;
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
    for (std::int64_t row = 0; row < rows; ++row)
    {
      if (!frame.is_duplicate(first + row))
      {
        ++counts[find(x + 3 * row)];
      }
    }
  }
}

/// Counts the particles of each place and, in one more, those outside.
template <class Find>
ParticleCounts count_all(const FrameView& frame, std::size_t places, const Find& find,
  const Executor& executor, Progress& progress)
{
  if (frame.rows > 0 && !frame.points)
  {
    throw Error("expected points to count, got none");
  }
  const AbsolutePositions positions(frame, true);
  const std::size_t most_workers = std::max<std::size_t>(most_counts / (places + 1), 1);
  const Executor own(
    static_cast<int>(std::min(static_cast<std::size_t>(executor.threads()), most_workers)));
  std::vector<std::vector<std::int64_t>> counts(static_cast<std::size_t>(own.threads()));
  counts[0].resize(places + 1);
  own.for_each_stretch(
    static_cast<std::size_t>(frame.rows), rows_per_chunk,
    [&](std::size_t first, std::size_t count, std::size_t worker)
    {
      counts[worker].resize(places + 1);
      count_rows(frame, positions, static_cast<std::int64_t>(first),
        static_cast<std::int64_t>(first + count), find, counts[worker].data());
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
}

ParticleCounts count_in_grid(
  const FrameView& frame, const ProcessGrid& grid, const Executor& executor, Progress& progress)
{
  const auto& [x, y, z] = grid.cuts;
  const auto [px, py, pz] = grid.counts();
  const std::array<Slabs, 3> slabs = { Slabs(x, 'x'), Slabs(y, 'y'), Slabs(z, 'z') };
  return count_all(frame, static_cast<std::size_t>(grid.size()),
    InGrid{ slabs, py, pz, px * py * pz }, executor, progress);
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
  std::vector<Node> leaves;
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    const auto& [lo, hi, particles, rank] = subdomains[i];
    if (lo[0] <= hi[0] && lo[1] <= hi[1] && lo[2] <= hi[2])
    {
      leaves.push_back({ lo, hi, static_cast<std::int64_t>(i), 0 });
    }
  }
  const SubdomainTree tree(std::move(leaves));
  return count_all(frame, subdomains.size(),
    InTree{ tree, static_cast<std::int64_t>(subdomains.size()) }, executor, progress);
}
}
