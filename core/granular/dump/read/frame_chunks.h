// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_read_frame_chunks_h
#define granular_dump_read_frame_chunks_h

#include "granular/bytes/byte_source.h"
#include "granular/frames/run_index.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
using FramePieces = std::vector<FramePiece>;

std::int64_t rows_of(const FramePieces& pieces) noexcept;

/// Throws the FormatError for a piece that has other rows than its header promises.
[[noreturn]] void fail_count(const FramePiece& piece, std::int64_t rows);

/// Part of a piece: the rows that begin in [first, last) of its extent.
struct PieceRows
{
  std::size_t piece;
  std::int64_t first;
  std::int64_t last;
};

/// Part `part` of `parts` of a frame: its pieces, one behind the other, cut by their extents. The parts
/// hold each row once, in their order; there may be more of them than rows.
std::vector<PieceRows> cut_frame(const FramePieces& pieces, int part, int parts);

/// As many rows as the ranges have at most, if the pieces have what their headers promise: no part has more than the pieces that
/// it is of.
std::int64_t most_rows(const FramePieces& pieces, const std::vector<PieceRows>& ranges);

/// As many as they have as a rule: rows of a text differ in length, but a part of it rarely has many more than its share.
std::int64_t likely_rows(const FramePieces& pieces, const std::vector<PieceRows>& ranges);

/// The rows of a frame, or as many as the bytes of its file can be: of a packed one as they are packed as a rule.
std::int64_t possible_rows(const FrameEntry& entry, const ByteSource& source);

/// Ranges in chunks of about so many bytes, but none longer than the longest row: a row that is too
/// long does not fit one, and so is found. The bounds do not depend on the ranges. Takes memory for each range,
/// none for a chunk: how long a range is may be no more than a claim.
class ChunkCuts
{
public:
  ChunkCuts(
    const FramePieces& pieces, const std::vector<PieceRows>& ranges, std::size_t chunk_bytes);

  std::size_t size() const noexcept { return cuts_.empty() ? 0 : cuts_.back().end; }
  PieceRows operator[](std::size_t chunk) const noexcept;

private:
  struct Cut
  {
    PieceRows range;
    std::int64_t step;
    std::size_t end; ///< chunks up to here, with those of the ranges before
  };

  std::vector<Cut> cuts_;
};
}
#endif
