// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_read_chunk_decoder_h
#define granular_dump_read_chunk_decoder_h

#include "granular/dump/formats/frame_rows.h"
#include "granular/dump/read/frame_layout.h"
#include "granular/particles/frame_ranges.h"
#include "granular/particles/rounding_loss.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace granular
{
/// What became of a chunk of rows.
struct DecodedChunk
{
  std::int64_t row = 0;   ///< of the frame in memory, where its first row was put
  std::int64_t rows = 0;  ///< decoded
  std::int64_t kept = 0;  ///< by the filters
  bool surplus = false;   ///< see RowReader::surplus
  RoundingLoss loss = {}; ///< of points in single precision, and the radii
  std::vector<std::vector<std::string>> words; ///< of each column of texts, by their indices
};

/// What the points of all chunks have lost.
RoundingLoss loss_of_points(const std::deque<DecodedChunk>& chunks, const FrameLayout& layout);

/// Decodes chunks of rows along the wires of a layout. One for each thread.
class ChunkDecoder
{
public:
  ChunkDecoder(FrameLayout& layout, const DumpRequest& request);

  /// Decodes the rows that a reader has opened, at most room of them, to chunk.row on. number is that
  /// of the first of them in the frame. ranges, of the frame of the layout, take the rows that stay
  /// into account. Throws Misfits; LimitError at where.
  void decode(RowReader& reader, std::int64_t number, std::int64_t room, const Where& where,
    DecodedChunk& chunk, FrameRanges& ranges);

private:
  void aim();
  std::size_t finish_batch(std::size_t count, std::int64_t number, RoundingLoss& loss);
  void copy_batch(std::size_t count);
  void narrow(std::size_t count, RoundingLoss& loss);
  void measure_radii(std::size_t count, RoundingLoss& loss) const;
  void convert(const PointsWire& wire, std::size_t count);
  void choose_rows(std::size_t count, std::int64_t number);
  void choose_by_number(std::size_t count, std::int64_t number);
  void compact(Block& block, std::size_t width, std::size_t count) const;

  FrameLayout& layout_;
  const DumpRequest& request_;
  std::unique_ptr<char[]> scratch_;
  std::vector<ColumnSink> sinks_;
  std::vector<char> keep_; ///< of a batch; empty: all rows stay
  std::int64_t row_ = 0;   ///< where the batch goes
};
}
#endif
