// SPDX-License-Identifier: BSD-3-Clause
// Frames to be sorted, alone or on ranks, and what must come out.
#ifndef granular_tests_support_sort_checks_h
#define granular_tests_support_sort_checks_h

#include "granular/formats/dump/read/dump_reader.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

using Ids = std::vector<std::int64_t>;

/// Ids in some arrangement, by its name; as many as asked for.
Ids make_ids(const std::string& arrangement, std::size_t count);

/// The names that make_ids knows.
const std::vector<std::string>& arrangements();

/// Rows first to last of a frame with these ids. All other values follow from the row's number in the
/// whole frame, so that any row can be told from any other, and hold any bits there may be.
struct MadeFrame
{
  granular::Table frame;
  granular::Block ids; ///< where they are not an array
};
MadeFrame make_frame(const Ids& ids, std::size_t first, std::size_t last, bool with_id_array = true,
  bool single_precision = false);

/// All that the frame holds, bit for bit.
std::string bytes_of(const granular::Table& frame);

/// The rows of the whole, by a stable sort of their numbers.
granular::Table sorted_frame(const Ids& ids, std::size_t first, std::size_t last,
  bool with_id_array = true, bool single_precision = false);

/// Called on all ranks: sorts frames spread over them in many ways.
void check_sort_by_id(granular::Communicator& ranks);

/// There are no ids: nothing moves.
void check_without_ids(granular::Communicator& ranks);

#endif
