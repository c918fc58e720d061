// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_process_grid_h
#define granular_decomposition_process_grid_h

#include "granular/decomposition/subdomains.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace granular
{
/// Processes in a grid of px x py x pz (the command `processors`), each axis cut at its own positions. Subdomain
/// (i py + j) pz + k is the i-th along x, j-th along y, k-th along z, and of the process of that rank: so
/// MPI_Cart_create numbers them, and with it LAMMPS and LIGGGHTS where the input script does not say otherwise.
struct ProcessGrid
{
  std::array<std::vector<double>, 3>
    cuts; ///< of each axis p + 1 positions, none below the one before

  std::int64_t size() const noexcept;                  ///< px py pz; 0 without cuts
  std::array<std::int64_t, 3> counts() const noexcept; ///< px py pz

  /// Subdomains [first, last).
  std::vector<Subdomain> subdomains(std::int64_t first, std::int64_t last) const;
};

/// What a user says of a grid.
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

/// The grid. Zeros are chosen as `processors *` does: the least area between subdomains, xy/px/py + xz/px/pz +
/// yz/py/pz rounded in this order. Where several have it LAMMPS and LIGGGHTS take the first with x, then y, counted up;
/// where part of the grid is given the first of an order of their own, which is kept. Throws Error: bounds that are not
/// finite or inverted, a negative number, processes that are not px py pz or have no such division, 2^31 processes and
/// more, cuts that are not increasing, not inside the bounds or not p - 1 (where grid has a zero there, p follows from
/// the cuts).
ProcessGrid make_process_grid(const GridRequest& request);

/// The grid that subdomains with finite bounds form, in whatever order, or nothing: each place is taken once, by one
/// that differs from all others. order, if wanted, gets the place of each subdomain in the grid.
std::optional<ProcessGrid> find_process_grid(
  std::span<const Subdomain> subdomains, std::vector<std::int64_t>* order = nullptr);
}
#endif
