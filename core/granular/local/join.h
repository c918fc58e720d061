// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_join_h
#define granular_local_join_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace granular
{
class BlockPool;

/// What lines get from the particles at their ends.
struct JoinRequest
{
  std::vector<std::string> means;       ///< arrays of which lines get the mean of both ends
  std::vector<std::string> differences; ///< arrays of which they get the second's less the first's
  int threads = 1;                      ///< >= 1; changes no result
  std::shared_ptr<BlockPool> pool;      ///< where the memory comes from; may be null
};

/// An array made from the ends of lines: lines x size doubles.
struct EndArray
{
  std::string name; ///< A_mean, A_difference
  int size = 1;
  Block values;
};

/// Lines, by the rows that name their ends, with what the particles there have.
struct JoinedLines
{
  std::int64_t count = 0; ///< rows of this rank whose two ends were found
  std::vector<std::int64_t>
    rows;      ///< these, in their order; empty: all of the rank, line i is row i
  Block first; ///< x y z of the first end of each
  Block second;
  std::vector<EndArray> arrays;
  std::int64_t missing = 0;  ///< rows of all ranks that were left out, as an end was not found
  std::int64_t repeated = 0; ///< particles of all ranks whose id an earlier one has, which is taken
};

/// Finds the particles with the ids of the ends of lines: id1[i] and id2[i] of row i. The particles are those
/// of all ranks, duplicates left out, with an array `id` of any type that holds integers; these may be any of
/// 64 bits, in any order. Rows and particles may be on any ranks, and those who have none may lack all arrays.
/// Ends are where the particles are: absolute, but as they are shown where points are unwrapped; an origin that was
/// subtracted is added.
///
/// The mean is std::midpoint of doubles: rounded once, the same for ends that are swapped, without overflow. All
/// means come first, then all differences, each once, in the order in which they are wanted. Threads and ranks change
/// no bit; only of particles with the same id the first of the lowest rank is taken.
///
/// Throws Error on all ranks if there are particles but no ids, or one that is no integer, or an array that is wanted is
/// not there or no number; Cancelled; std::bad_alloc. Collective.
JoinedLines join_lines(const FrameView& particles, std::span<const std::int64_t> id1,
  std::span<const std::int64_t> id2, const JoinRequest& request, Communicator& ranks,
  Progress& progress);
}
#endif
