// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/process_grid.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace granular
{
namespace
{
struct Slab
{
  double lo;
  double hi;

  auto operator<=>(const Slab&) const = default;
};

/// The slabs of one axis that subdomains lie in, each once.
class Slabs
{
public:
  std::size_t size() const noexcept { return slabs_.size(); }

  /// Its number, in the order in which they come.
  std::size_t number(const Slab& slab)
  {
    if (slabs_.empty() || last_->first != slab)
    {
      last_ = slabs_.try_emplace(slab, slabs_.size()).first;
    }
    return last_->second;
  }

  /// The cuts between them, or nothing where one does not begin where the one before ends; places gets which in
  /// order of position each number is.
  std::vector<double> cuts(std::vector<std::int64_t>& places) const
  {
    places.resize(slabs_.size());
    std::vector<double> cuts = { slabs_.begin()->first.lo };
    for (const auto& [slab, number] : slabs_)
    {
      if (slab.lo != cuts.back())
      {
        return {};
      }
      places[number] = static_cast<std::int64_t>(cuts.size()) - 1;
      cuts.push_back(slab.hi);
    }
    return cuts;
  }

private:
  std::map<Slab, std::size_t> slabs_; ///< their numbers
  std::map<Slab, std::size_t>::const_iterator last_;
};

/// The slabs of a subdomain along each axis, by number: there are fewer than subdomains.
using SlabNumbers = std::array<std::uint32_t, 3>;

/// Returns the slabs of each subdomain; nothing where there are more slabs than a grid of so many has.
std::vector<SlabNumbers> find_slabs(
  std::span<const Subdomain> subdomains, std::array<Slabs, 3>& slabs)
{
  std::vector<SlabNumbers> found;
  found.reserve(subdomains.size());
  for (const Subdomain& subdomain : subdomains)
  {
    auto& numbers = found.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Slab slab = { subdomain.lo[axis], subdomain.hi[axis] };
      if (!(slab.lo <= slab.hi) || !std::isfinite(slab.lo) || !std::isfinite(slab.hi))
      {
        return {};
      }
      numbers[axis] = static_cast<std::uint32_t>(slabs[axis].number(slab));
    }
    if (slabs[0].size() * slabs[1].size() * slabs[2].size() > subdomains.size())
    {
      return {};
    }
  }
  return found;
}
}

std::optional<ProcessGrid> find_process_grid(
  std::span<const Subdomain> subdomains, std::vector<std::int64_t>* order)
{
  std::array<Slabs, 3> slabs;
  const auto found = find_slabs(subdomains, slabs);
  if (found.empty() || slabs[0].size() * slabs[1].size() * slabs[2].size() != subdomains.size())
  {
    return std::nullopt;
  }
  ProcessGrid grid;
  std::array<std::vector<std::int64_t>, 3> places;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grid.cuts[axis] = slabs[axis].cuts(places[axis]);
    if (grid.cuts[axis].empty())
    {
      return std::nullopt;
    }
  }
  const std::int64_t py = grid.counts()[1];
  const std::int64_t pz = grid.counts()[2];
  if (order)
  {
    order->clear();
  }
  std::vector<bool> is_taken(subdomains.size());
  for (const auto& [x, y, z] : found)
  {
    const std::int64_t place = (places[0][x] * py + places[1][y]) * pz + places[2][z];
    if (is_taken[static_cast<std::size_t>(place)])
    {
      return std::nullopt;
    }
    is_taken[static_cast<std::size_t>(place)] = true;
    if (order)
    {
      order->push_back(place);
    }
  }
  return grid;
}
}
