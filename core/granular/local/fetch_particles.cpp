// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/fetch_particles.h"

#include "granular/local/id_finder.h"
#include "granular/parallel/by_rank.h"
#include "granular/parallel/trade.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace granular
{
namespace
{
using Numbers = std::vector<std::int64_t>;

/// Points and arrays of a particle, one after the other.
std::size_t width_of(const ParticleValues& values)
{
  return std::accumulate(values.arrays.begin(), values.arrays.end(), std::size_t{ 3 },
    [](std::size_t sum, const ArrayView& array) { return sum + array.components.size(); });
}

std::vector<double> pack(const ParticleValues& values, const Numbers& rows)
{
  constexpr std::size_t some = 1024; // rows at once, that stay in the cache
  std::array<double, some> numbers;
  const std::size_t width = width_of(values);
  std::vector<double> packed(rows.size() * width);
  for (std::size_t first = 0; first < rows.size(); first += some)
  {
    const auto now = std::span(rows).subspan(first, std::min(some, rows.size() - first));
    double* to = packed.data() + first * width;
    for (std::size_t i = 0; i < now.size(); ++i)
    {
      std::copy_n(values.points + now[i] * values.point_step, 3, to + i * width);
    }
    to += 3;
    for (const ArrayView& array : values.arrays)
    {
      for (int component = 0; component < array.size(); ++component)
      {
        load_numbers(component_of(array, component), now, numbers.data());
        for (std::size_t i = 0; i < now.size(); ++i)
        {
          to[i * width] = numbers[i];
        }
        ++to;
      }
    }
  }
  return packed;
}

/// Lets points and arrays show what came.
void view_packed(ParticleValues& values, std::size_t width)
{
  const double* next = values.own.data();
  values.points = next;
  values.point_step = static_cast<std::int64_t>(width);
  next += 3;
  for (ArrayView& array : values.arrays)
  {
    array.type = ValueType::Float64;
    array.step = values.point_step;
    for (const void*& component : array.components)
    {
      component = next++;
    }
  }
}
}

FetchedParticles fetch_particles(const ParticleValues& own, const IdDirectory& directory,
  const Numbers& wanted, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      const auto size = static_cast<std::size_t>(ranks.size());
      const std::vector<ParticleHome> homes = directory.find(wanted, ranks);
      const ByRank requests = sort_by_rank(homes.size(), size,
        [&](std::size_t i)
        { return homes[i].rank < 0 ? size : static_cast<std::size_t>(homes[i].rank); });
      FetchedParticles fetched;
      fetched.ids = pick(wanted, requests.places);
      Numbers rows(requests.places.size());
      std::ranges::transform(requests.places, rows.begin(),
        [&](std::int64_t place) { return homes[static_cast<std::size_t>(place)].row; });
      fetched.values.arrays = own.arrays;
      const Numbers wanted_here = swap_numbers(requests.counts, ranks);
      rows = trade(rows, requests.counts, wanted_here, ranks);
      const std::size_t width = width_of(own);
      fetched.values.own = trade(pack(own, rows), wanted_here, requests.counts, ranks, width);
      view_packed(fetched.values, width);
      fetched.repeated = directory.repeated();
      return fetched;
    });
}

FetchedParticles fetch_particles(const OwnParticles& own, std::span<const std::int64_t> id1,
  std::span<const std::int64_t> id2, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      const IdDirectory directory(own.ids, own.ghosts, ranks);
      return fetch_particles(own.values, directory, distinct_ids(id1, id2), ranks);
    });
}
}
