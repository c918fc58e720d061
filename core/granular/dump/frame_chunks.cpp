// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/frame_chunks.h"

#include "granular/base/text_scanner.h"
#include "granular/dump/exchange_rows.h"
#include "granular/dump/frame_rows.h"

#include <algorithm>
#include <numeric>

namespace granular
{
std::int64_t PieceList::rows() const noexcept
{
  return std::accumulate(entries.begin(), entries.end(), std::int64_t{ 0 },
    [](std::int64_t rows, const FrameEntry* entry) { return rows + entry->rows; });
}

Where PieceList::where(std::size_t piece) const
{
  return where_of(paths[piece], *entries[piece]);
}

std::vector<RowRange> cut_frame(const PieceList& pieces, int part, int parts)
{
  std::int64_t all = 0;
  for (const FrameEntry* const entry : pieces.entries)
  {
    all += extent_of(*entry);
  }
  const std::int64_t first = begin_of_part(all, part, parts);
  const std::int64_t last = begin_of_part(all, part + 1, parts);
  std::vector<RowRange> ranges;
  std::int64_t begin = 0;
  for (std::size_t piece = 0; piece < pieces.entries.size(); ++piece)
  {
    const std::int64_t extent = extent_of(*pieces.entries[piece]);
    const RowRange range = { piece, std::max(first - begin, std::int64_t{ 0 }),
      std::min(last - begin, extent) };
    if (range.first < range.last)
    {
      ranges.push_back(range);
    }
    begin += extent;
  }
  return ranges;
}

std::vector<RowRange> cut_chunks(
  const PieceList& pieces, const std::vector<RowRange>& ranges, std::size_t chunk_bytes)
{
  const std::size_t bytes = std::min(chunk_bytes, TextScanner::longest_line);
  std::vector<RowRange> chunks;
  for (const RowRange& range : ranges)
  {
    const std::int64_t step = chunk_extent(*pieces.entries[range.piece], bytes);
    for (std::int64_t first = range.first; first < range.last;)
    {
      const std::int64_t last = std::min(range.last, (first / step + 1) * step);
      chunks.push_back({ range.piece, first, last });
      first = last;
    }
  }
  return chunks;
}
}
