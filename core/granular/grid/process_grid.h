// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_process_grid_h
#define granular_grid_process_grid_h

#include "granular/grid/subdomains.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace granular
{
/// Ranks in a grid of px x py x pz (the command `processors`), each axis cut at its own positions. Subdomain (i py + j) pz +
/// k is the i-th along x, j-th along y, k-th along z, and belongs to that rank: the numbering of MPI_Cart_create, and of
/// LAMMPS and LIGGGHTS unless the input script changes it.
struct ProcessGrid
{
  std::array<std::vector<double>, 3> cuts; ///< p + 1 positions along each axis, not decreasing

  std::int64_t size() const noexcept;                  ///< px py pz; 0 without cuts
  std::array<std::int64_t, 3> counts() const noexcept; ///< px py pz

  /// Returns subdomains [first, last).
  std::vector<Subdomain> subdomains(std::int64_t first, std::int64_t last) const;
};

/// A user's description of a grid.
struct GridRequest
{
  Vector3 lo = {};
  Vector3 hi = {};                       ///< not below lo
  std::int64_t processes = 0;            ///< 0: as many as the grid has
  std::array<int, 3> grid = { 1, 1, 1 }; ///< px py pz; 0: chosen, so that the product is processes
  std::array<std::vector<double>, 3>
    cuts = {}; ///< p - 1 positions between lo and hi, increasing; empty: evenly
               ///< spaced, lo + (hi - lo) (i / p), rounded in this order, as LIGGGHTS does
};

/// Returns the grid. Zeros are chosen like `processors *`: the smallest area between subdomains, xy/px/py + xz/px/pz +
/// yz/py/pz rounded in this order. Of several equal ones LAMMPS and LIGGGHTS take the first with x, then y, counted up; if
/// part of the grid is given, the first in an order of their own, which is kept. Throws Error for bounds that are not finite
/// or inverted, a negative number, ranks that are not px py pz or have no such division, 2^31 ranks and more, and cuts that
/// are not ascending, not inside the bounds or not p - 1 (where the grid has a zero, p follows from the cuts).
ProcessGrid make_process_grid(const GridRequest& request);

/// Returns the grid that subdomains with finite bounds form, in any order, or nothing: each position is taken once, by a
/// different subdomain. order, if wanted, gets the position of each subdomain in the grid.
std::optional<ProcessGrid> find_process_grid(
  std::span<const Subdomain> subdomains, std::vector<std::int64_t>* order = nullptr);
}
#endif
