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
/// What a rank tells of itself.
struct Told
{
  Vector3 lo;
  Vector3 hi;
  std::int64_t particles;
};

/// What rank 0 gets, and how much comes from whom.
struct Gathering
{
  std::vector<std::int64_t> from_bytes;
  std::vector<std::int64_t> to_bytes;
  std::vector<Told> told;
  GatheredBounds bounds;

  explicit Gathering(const Communicator& ranks)
    : from_bytes(static_cast<std::size_t>(ranks.size()))
    , to_bytes(from_bytes.size())
  {
    from_bytes[0] = sizeof(Told);
    if (ranks.rank() == 0)
    {
      std::fill(to_bytes.begin(), to_bytes.end(), sizeof(Told));
      told.resize(to_bytes.size());
      for (std::vector<double>* data : { &bounds.x_data, &bounds.y_data, &bounds.z_data })
      {
        data->resize(2 * told.size());
      }
      bounds.particles.resize(told.size());
    }
  }

  /// From what was told.
  void fill_bounds()
  {
    double* const data[3] = { bounds.x_data.data(), bounds.y_data.data(), bounds.z_data.data() };
    for (std::size_t p = 0; p < told.size(); ++p)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        data[axis][2 * p] = told[p].lo[axis];
        data[axis][2 * p + 1] = told[p].hi[axis];
      }
      bounds.particles[p] = told[p].particles;
    }
  }
};

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
      const Told told = { own.lo, own.hi, own.particles };
      Gathering all(ranks);
      ranks.exchange(reinterpret_cast<const char*>(&told), all.from_bytes,
        reinterpret_cast<char*>(all.told.data()), all.to_bytes);
      all.fill_bounds();
      return std::move(all.bounds);
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

Decomposition gather_decomposition(const Decomposition& own, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      Decomposition joined;
      for (const Decomposition& part : gather(ranks, own))
      {
        if (part.subdomains.empty())
        {
          continue; // nothing is known of arrays where there are no cells
        }
        joined.has_particles = joined.has_particles && part.has_particles;
        joined.has_ranks = joined.has_ranks && part.has_ranks;
        joined.subdomains.insert(
          joined.subdomains.end(), part.subdomains.begin(), part.subdomains.end());
      }
      for (std::size_t i = 0; !joined.has_ranks && i < joined.subdomains.size(); ++i)
      {
        joined.subdomains[i].rank = static_cast<int>(i);
      }
      return joined;
    });
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
