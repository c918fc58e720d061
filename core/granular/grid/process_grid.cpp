// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/process_grid.h"

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace granular
{
namespace
{
using Counts = std::array<std::int64_t, 3>;

constexpr std::int64_t most_ranks = 2147483647; ///< ranks are int

std::string axis_name(std::size_t axis)
{
  return std::string(1, "xyz"[axis]);
}

std::string print(const Counts& grid)
{
  return std::to_string(grid[0]) + " x " + std::to_string(grid[1]) + " x " +
    std::to_string(grid[2]);
}

void check_box(const Vector3& lo, const Vector3& hi)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!(lo[axis] <= hi[axis]) || !std::isfinite(hi[axis] - lo[axis]))
    {
      throw Error("expected finite bounds along " + axis_name(axis) +
        ", the upper one not below the lower one, got " + to_text(lo[axis]) + " and " +
        to_text(hi[axis]));
    }
  }
}

/// As many as the user says or the cuts make; 0 where nobody does.
Counts told_counts(const GridRequest& request)
{
  Counts grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t told = request.grid[axis];
    const auto cuts = static_cast<std::int64_t>(request.cuts[axis].size());
    if (told < 0)
    {
      throw Error("expected a number of processes along " + axis_name(axis) +
        ", or 0 to have it chosen, got " + std::to_string(told));
    }
    if (told > 0 && cuts > 0 && cuts != told - 1)
    {
      throw Error("expected " + std::to_string(told - 1) + " cuts along " + axis_name(axis) +
        " for " + std::to_string(told) +
        " processes, or 0 processes, which follow from the cuts, got " + std::to_string(cuts));
    }
    grid[axis] = cuts > 0 ? cuts + 1 : told;
  }
  return grid;
}

/// The product of those that are not 0.
std::int64_t product_of(const Counts& grid)
{
  std::int64_t product = 1;
  for (const std::int64_t count : grid)
  {
    product *= std::max<std::int64_t>(count, 1);
    if (product > most_ranks)
    {
      throw LimitError("expected fewer than 2^31 processes, got a grid of " + print(grid));
    }
  }
  return product;
}

std::vector<std::int64_t> divisors_of(std::int64_t number)
{
  std::vector<std::int64_t> divisors;
  for (std::int64_t i = 1; i * i <= number; ++i)
  {
    if (number % i == 0)
    {
      divisors.push_back(i);
      if (i * i != number)
      {
        divisors.push_back(number / i);
      }
    }
  }
  std::ranges::sort(divisors);
  return divisors;
}

/// All grids of so many processes, x counted up, then y.
std::vector<Counts> grids_of(std::int64_t processes)
{
  const std::vector<std::int64_t> divisors = divisors_of(processes);
  std::vector<Counts> grids;
  for (const std::int64_t i : divisors)
  {
    for (const std::int64_t j : divisors)
    {
      if (processes / i % j == 0)
      {
        grids.push_back({ i, j, processes / i / j });
      }
    }
  }
  return grids;
}

/// Takes out those that are not as told, the last taking the place of each: where areas are equal the order counts,
/// and this is how LAMMPS and LIGGGHTS come by theirs.
void keep_told(std::vector<Counts>& grids, const Counts& told)
{
  const auto fits = [&told](const Counts& grid)
  {
    return std::ranges::equal(told, grid,
      [](std::int64_t wanted, std::int64_t count) { return wanted == 0 || wanted == count; });
  };
  for (std::size_t i = 0; i < grids.size();)
  {
    if (fits(grids[i]))
    {
      ++i;
      continue;
    }
    grids[i] = grids.back();
    grids.pop_back();
  }
}

/// The first with the least area. Each face is divided by one number after the other, as both programs do: sums
/// that differ by rounding alone differ in the same way.
Counts choose(const Vector3& lengths, const Counts& told, std::int64_t processes)
{
  std::vector<Counts> grids = grids_of(processes);
  keep_told(grids, told);
  const auto area_of = [&](const Counts& grid)
  {
    const auto& [x, y, z] = lengths;
    const auto px = static_cast<double>(grid[0]);
    const auto py = static_cast<double>(grid[1]);
    const auto pz = static_cast<double>(grid[2]);
    return x * y / px / py + x * z / px / pz + y * z / py / pz;
  };
  return *std::ranges::min_element(grids, {}, area_of);
}

Counts counts_of(const GridRequest& request)
{
  const std::int64_t processes = request.processes;
  if (processes < 0)
  {
    throw Error("expected a number of processes, or 0 for as many as the grid has, got " +
      std::to_string(processes));
  }
  if (processes > most_ranks)
  {
    throw LimitError("expected fewer than 2^31 processes, got " + std::to_string(processes));
  }
  const Counts told = told_counts(request);
  const std::int64_t product = product_of(told);
  const bool open = std::ranges::count(told, 0) > 0;
  if (open && processes == 0)
  {
    throw Error(
      "expected how many processes there are, to choose a grid " + print(told) + " for, got 0");
  }
  if (open ? processes % product != 0 : processes != 0 && processes != product)
  {
    throw Error("expected a number of processes that a grid of " + print(told) +
      (open ? " (0: chosen)" : "") + " can have, got " + std::to_string(processes));
  }
  if (!open)
  {
    return told;
  }
  const Vector3 lengths = { request.hi[0] - request.lo[0], request.hi[1] - request.lo[1],
    request.hi[2] - request.lo[2] };
  return choose(lengths, told, processes);
}

std::vector<double> even_cuts(double lo, double hi, std::int64_t count)
{
  std::vector<double> cuts(static_cast<std::size_t>(count) + 1, lo);
  const double length = hi - lo;
  for (std::int64_t i = 1; i < count; ++i)
  {
    // the quotient first, as LIGGGHTS does: the same bits as its subdomains
    const double part = static_cast<double>(i) / static_cast<double>(count);
    cuts[static_cast<std::size_t>(i)] = std::min(lo + length * part, hi);
  }
  cuts.back() = hi;
  return cuts;
}

std::vector<double> told_cuts(
  double lo, double hi, const std::vector<double>& inner, std::size_t axis)
{
  std::vector<double> cuts = { lo };
  for (const double cut : inner)
  {
    if (!(cut > cuts.back() && cut < hi))
    {
      throw Error("expected increasing cuts along " + axis_name(axis) + " between " + to_text(lo) +
        " and " + to_text(hi) + ", got " + to_text(cut) +
        (cuts.size() > 1 ? " behind " + to_text(cuts.back()) : ""));
    }
    cuts.push_back(cut);
  }
  cuts.push_back(hi);
  return cuts;
}
}

std::array<std::int64_t, 3> ProcessGrid::counts() const noexcept
{
  Counts counts;
  std::ranges::transform(cuts, counts.begin(),
    [](const auto& of_axis)
    { return std::max<std::int64_t>(static_cast<std::int64_t>(of_axis.size()) - 1, 0); });
  return counts;
}

std::int64_t ProcessGrid::size() const noexcept
{
  const auto [x, y, z] = this->counts();
  return x * y * z;
}

std::vector<Subdomain> ProcessGrid::subdomains(std::int64_t first, std::int64_t last) const
{
  const Counts grid = this->counts();
  std::vector<Subdomain> subdomains(static_cast<std::size_t>(std::max(first, last) - first));
  for (std::int64_t number = first; number < last; ++number)
  {
    Subdomain& subdomain = subdomains[static_cast<std::size_t>(number - first)];
    subdomain.rank = static_cast<int>(number);
    std::int64_t rest = number;
    for (const std::size_t axis : { 2u, 1u, 0u })
    {
      const auto slab = static_cast<std::size_t>(rest % grid[axis]);
      subdomain.lo[axis] = cuts[axis][slab];
      subdomain.hi[axis] = cuts[axis][slab + 1];
      rest /= grid[axis];
    }
  }
  return subdomains;
}

ProcessGrid make_process_grid(const GridRequest& request)
{
  check_box(request.lo, request.hi);
  const Counts counts = counts_of(request);
  ProcessGrid grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double lo = request.lo[axis];
    const double hi = request.hi[axis];
    grid.cuts[axis] = request.cuts[axis].empty() ? even_cuts(lo, hi, counts[axis])
                                                 : told_cuts(lo, hi, request.cuts[axis], axis);
  }
  return grid;
}

std::optional<ProcessGrid> find_process_grid(
  std::span<const Subdomain> subdomains, std::vector<std::int64_t>* order)
{
  using Slabs = std::map<std::pair<double, double>, std::int64_t>; // by their bounds; their places
  std::array<Slabs, 3> slabs;
  std::array<Slabs::iterator, 3> last = { slabs[0].end(), slabs[1].end(), slabs[2].end() };
  std::vector<std::array<const std::int64_t*, 3>> found; // the places of each subdomain
  found.reserve(subdomains.size());
  for (const auto& [lo, hi, particles, rank] : subdomains)
  {
    auto& places = found.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!(lo[axis] <= hi[axis]) || !std::isfinite(lo[axis]) || !std::isfinite(hi[axis]))
      {
        return std::nullopt;
      }
      const std::pair bounds(lo[axis], hi[axis]);
      if (last[axis] == slabs[axis].end() || last[axis]->first != bounds)
      {
        last[axis] = slabs[axis].try_emplace(bounds).first;
      }
      places[axis] = &last[axis]->second;
    }
    if (slabs[0].size() * slabs[1].size() * slabs[2].size() > subdomains.size())
    {
      return std::nullopt;
    }
  }
  ProcessGrid grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::vector<double>& cuts = grid.cuts[axis];
    for (auto& [bounds, place] : slabs[axis])
    {
      if (cuts.empty())
      {
        cuts.push_back(bounds.first);
      }
      if (bounds.first != cuts.back())
      {
        return std::nullopt;
      }
      place = std::ssize(cuts) - 1;
      cuts.push_back(bounds.second);
    }
  }
  const auto [px, py, pz] = grid.counts();
  std::vector<std::int64_t> all;
  all.reserve(found.size());
  std::vector<bool> is_taken(found.size());
  for (const auto& [x, y, z] : found)
  {
    all.push_back((*x * py + *y) * pz + *z);
    if (is_taken[static_cast<std::size_t>(all.back())])
    {
      return std::nullopt;
    }
    is_taken[static_cast<std::size_t>(all.back())] = true;
  }
  if (order)
  {
    *order = std::move(all);
  }
  return subdomains.empty() ? std::nullopt : std::optional(grid);
}
}
