// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/subdomains.h"

#include "granular/geometry/compensated.h"
#include "granular/parallel/gather.h"

#include <algorithm>
#include <limits>

namespace granular
{
template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<Decomposition>& decomposition)
{
  archive.number(decomposition.has_particles);
  archive.number(decomposition.has_ranks);
  pass(archive, decomposition.subdomains);
}

Decomposition join(std::span<const Decomposition> parts)
{
  Decomposition all;
  for (const auto& [subdomains, has_particles, has_ranks] : parts)
  {
    const bool is_empty = subdomains.empty(); // nothing is known of arrays where there are no cells
    all.has_particles = all.has_particles && (has_particles || is_empty);
    all.has_ranks = all.has_ranks && (has_ranks || is_empty);
    all.subdomains.insert(all.subdomains.end(), subdomains.begin(), subdomains.end());
  }
  for (std::size_t i = 0; i < all.subdomains.size(); ++i)
  {
    Subdomain& each = all.subdomains[i];
    each.particles = all.has_particles ? each.particles : 0;
    each.rank = all.has_ranks ? each.rank : static_cast<int>(i);
  }
  return all;
}

Decomposition gather_decomposition(const Decomposition& own, Communicator& ranks)
{
  return do_together(ranks, [&] { return join(gather(ranks, own)); });
}

Subdomain bounds_of(std::span<const Subdomain> subdomains) noexcept
{
  Subdomain bounds;
  if (!subdomains.empty())
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    bounds.lo.fill(infinity);
    bounds.hi.fill(-infinity);
  }
  for (const Subdomain& subdomain : subdomains)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // in this order a nan changes nothing
      const double lo = subdomain.lo[axis];
      const double hi = subdomain.hi[axis];
      bounds.lo[axis] = std::min(std::min(bounds.lo[axis], lo), hi);
      bounds.hi[axis] = std::max(std::max(bounds.hi[axis], hi), lo);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (bounds.lo[axis] > bounds.hi[axis]) // nothing but nan
    {
      bounds.lo[axis] = bounds.hi[axis] = 0;
    }
  }
  return bounds;
}

double imbalance_of(std::span<const Subdomain> subdomains, std::int64_t processes) noexcept
{
  std::int64_t largest = 0;
  CompensatedSum total;
  for (const Subdomain& subdomain : subdomains)
  {
    largest = std::max(largest, subdomain.particles);
    total.add(static_cast<double>(subdomain.particles));
  }
  const auto count =
    static_cast<double>(processes > 0 ? processes : static_cast<std::int64_t>(subdomains.size()));
  // the product first: of counts below 2^53 / n it is exact, and the quotient the nearest double
  return largest > 0 ? static_cast<double>(largest) * count / total.value() : 1;
}
}
