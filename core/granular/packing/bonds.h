// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_bonds_h
#define granular_packing_bonds_h

#include "granular/common/progress.h"
#include "granular/memory/block.h"
#include "granular/packing/packing_plan.h"

#include <cstdint>

namespace granular
{
/// Bonds between particles, in the order of (id1, id2).
struct GrainBonds
{
  std::int64_t count = 0;
  Block id1;   ///< std::int64_t
  Block id2;   ///< std::int64_t, greater than id1
  Block btype; ///< std::int32_t: 1
  Block
    equilibrium_length; ///< double: the distance of the two centres, or of the nearest image: computed
                        ///< from the centres and box vectors, not from the rounded image
  Block points; ///< 2 x 3 doubles a bond: the centre of id1, and id2's image nearest to it, rounded
};

/// Bonds the particles of a plan; not collective. In a chain consecutive particles are bonded, for any factor. In other
/// arrangements all pairs are bonded whose centres are no farther apart than the factor, 1 to 3, times the sum of the radii,
/// within rounding: at 1, the neighbours of a lattice of spacing 1. Periodic images count, and of several images of a pair the
/// nearest, so a pair has at most one bond, and a particle none with itself; among equally near images the one moved by fewer
/// box vectors counts.
///
/// A bond belongs to the piece of its lower id; the piece holds all its bonds, and pieces and threads change nothing else.
///
/// Throws LimitError for other factors; Cancelled; std::bad_alloc.
GrainBonds make_bonds(const PackingPlan& plan, double factor, Progress& progress);
}
#endif
