// SPDX-License-Identifier: BSD-3-Clause
// Subdomains as simulations make them, by the plainest means.
#ifndef tests_decomposition_made_subdomains_h
#define tests_decomposition_made_subdomains_h

#include "granular/grid/subdomains.h"

#include <array>
#include <cstddef>
#include <random>
#include <vector>

using Subdomains = std::vector<granular::Subdomain>;

inline granular::Subdomain made_subdomain(const granular::Vector3& lo, const granular::Vector3& hi,
  std::int64_t particles = 0, int rank = 0)
{
  return { lo, hi, particles, rank };
}

/// A box from -1 0 1e3 of edges 2 3 4, cut into equal parts, ranks with x fastest.
inline Subdomains made_grid(const std::array<int, 3>& counts)
{
  const granular::Vector3 lo = { -1, 0, 1e3 };
  const granular::Vector3 edges = { 2, 3, 4 };
  const auto cut = [&](std::size_t axis, int i)
  { return lo[axis] + edges[axis] * i / counts[axis]; };
  Subdomains subdomains;
  for (int k = 0; k < counts[2]; ++k)
  {
    for (int j = 0; j < counts[1]; ++j)
    {
      for (int i = 0; i < counts[0]; ++i)
      {
        subdomains.push_back(
          { { cut(0, i), cut(1, j), cut(2, k) }, { cut(0, i + 1), cut(1, j + 1), cut(2, k + 1) },
            100 * i + j, static_cast<int>(subdomains.size()) });
      }
    }
  }
  return subdomains;
}

/// The unit cube, cut by chance across its longest edge, as are its parts, until there are so many.
inline Subdomains made_bisection(int count, unsigned seed)
{
  std::mt19937 random(seed);
  Subdomains subdomains;
  struct Part
  {
    granular::Subdomain box;
    int count;
  };
  std::vector<Part> parts = { { { {}, { 1, 1, 1 }, 0, 0 }, count } };
  while (!parts.empty())
  {
    const Part part = parts.back();
    parts.pop_back();
    if (part.count == 1)
    {
      subdomains.push_back(part.box);
      subdomains.back().rank = static_cast<int>(subdomains.size()) - 1;
      continue;
    }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      const auto edge = [&](std::size_t a) { return part.box.hi[a] - part.box.lo[a]; };
      longest = edge(axis) > edge(longest) ? axis : longest;
    }
    const double share = 0.3 + 0.4 * std::generate_canonical<double, 53>(random);
    const double cut = part.box.lo[longest] + share * (part.box.hi[longest] - part.box.lo[longest]);
    Part low = { part.box, part.count / 2 };
    Part high = { part.box, part.count - part.count / 2 };
    low.box.hi[longest] = high.box.lo[longest] = cut;
    parts.push_back(high);
    parts.push_back(low);
  }
  return subdomains;
}

#endif
