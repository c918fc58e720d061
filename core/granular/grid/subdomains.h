// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_subdomains_h
#define granular_grid_subdomains_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// The box along the axes that one rank of a simulation owns, in the simulation's unit of length, with its number of
/// particles.
struct Subdomain
{
  Vector3 lo = {};
  Vector3 hi = {};
  std::int64_t particles = 0;
  int rank = 0; ///< of the process

  bool operator==(const Subdomain&) const = default;
};

/// The division of a simulation box: the box is the disjoint union of the subdomains.
struct Decomposition
{
  std::vector<Subdomain> subdomains;
  bool has_particles = true; ///< false: the particles are unknown, and 0
  bool has_ranks = true;     ///< false: the ranks are unknown, and counted
};

/// Joins parts of one decomposition, in order. Counts or ranks that a part with subdomains lacks are unknown: then all counts
/// are 0, or ranks are counted.
Decomposition join(std::span<const Decomposition> parts);

/// Returns the subdomains of all ranks, in rank order, on all ranks. Counts or ranks that one of the ranks with subdomains
/// lacks are unknown for all. Collective.
Decomposition gather_decomposition(const Decomposition& own, Communicator& ranks);

/// Returns the smallest box around all, without particles; 0 along an axis without numbers. nan is ignored; lo may be above
/// hi.
Subdomain bounds_of(std::span<const Subdomain> subdomains) noexcept;

/// Returns the largest number of particles divided by the mean, as largest * processes / sum; 1 without particles. processes:
/// the number of ranks, at least the subdomains; 0: as many as subdomains.
double imbalance_of(std::span<const Subdomain> subdomains, std::int64_t processes = 0) noexcept;

/// The action for a failed check.
enum class Answer : std::uint8_t
{
  Error,
  Notice,
  None
};

/// The checks of subdomains.
struct SubdomainChecks
{
  Answer overlap = Answer::Error; ///< no two share more than faces
  Answer gap = Answer::Error;     ///< together they fill the smallest box around all
};

/// Checks subdomains. Wrong ones give one Error or Notice, which names the first two (by rank) and counts all, up to 10^6
/// overlaps; bounds that are not finite, or inverted, always give an Error. Gaps are checked if no two overlap. In a flat box
/// areas must not overlap, and there are no gaps. Overlaps and gaps below 1e-9 of the box are rounding. Takes n log n where
/// planes divide the subdomains. Throws FormatError; Cancelled.
void check_subdomains(std::span<const Subdomain> subdomains, const SubdomainChecks& checks,
  const Where& where, Notices& notices, Progress& progress);
}
#endif
