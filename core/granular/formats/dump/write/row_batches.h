// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_write_row_batches_h
#define granular_formats_dump_write_row_batches_h

#include "granular/bytes/byte_sink.h"
#include "granular/bytes/compression.h"
#include "granular/common/progress.h"
#include "granular/formats/dump/write/column_plan.h"
#include "granular/formats/dump/write/dump_format.h"
#include "granular/formats/dump/write/encode_header.h"
#include "granular/formats/dump/write/row_values.h"
#include "granular/parallel/executor.h"
#include "granular/particles/rounding_loss.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace granular
{
/// Measures the loss that the digits of a text dump cause. A column costs a comparison per value; if the printed digits may
/// be too few for its largest values, these are printed and read back.
class PrintLoss
{
public:
  /// Measures nothing.
  PrintLoss() = default;

  PrintLoss(
    const ColumnPlan& plan, const Box& box, const DumpFormat& format, double smallest_radius);

  /// Returns the format of the box: all digits for LAMMPS, six for LIGGGHTS. LIGGGHTS also gets all digits if six would move
  /// the corners by a tenth of the limit; any reader of dumps reads any number.
  NumberFormat of_box() const noexcept { return of_box_; }

  /// Rows of the frame.
  void measure(const RowValues& values, RoundingLoss& loss) const;

private:
  /// A column whose numbers may lose too much.
  struct Column
  {
    std::size_t index;
    double safe;   ///< no value up to this one does
    bool place;    ///< coordinates
    Vector3 unit;  ///< length of 1 in the column along the axes
    Vector3 moved; ///< by the digits of the box that scales it
  };

  NumberFormat of_box_ = { 6 };
  NumberFormat numbers_ = {};
  std::vector<Column> columns_;
};

/// Adds a notice about the loss in the rows of all ranks if it exceeds the limits. Returns true if it does.
bool note_print_loss(const RoundingLoss& loss, const Box& box, const DumpFormat& format,
  const ColumnPlan& plan, Notices& notices);

/// Writes bytes one after the other, compressed or not, on several threads. The result depends only on the bytes and on where
/// parts end.
class FileAppender
{
public:
  FileAppender(OutputFile& file, Compression compression, const Executor& executor)
    : file_(file)
    , compression_(compression)
    , executor_(executor)
  {
  }

  void append(std::string_view bytes);

  /// Returns true if bytes go into the file unchanged: then any thread may also write them to the position that take gives.
  bool is_plain() const noexcept { return compression_ == Compression::None; }
  std::int64_t take(std::size_t bytes) noexcept
  {
    return std::exchange(size_, size_ + static_cast<std::int64_t>(bytes));
  }
  void write_at(std::int64_t offset, std::string_view bytes) { file_.write_at(offset, bytes); }

  /// Ends a part of the file, so that a reader may begin after it: a new member begins there.
  void end_part();

private:
  OutputFile& file_;
  Compression compression_;
  const Executor& executor_;
  std::string pending_; ///< not compressed yet: at most a member for each thread
  std::int64_t size_ = 0;
};

/// Bytes of rows being written. The memory grows and stays, so that no byte of it is cleared twice.
class RowBuffer
{
public:
  /// Makes room for more bytes. They count once add() is called.
  char* room(std::size_t bytes)
  {
    if (bytes > memory_.size() - size_)
    {
      memory_.resize(std::max(size_ + bytes, memory_.size() + memory_.size() / 2));
    }
    return memory_.data() + size_;
  }

  void add(std::size_t bytes) noexcept { size_ += bytes; }
  void clear() noexcept { size_ = 0; }
  std::string_view bytes() const noexcept { return { memory_.data(), size_ }; }

private:
  std::vector<char> memory_;
  std::size_t size_ = 0;
};

/// Rows of a frame that become the bytes of a dump.
struct RowsToEncode
{
  const FrameView& frame;
  const ColumnPlan& plan;
  const Box& box;
  const DumpFormat& format;
  const ChunkLengths& chunks;
  std::int64_t first_row;     ///< which of all rows of the frame is the first of this process
  std::int64_t first_in_file; ///< which of those in its file
  PrintLoss print_loss = {};
};

/// The rows of one rank as the bytes of a dump, without duplicates, several chunks at a time, which threads encode together.
/// The ends of chunks depend only on the rows. Needs some MiB for any number of rows. Throws LimitError, FormatError.
class RowBatches
{
public:
  RowBatches(const RowsToEncode& rows, const Executor& executor);

  /// Encodes all rows. Any thread writes each chunk to a plain file as soon as it is done, in order.
  void write_to(FileAppender& file, Progress& progress);

  /// Encodes the next batch. Returns false after the last. Reports the progress of the rows.
  bool next(Progress& progress);

  /// Returns the bytes of the batch, one string per chunk. Valid until the next batch.
  std::vector<std::string_view> bytes() const;

  /// Makes the next batch begin with a chunk.
  void go_to(std::size_t chunk) noexcept { place_ = chunk; }

  /// Returns the loss in the rows so far.
  RoundingLoss loss() const;

private:
  void encode(std::size_t chunk, std::size_t worker, RowBuffer& to);
  void encode_binary(const RowValues& values, std::int64_t in_file, RowBuffer& to) const;

  const RowsToEncode& of_;
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
