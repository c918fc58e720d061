// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_row_batches_h
#define granular_dump_write_row_batches_h

#include "granular/common/progress.h"
#include "granular/dump/write/file_appender.h"
#include "granular/dump/write/row_encoder.h"
#include "granular/parallel/executor.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace granular
{
/// The rows of one rank as the bytes of a dump, several chunks at a time, which threads encode together. The ends of chunks
/// depend only on the rows. Needs some MiB for any number of rows.
class RowBatches
{
public:
  RowBatches(const RowEncoder& encoder, const Executor& executor);

  /// Encodes all rows. Any thread writes each chunk to a plain file as soon as it is done, in order.
  void write_to(FileAppender& file, Progress& progress);

  /// Encodes the next batch. Returns false after the last. Reports the progress of the rows.
  bool next(Progress& progress);

  /// Returns the bytes of the batch, one string per chunk. Valid until the next batch.
  std::vector<std::string_view> bytes() const;

  /// The first chunk of the next batch; may be set to the first chunk of an earlier batch.
  std::size_t place() const noexcept { return place_; }
  void go_to(std::size_t place) noexcept { place_ = place; }

  /// Returns the loss in the rows so far.
  RoundingLoss loss() const;

private:
  void encode(std::size_t chunk, std::size_t worker, RowBuffer& to);

  const RowEncoder& encoder_;
  const Executor& executor_;
  std::int64_t chunk_rows_;
  std::size_t chunks_;
  std::size_t place_ = 0;
  std::size_t filled_ = 0;
  std::vector<std::int64_t> kept_before_; ///< rows before a chunk, without duplicates; empty: all
  std::vector<RowBuffer> buffers_;
  std::vector<RowValues> values_;    ///< of each worker
  std::vector<RoundingLoss> losses_; ///< of each worker
};

/// Returns the rows of the view that are written: all but duplicates.
std::int64_t count_kept(const FrameView& frame, std::int64_t first, std::int64_t end) noexcept;
}
#endif
