// SPDX-License-Identifier: BSD-3-Clause
// Rows of made particles and contacts on ranks, and the bits of their averages.
#ifndef granular_tests_averages_made_rows_h
#define granular_tests_averages_made_rows_h

#include "made_touches.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

inline constexpr granular::Vector3 lo = { -1, 0, 2 };
inline constexpr granular::Vector3 hi = { 1, 3, 3 };

inline granular::Box make_box()
{
  granular::Box box = granular::Box::from_bounds(lo, hi);
  box.boundary = "pp ff pp";
  return box;
}

using Bits = std::vector<std::vector<std::uint64_t>>;

/// The bits of all that is known of cells or points, one vector for each.
inline Bits bits_of(const granular::EulerAverages& averages)
{
  const auto cells = static_cast<std::size_t>(averages.cells.count());
  Bits bits(cells);
  const auto add = [&](const std::vector<double>& values)
  {
    const std::size_t width = cells > 0 ? values.size() / cells : 0;
    for (std::size_t i = 0; i < cells * width; ++i)
    {
      bits[i / width].push_back(std::bit_cast<std::uint64_t>(values[i]));
    }
  };
  for (const granular::EulerArray& array : granular::euler_arrays())
  {
    add(averages.cells.*array.values);
  }
  for (const granular::EulerField& field : granular::euler_fields)
  {
    add(averages.fields.*field.values);
  }
  for (const std::vector<double>* sums :
    { &averages.sums.share, &averages.sums.mass, &averages.sums.momentum, &averages.sums.ends,
      &averages.sums.contacts, &averages.sums.normals })
  {
    add(*sums);
  }
  return bits;
}

/// Each particle and each contact that is here.
template <class IsHere>
Scene part_of(const Scene& scene, const IsHere& is_here)
{
  Scene part;
  part.forces = scene.forces;
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
  {
    if (is_here())
    {
      part.particles.push_back(scene.particles[i]);
      part.ids.push_back(scene.ids[i]);
    }
  }
  const auto take = [&](const std::vector<Touch>& from, std::vector<Touch>& to)
  { std::ranges::copy_if(from, std::back_inserter(to), [&](const Touch&) { return is_here(); }); };
  take(scene.pairs, part.pairs);
  take(scene.walls, part.walls);
  return part;
}
#endif
