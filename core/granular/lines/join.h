// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_lines_join_h
#define granular_lines_join_h

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

/// The arrays that lines get from the particles at their ends.
struct JoinRequest
{
  std::vector<std::string> means; ///< arrays whose mean over both ends is wanted
  std::vector<std::string>
    differences;                   ///< arrays whose difference, second end minus first, is wanted
  int threads = 1;                 ///< at least 1; changes no result
  std::shared_ptr<BlockPool> pool; ///< source of the memory; may be null
};

/// An array made from the ends of lines: lines x size doubles.
struct EndArray
{
  std::string name; ///< A_mean, A_difference
  int size = 1;
  Block values;
};

/// Lines, from rows that name their ends, with arrays of the particles there.
struct JoinedLines
{
  std::int64_t count = 0;         ///< rows of this rank with both ends found
  std::vector<std::int64_t> rows; ///< these rows, in order; empty: all of the rank, line i is row i
  Block first;                    ///< x y z of the first end of each
  Block second;
  std::vector<EndArray> arrays;
  std::int64_t missing = 0; ///< rows of all ranks left out because an end was not found
  std::int64_t repeated =
    0; ///< particles of all ranks with an earlier particle's id, which is taken instead
};

/// Finds the particles with the ids of the ends of lines: id1[i] and id2[i] of row i. The particles are those of all ranks
/// without duplicates, with an integer array `id` of any type; ids may be any 64-bit integers, in any order. Rows and
/// particles may be on any ranks, and ranks without them may lack all arrays. Ends are at the particles: absolute, or
/// unwrapped if the points are; a subtracted origin is added again.
///
/// The mean is std::midpoint of doubles: rounded once, the same for swapped ends, without overflow. All means come first,
/// then all differences, each once, in the requested order. Threads and ranks change no bit; among particles with the same id
/// the first of the lowest rank is taken.
///
/// Throws Error on all ranks if there are particles without ids, or with an id that is not an integer, or if a wanted array
/// is missing or not numeric; Cancelled; std::bad_alloc. Collective.
JoinedLines join_lines(const FrameView& particles, std::span<const std::int64_t> id1,
  std::span<const std::int64_t> id2, const JoinRequest& request, Communicator& ranks,
  Progress& progress);
}
#endif
