// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/subdomains.h"

#include "granular/geometry/compensated.h"
#include "granular/parallel/gather.h"

#include <algorithm>
#include <limits>
#include <string>

namespace granular
{
namespace
{
void expect_size(const char* name, std::size_t got, std::size_t expected)
{
  if (got != expected)
  {
    throw Error("expected " + std::to_string(expected) + " values in " + name + ", got " +
      std::to_string(got));
  }
}
}

template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<Decomposition>& decomposition)
{
  archive.number(decomposition.has_particles);
  archive.number(decomposition.has_ranks);
  pass(archive, decomposition.subdomains);
}

GatheredBounds gather_bounds(const Subdomain& own, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      const auto processes = static_cast<std::size_t>(ranks.size());
      const bool is_first = ranks.rank() == 0;
      std::vector<std::int64_t> to_first(processes);
      to_first[0] = sizeof(Subdomain);
      const std::vector<std::int64_t> from_each(processes, is_first ? sizeof(Subdomain) : 0);
      std::vector<Subdomain> all(is_first ? processes : 0);
      ranks.exchange(reinterpret_cast<const char*>(&own), to_first,
        reinterpret_cast<char*>(all.data()), from_each);
      GatheredBounds bounds;
      for (const Subdomain& each : all)
      {
        bounds.x_data.insert(bounds.x_data.end(), { each.lo[0], each.hi[0] });
        bounds.y_data.insert(bounds.y_data.end(), { each.lo[1], each.hi[1] });
        bounds.z_data.insert(bounds.z_data.end(), { each.lo[2], each.hi[2] });
        bounds.particles.push_back(each.particles);
      }
      return bounds;
    });
}

Decomposition decomposition_of(const GatheredBounds& bounds)
{
  const std::size_t processes = bounds.particles.size();
  expect_size("x_data", bounds.x_data.size(), 2 * processes);
  expect_size("y_data", bounds.y_data.size(), 2 * processes);
  expect_size("z_data", bounds.z_data.size(), 2 * processes);
  if (processes > std::numeric_limits<int>::max())
  {
    throw LimitError("expected less than 2^31 processes, got " + std::to_string(processes));
  }
  Decomposition decomposition;
  decomposition.subdomains.resize(processes);
  for (std::size_t p = 0; p < processes; ++p)
  {
    Subdomain& subdomain = decomposition.subdomains[p];
    subdomain.lo = { bounds.x_data[2 * p], bounds.y_data[2 * p], bounds.z_data[2 * p] };
    subdomain.hi = { bounds.x_data[2 * p + 1], bounds.y_data[2 * p + 1], bounds.z_data[2 * p + 1] };
    subdomain.particles = bounds.particles[p];
    subdomain.rank = static_cast<int>(p);
  }
  return decomposition;
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
