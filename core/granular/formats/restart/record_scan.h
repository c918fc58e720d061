// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_record_scan_h
#define granular_formats_restart_record_scan_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/formats/restart/restart_layout.h"
#include "granular/parallel/executor.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// A part of the records of a rank that a thread reads at a time.
struct RecordBlock
{
  std::size_t chunk = 0;
  std::int64_t first = 0; ///< double of the chunk
  std::int64_t last = 0;  ///< the records that begin before it
};

/// The records that begin in a block, in order.
struct RecordBatch
{
  const double* data = nullptr;
  std::span<const std::size_t> starts; ///< of each in data, and the end of the last
  std::int64_t first_row = 0;          ///< from 0, in all chunks
  const std::string* path = nullptr;
  std::int64_t byte = 0; ///< of data

  std::size_t size() const noexcept { return starts.size() - 1; }

  std::span<const double> record(std::size_t i) const noexcept
  {
    return { data + starts[i], starts[i + 1] - starts[i] };
  }
};

/// Throws FormatError with the place of a record: its number from 1, its particle if known, and its byte.
[[noreturn]] void refuse_record(const RecordBatch& batch, std::size_t i, const std::string& text);

/// Passes over the records of a restart file once, on several threads. Each thread reads a block, learns from the block
/// before where the first record begins, and follows the lengths in turn; then it examines the records while other
/// threads continue.
class RecordScan
{
public:
  static constexpr std::int64_t block_doubles = std::int64_t{ 1 } << 17;

  /// Throws FormatError if the chunks have no room for this many records.
  RecordScan(const ByteSource& source, const RestartLayout& layout,
    std::int64_t doubles_a_block = block_doubles);

  std::size_t blocks() const noexcept { return blocks_.size(); }

  /// Receives some records. block: their block's number, below blocks(). worker: the number of the thread; see
  /// Executor.
  using Visit =
    std::function<void(std::size_t worker, std::size_t block, const RecordBatch& batch)>;

  /// Visits the blocks up to the one that contains the end of the records before end_row. Throws FormatError for
  /// lengths of records, and exceptions of visit, those of the first block first; IoError; Cancelled. Later blocks are
  /// not read, except one per other thread.
  void run(const Executor& executor, std::int64_t end_row, const Visit& visit, Progress& progress);

  /// Stops the run; no further blocks are read. For a visit that has seen enough.
  void stop() noexcept { stopped_ = true; }

private:
  /// The buffer of a thread.
  struct Buffer
  {
    std::unique_ptr<double[]> doubles;
    std::size_t capacity = 0;
    std::vector<std::size_t> starts;
    std::unique_ptr<ByteSource> file; ///< of `path`
    std::string path;

    void reserve(std::size_t count, std::size_t kept);
  };

  void do_block(std::size_t number, std::size_t worker, const Visit& visit);
  bool read_block(std::size_t number, Buffer& buffer, Turn& turn, RecordBatch& batch);
  const ByteSource& open(const RecordBlock& block, Buffer& buffer) const;
  void read(const ByteSource& source, const RecordBlock& block, std::int64_t first,
    std::int64_t last, double* to) const;
  void hop(std::size_t number, RecordBatch& batch, Buffer& buffer);

  const ByteSource& source_;
  const RestartLayout& layout_;
  std::vector<RecordBlock> blocks_;
  std::vector<Buffer> buffers_; ///< of each worker
  Turns turns_;
  std::atomic<bool> stopped_ = false; ///< what is not read yet nobody needs
  std::size_t hopped_ = 0; ///< blocks; those behind one that failed, or was the last, never are
  std::int64_t next_ = 0;  ///< double of the chunk at which the next record begins
  std::int64_t row_ = 0;   ///< of the next record
  std::int64_t end_row_ = 0;
};
}
#endif
