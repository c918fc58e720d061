// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_read_frame_chunks_h
#define granular_formats_dump_read_frame_chunks_h

#include "granular/frames/run_index.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
using FramePieces = std::vector<FramePiece>;

std::int64_t rows_of(const FramePieces& pieces) noexcept;

/// Throws the FormatError for a piece whose number of rows contradicts its header.
[[noreturn]] void fail_count(const FramePiece& piece, std::int64_t rows);

/// A range of a piece: the rows that begin in [first, last) of its extent.
struct PieceRows
{
  std::size_t piece;
  std::int64_t first;
  std::int64_t last;
};

/// Returns part `part` of `parts` of a frame: its pieces in order, divided by their extents. The parts hold each row once, in
/// order; there may be more parts than rows.
std::vector<PieceRows> cut_frame(const FramePieces& pieces, int part, int parts);

/// Returns the largest number of rows in the ranges if the headers of the pieces are right: a part has at most the rows of
/// its pieces.
std::int64_t most_rows(const FramePieces& pieces, const std::vector<PieceRows>& ranges);

/// Returns the rows to make room for at first: rows of text differ in length, but a part rarely has many more than its share.
/// Not more than the bytes can hold, those of a packed file at the usual ratio: a header may claim any number.
std::int64_t likely_rows(const FramePieces& pieces, const std::vector<PieceRows>& ranges);

/// Divides ranges into chunks of about so many bytes, none longer than the longest row: a row that is too long does not fit
/// and is detected. The bounds do not depend on the ranges. Memory is needed per range, not per chunk, because the length of
/// a range may be only a claim.
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
