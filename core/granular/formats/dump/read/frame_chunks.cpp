// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/read/frame_chunks.h"

#include "granular/common/shares.h"
#include "granular/formats/dump/grammar/frame_rows.h"
#include "granular/text/text_scanner.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace granular
{
namespace
{
constexpr std::int64_t some_rows = 4096;

/// The rows that the bytes of a piece can hold.
std::int64_t possible_rows(const FramePiece& piece) noexcept
{
  constexpr std::int64_t often_packed = 256; // times; what is packed better takes another turn
  const FrameEntry& entry = piece.entry;
  const std::size_t columns = std::max<std::size_t>(entry.kind->schema.columns().size(), 1);
  const std::size_t word =
    entry.kind->is_text() ? 2 : sizeof(double); // a digit and a blank at least
  const std::int64_t all = entry.end - entry.offset;
  const std::int64_t bytes =
    piece.file.compressed ? std::min(all, often_packed * piece.file.stamp.size) : all;
  return bytes / static_cast<std::int64_t>(word * columns) + some_rows;
}
}

std::int64_t rows_of(const FramePieces& pieces) noexcept
{
  return std::accumulate(pieces.begin(), pieces.end(), std::int64_t{ 0 },
    [](std::int64_t rows, const FramePiece& piece) { return rows + piece.entry.rows; });
}

void fail_count(const FramePiece& piece, std::int64_t rows)
{
  const std::int64_t expected = piece.entry.rows;
  throw FormatError("expected " + std::to_string(expected) + " rows, got " +
      (rows > expected ? "more" : std::to_string(rows)),
    where_of(piece));
}

std::vector<PieceRows> cut_frame(const FramePieces& pieces, int part, int parts)
{
  std::int64_t all = 0;
  for (const FramePiece& piece : pieces)
  {
    all += extent_of(piece.entry);
  }
  const std::int64_t first = begin_of_part(all, part, parts);
  const std::int64_t last = begin_of_part(all, part + 1, parts);
  std::vector<PieceRows> ranges;
  std::int64_t begin = 0;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece)
  {
    const std::int64_t extent = extent_of(pieces[piece].entry);
    const PieceRows range = { piece, std::max(first - begin, std::int64_t{ 0 }),
      std::min(last - begin, extent) };
    if (range.first < range.last)
    {
      ranges.push_back(range);
    }
    begin += extent;
  }
  return ranges;
}

std::int64_t most_rows(const FramePieces& pieces, const std::vector<PieceRows>& ranges)
{
  return std::accumulate(ranges.begin(), ranges.end(), std::int64_t{ 0 },
    [&](std::int64_t rows, const PieceRows& range)
    { return rows + pieces[range.piece].entry.rows; });
}

std::int64_t likely_rows(const FramePieces& pieces, const std::vector<PieceRows>& ranges)
{
  std::int64_t rows = 0;
  for (const PieceRows& range : ranges)
  {
    const FramePiece& piece = pieces[range.piece];
    const double share =
      static_cast<double>(range.last - range.first) / static_cast<double>(extent_of(piece.entry));
    const double likely = 1.25 * share * static_cast<double>(piece.entry.rows) + some_rows;
    const std::int64_t possible = std::min(piece.entry.rows, possible_rows(piece));
    rows += share == 1 || likely >= static_cast<double>(possible)
      ? possible
      : static_cast<std::int64_t>(likely);
  }
  return rows;
}

ChunkCuts::ChunkCuts(
  const FramePieces& pieces, const std::vector<PieceRows>& ranges, std::size_t chunk_bytes)
{
  const std::size_t bytes = std::min(chunk_bytes, TextScanner::longest_line);
  for (const PieceRows& range : ranges)
  {
    const std::int64_t step = chunk_extent(pieces[range.piece].entry, bytes);
    const std::int64_t chunks =
      range.first < range.last ? (range.last - 1) / step - range.first / step + 1 : 0;
    cuts_.push_back({ range, step, this->size() + static_cast<std::size_t>(chunks) });
  }
}

PieceRows ChunkCuts::operator[](std::size_t chunk) const noexcept
{
  const auto cut = std::ranges::upper_bound(cuts_, chunk, {}, &Cut::end);
  const std::int64_t before_end = static_cast<std::int64_t>(cut->end - chunk) - 1;
  const PieceRows& range = cut->range;
  const std::int64_t first = ((range.last - 1) / cut->step - before_end) * cut->step;
  return { range.piece, std::max(range.first, first), std::min(range.last, first + cut->step) };
}
}
