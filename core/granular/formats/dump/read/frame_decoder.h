// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_read_frame_decoder_h
#define granular_formats_dump_read_frame_decoder_h

#include "granular/formats/dump/grammar/frame_rows.h"
#include "granular/formats/dump/read/dump_reader.h"
#include "granular/formats/dump/read/frame_chunks.h"
#include "granular/formats/dump/read/frame_layout.h"
#include "granular/parallel/executor.h"
#include "granular/particles/table.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
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
  Vector3 moved = {};    ///< by single precision: the largest movement of points along each axis
  std::vector<std::vector<std::string>> words; ///< of each column of texts, by their indices
};

/// Decodes chunks of rows into a layout. One for each thread.
class ChunkDecoder
{
public:
  ChunkDecoder(FrameLayout& layout, const Request& request);

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
  const Request& request_;
  std::unique_ptr<char[]> scratch_;
  std::vector<ColumnSink> sinks_;
  std::vector<char> keep_;          ///< of a batch; empty: all rows stay
  std::vector<std::uint32_t> kept_; ///< those that stay
  RowChoice choice_;                ///< by integer ids, if `passes` is not empty
  std::int64_t row_ = 0;            ///< where the batch goes
};

/// Decodes a part of a frame, chunk by chunk, on several threads.
///
/// Any free thread reads the next chunk, of compressed files in order. It counts the rows of the chunk and thus knows the
/// position of the next one's first row. From then on no thread waits for another.
class FrameDecoder
{
public:
  FrameDecoder(const FramePieces& pieces, const ColumnSchema& schema, const Request& request);

  /// Decodes all rows, or up to a value that does not fit: then there are misfits, found with it, and no frame. The loss is the
  /// movement of points by single precision, along the axes of their coordinates.
  DumpPart run(Progress& progress);

private:
  /// An open piece.
  struct Source
  {
    std::shared_ptr<const ByteSource> bytes;
    std::unique_ptr<const FrameRows> rows;
  };

  /// The state of a thread.
  struct Worker
  {
    std::shared_ptr<const Source> source;
    std::size_t piece = 0;
    std::unique_ptr<RowReader> reader;
    std::unique_ptr<FrameLayout> aside; ///< memory of its own, where filters leave few rows
    std::unique_ptr<ChunkDecoder> decoder;
    std::optional<FrameRanges> ranges; ///< of the rows it has decoded
  };

  std::shared_ptr<const Source> open(std::size_t piece);
  void open_chunk(const PieceRows& range, Worker& worker, Turn& read);
  std::int64_t rows_before(Progress& progress);
  bool decode(std::int64_t room, Progress& progress);
  void decode_chunk(std::size_t chunk, Worker& worker);
  void decode_rows(std::size_t piece, std::int64_t number, std::int64_t most, Worker& worker,
    DecodedChunk& decoded);
  void decode_aside(std::size_t piece, std::int64_t number, std::int64_t rows, Worker& worker,
    DecodedChunk& decoded, Turn& turn);
  DecodedChunk& result_of(std::size_t chunk);
  void join_ranges(const std::vector<Worker>& workers);
  void count_rows();
  void check_counts(std::size_t pieces) const;
  void join_words();

  const FramePieces& pieces_;
  const ColumnSchema& schema_;
  const Request& request_;
  DumpPart part_;
  Executor executor_;
  std::vector<PieceRows> ranges_;
  ChunkCuts chunks_;
  Where where_; ///< of the first piece
  std::mutex mutex_;
  std::vector<std::weak_ptr<const Source>> sources_; ///< those that are open
  std::shared_ptr<const Source> first_;              ///< of the first piece
  FrameHeader header_;                               ///< its own, with the rows of all

  std::unique_ptr<FrameLayout> layout_;
  std::deque<DecodedChunk>
    decoded_;             ///< of the chunks that were begun; stays where it is as it grows
  bool filtered_ = false; ///< not all rows stay
  bool alone_ = true;     ///< one thread: it need not count rows before it has them
  Turns reads_;
  Turns places_;
  Turns kept_;
  std::int64_t next_row_ = 0;     ///< in memory
  std::int64_t next_number_ = 0;  ///< rows before, kept or not
  std::int64_t first_number_ = 0; ///< rows of the frame before this part
};
}
#endif
