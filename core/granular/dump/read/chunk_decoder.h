// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_read_chunk_decoder_h
#define granular_dump_read_chunk_decoder_h

#include "granular/dump/formats/frame_rows.h"
#include "granular/dump/read/frame_layout.h"
#include "granular/particles/dump_frame.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace granular
{
/// The result of a chunk of rows.
struct DecodedChunk
{
  std::int64_t row = 0;  ///< row of the frame in memory where its first row went
  std::int64_t rows = 0; ///< decoded
  std::int64_t kept = 0; ///< by the filters
  bool surplus = false;  ///< see RowReader::surplus
  Vector3 moved = {};    ///< by single precision: the largest movement of points along each axis
  std::vector<std::vector<std::string>> words; ///< of each column of texts, by their indices
};

/// Decodes chunks of rows into a layout. One for each thread.
class ChunkDecoder
{
public:
  ChunkDecoder(FrameLayout& layout, const DumpRequest& request);

  /// Decodes the rows that a reader has opened, at most `room` of them, from chunk.row on. `number` is the number of the
  /// first one in the frame. `ranges`, of the frame of the layout, includes the rows that stay. Throws Misfits; LimitError at
  /// `where`.
  void decode(RowReader& reader, std::int64_t number, std::int64_t room, const Where& where,
    DecodedChunk& chunk, FrameRanges& ranges);

private:
  void aim();
  std::size_t finish_batch(std::size_t count, std::int64_t number, Vector3& moved);
  void copy_batch(std::size_t count);
  void narrow(std::size_t count, Vector3& moved);
  void convert(const PointsWire& wire, std::size_t count);
  void choose_rows(std::size_t count, std::int64_t number);
  RowCounts decode_batch(RowReader& reader, std::int64_t wanted);
  void choose_by_id(std::size_t count, std::int64_t number);
  void compact(Block& block, std::size_t width) const;

  FrameLayout& layout_;
  const DumpRequest& request_;
  std::unique_ptr<char[]> scratch_;
  std::vector<ColumnSink> sinks_;
  std::vector<char> keep_;          ///< of a batch; empty: all rows stay
  std::vector<std::uint32_t> kept_; ///< those that stay
  RowChoice choice_;                ///< by integer ids, if `passes` is not empty
  std::int64_t row_ = 0;            ///< where the batch goes
};
}
#endif
