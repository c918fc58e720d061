// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_subdomains_decompose_h
#define granular_subdomains_decompose_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/grid/process_grid.h"
#include "granular/grid/subdomains.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace granular
{
/// The subdomains in which particles are counted.
enum class SubdomainsOf : std::uint8_t
{
  Grid,   ///< of a grid of ranks in the box
  Owners, ///< bounds of the particles of each owner, by an array
  Given,  ///< any
  Ranks   ///< bounds of the particles that each rank has here
};

struct DecomposeRequest
{
  SubdomainsOf mode = SubdomainsOf::Grid;
  std::array<double, 6> bounds = { 1, -1, 1, -1, 1, -1 }; ///< of the grid: see find_bounds
  GridRequest grid; ///< its bounds are set; processes also count with Owners
  std::string owners = "proc";
  std::function<Decomposition()> read_given; ///< of this rank
  int threads = 1;                           ///< at least 1; changes no result
};

/// Particles in subdomains, of all ranks.
struct Decomposed
{
  Decomposition all;
  double imbalance = 1;     ///< see imbalance_of; with ranks that have no particles
  std::int64_t outside = 0; ///< particles that are in none

  /// Returns subdomains [first, last), or with Ranks that of `rank`, in the coordinates of the points, but for their origin. Throws
  /// UnsupportedError for scaled points of a tilted box.
  Decomposition part(const FrameView& particles, SubdomainsOf mode,
    std::pair<std::int64_t, std::int64_t> range, int rank) const;
};

/// Counts the particles of all ranks of `group`, with Ranks those of `ranks`, and tells if some are outside. share_header has been
/// called. Throws Error, also on all ranks; Cancelled. Collective.
Decomposed decompose(const FrameView& particles, const DecomposeRequest& request,
  Communicator& ranks, Communicator& group, Notices& notices, Progress& progress);

/// Returns the grid of a request in a box.
ProcessGrid grid_in(GridRequest request, const Vector3& lo, const Vector3& hi);
}
#endif
