// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_subdomains_h
#define granular_decomposition_subdomains_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// The box along the axes that one process of a simulation owns, in the simulation's unit of length, and how many
/// particles it has.
struct Subdomain
{
  Vector3 lo = {};
  Vector3 hi = {};
  std::int64_t particles = 0;
  int rank = 0; ///< of the process

  bool operator==(const Subdomain&) const = default;
};

/// How a simulation box is divided: the box is the disjoint union of the subdomains.
struct Decomposition
{
  std::vector<Subdomain> subdomains;
  bool has_particles = true; ///< false: nobody has counted, particles are 0
  bool has_ranks = true;     ///< false: nobody knows which process owns which, ranks are counted
};

/// The bounds of all processes as dump decomposition/vtk collects them: of process p of P s = (x_min, x_max) lies in
/// x_data[2p] and x_data[2p + 1], t in y_data, u in z_data, its number of particles in particles[p].
struct GatheredBounds
{
  std::vector<double> x_data; ///< 2P
  std::vector<double> y_data;
  std::vector<double> z_data;
  std::vector<std::int64_t> particles; ///< P
};

/// Gives rank 0 the bounds and counts of all ranks, in the order of the ranks; others get nothing. own.rank is
/// not looked at. Collective.
GatheredBounds gather_bounds(const Subdomain& own, Communicator& ranks);

/// The subdomains with these bounds, p = 0 .. P - 1. Throws Error where an array has not its size.
Decomposition decomposition_of(const GatheredBounds& bounds);

/// Joins parts of one decomposition, in their order. Counts or ranks that a part with subdomains lacks are unknown: then all
/// counts are 0, or ranks are counted.
Decomposition join(std::span<const Decomposition> parts);

/// The subdomains of all ranks, in the order of the ranks, on all. What not all who have any know of them nobody
/// knows. Collective.
Decomposition gather_decomposition(const Decomposition& own, Communicator& ranks);

/// The smallest box around all, without particles; 0 along an axis without numbers. A nan counts for nothing, lo may be
/// above hi.
Subdomain bounds_of(std::span<const Subdomain> subdomains) noexcept;

/// The largest number of particles divided by the mean, made as largest * processes / sum; 1 without particles. processes: how
/// many there are, at least the subdomains; 0: as many as subdomains.
double imbalance_of(std::span<const Subdomain> subdomains, std::int64_t processes = 0) noexcept;

/// What becomes of a check that fails.
enum class Answer : std::uint8_t
{
  Error,
  Notice,
  None
};

/// What is required of subdomains.
struct SubdomainChecks
{
  Answer bounds = Answer::Error;  ///< lo <= hi, all finite
  Answer overlap = Answer::Error; ///< no two share more than faces
  Answer gap = Answer::Error;     ///< together they fill the smallest box around all
  /// Two overlap by more than this part of the box's edge along each axis, gaps have more than this part of its
  /// volume.
  double tolerance = 1e-9;
};

/// Holds subdomains against the checks, each of which gives one Error or Notice, that names the first two at fault
/// (a process by its rank) and counts them, up to 10^6 overlaps. Those without bounds are left out of the overlaps; gaps
/// are looked for where all have bounds and no two overlap. In a box that is flat areas may not overlap, and there are
/// no gaps. A grid has neither, which takes no more than finding it; others take n log n (see find_overlaps). Throws FormatError; Cancelled.
void check_subdomains(std::span<const Subdomain> subdomains, const SubdomainChecks& checks,
  const Where& where, Notices& notices, Progress& progress);
}
#endif
