// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_random_grains_h
#define granular_packing_random_grains_h

#include "granular/base/progress.h"
#include "granular/packing/box_shape.h"
#include "granular/packing/radii.h"
#include "granular/packing/row_range.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// Rows of grains, and where they go.
struct GrainRows : RowRange
{
  double* scaled = nullptr; ///< three a row: their place in units of the box vectors
  double* radius = nullptr;
};

/// Grains where chance puts them, one after the other, each where no other is (random sequential addition),
/// in the regions of Regions: so all ranks agree on the grains between them without a word.
struct RandomGrains
{
  const BoxShape& box;
  const Radii& radii;
  std::int64_t grains; ///< of the whole box
  std::uint64_t seed;
};

/// Places some of the grains, and what is around them. Throws LimitError where one finds no place;
/// Cancelled.
void place(const RandomGrains& all, const GrainRows& rows, int threads, Progress& progress);

/// Rows after some, in order, that have all those later ones that may be nearer to one of them than six of the
/// largest radii.
std::vector<RowRange> rows_near(const RandomGrains& all, const RowRange& rows);
}
#endif
