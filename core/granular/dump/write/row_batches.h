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
/// The rows of one process as the bytes of a dump, some chunks at a time, which threads encode together.
/// Where chunks end depends on the rows alone. Needs some MiB, however many rows there are.
class RowBatches
{
public:
  RowBatches(const RowEncoder& encoder, const Executor& executor);

  /// Encodes all rows, and writes each chunk to a plain file as soon as that is done, by any thread, all in their order.
  void write_to(FileAppender& file, Progress& progress);

  /// Encodes the next batch. False behind the last. Reports how far the rows are.
  bool next(Progress& progress);

  /// The bytes of the batch, a chunk each. Valid until the next one.
  std::vector<std::string_view> bytes() const;

  /// The chunk that the next batch begins with; may be set to one that a batch began with before.
  std::size_t place() const noexcept { return place_; }
  void go_to(std::size_t place) noexcept { place_ = place; }

  /// What becomes of the rows so far when they are read.
  RoundingLoss loss() const;

private:
  void encode(std::size_t chunk, std::size_t worker, RowBuffer& to);

  const RowEncoder& encoder_;
  const Executor& executor_;
  std::int64_t chunk_rows_;
  std::size_t chunks_;
  std::size_t place_ = 0;
  std::size_t filled_ = 0;
  std::vector<std::int64_t>
    kept_before_; ///< rows before a chunk that are no duplicates; empty: all
  std::vector<RowBuffer> buffers_;
  std::vector<RowValues> values_;    ///< of each worker
  std::vector<RoundingLoss> losses_; ///< of each worker
};

/// Rows of the view that are written: all but duplicates.
std::int64_t count_kept(const FrameView& frame, std::int64_t first, std::int64_t end) noexcept;
}
#endif
