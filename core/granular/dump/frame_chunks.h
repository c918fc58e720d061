// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_frame_chunks_h
#define granular_dump_frame_chunks_h

#include "granular/base/byte_source.h"
#include "granular/dump/frame.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace granular
{
/// The pieces of a frame, and how to get at their bytes.
struct PieceList
{
  std::vector<const FrameEntry*> entries;
  std::vector<std::string> paths;
  std::function<std::shared_ptr<const ByteSource>(std::size_t piece)> open;

  std::int64_t rows() const noexcept;   ///< of all pieces
  Where where(std::size_t piece) const; ///< its place
};

/// Part of a piece: the rows that begin in [first, last) of its extent.
struct RowRange
{
  std::size_t piece;
  std::int64_t first;
  std::int64_t last;
};

/// Part `part` of `parts` of a frame: its pieces, one behind the other, cut by their extents. The parts
/// hold each row once, in their order; there may be more of them than rows.
std::vector<RowRange> cut_frame(const PieceList& pieces, int part, int parts);

/// The ranges in chunks of about so many bytes, but none longer than the longest row: a row that is too
/// long does not fit one, and so is found. The bounds do not depend on the ranges.
std::vector<RowRange> cut_chunks(
  const PieceList& pieces, const std::vector<RowRange>& ranges, std::size_t chunk_bytes);
}
#endif
