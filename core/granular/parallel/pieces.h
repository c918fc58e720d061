// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_parallel_pieces_h
#define granular_parallel_pieces_h

#include "granular/common/error.h"
#include "granular/common/shares.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <string>
#include <utility>

namespace granular
{
/// Returns true if a rank asks for its own piece of as many as there are ranks.
inline bool is_own_piece(int piece, int pieces, const Communicator& ranks) noexcept
{
  return pieces == ranks.size() && piece == ranks.rank();
}

/// Returns true if each rank asks for its own piece of a whole, false if each asks for any of what it has alone. Throws
/// UnsupportedError if only some ask for their own, unless they may differ. Collective.
inline bool are_together(int piece, int pieces, bool may_differ, Communicator& ranks)
{
  std::int64_t all = is_own_piece(piece, pieces, ranks) ? 1 : 0;
  ranks.sum({ &all, 1 });
  const bool together = all == ranks.size();
  if (all != 0 && !together && !may_differ)
  {
    throw UnsupportedError("expected that all processes ask for their own piece, or none, got " +
      std::to_string(all) + " of " + std::to_string(ranks.size()));
  }
  return together;
}

/// Returns the part [first, last) of so many things that belongs to a piece.
inline std::pair<std::int64_t, std::int64_t> range_of_piece(
  std::int64_t count, int piece, int pieces) noexcept
{
  const auto first = [&](int part)
  { return part < pieces ? begin_of_part(count, part, pieces) : count; };
  return { first(piece), first(piece + 1) };
}
}
#endif
