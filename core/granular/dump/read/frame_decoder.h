// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_read_frame_decoder_h
#define granular_dump_read_frame_decoder_h

#include "granular/dump/formats/frame_rows.h"
#include "granular/dump/read/chunk_decoder.h"
#include "granular/dump/read/frame_chunks.h"
#include "granular/dump/read/frame_layout.h"
#include "granular/parallel/executor.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace granular
{
/// Decodes a part of a frame, chunk by chunk, on several threads.
///
/// Any free thread reads the next chunk, of compressed files in order. It counts the rows of the chunk and thus knows the
/// position of the next one's first row. From then on no thread waits for another.
class FrameDecoder
{
public:
  FrameDecoder(const FramePieces& pieces, const ColumnSchema& schema, const DumpRequest& request);

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
  void go_to(Worker& worker, std::size_t piece);
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
  void note_surplus();
  void join_words();

  const FramePieces& pieces_;
  const ColumnSchema& schema_;
  const DumpRequest& request_;
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
