// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_binary_rows_h
#define granular_formats_dump_grammar_binary_rows_h

#include "granular/formats/dump/grammar/frame_rows.h"

#include <cstddef>
#include <mutex>
#include <vector>

namespace granular
{
/// The rows of a frame of a binary dump: the chunks of the ranks, one after the other, as doubles, row-major. Values are
/// narrowed to the column's type if that is exact; others are an error.
class BinaryRows final : public FrameRows
{
public:
  BinaryRows(const ByteSource& source, const FrameEntry& entry);

  const FrameHeader& header() const noexcept override { return header_; }
  std::unique_ptr<RowReader> reader() const override;
  void locate(Misfits& misfits) const override;

private:
  friend class BinaryReader;

  /// The rows of one rank, after their number.
  struct Run
  {
    std::int64_t first; ///< row
    std::int64_t rows;
    std::int64_t offset; ///< of the first row
  };

  Run find_run(std::int64_t row) const;
  Run next_run(const Run& run, std::int32_t values) const;
  std::int32_t load_values(const char* from) const noexcept;
  void keep_runs(const std::vector<Run>& runs) const;
  void check_place(std::int64_t at) const;
  [[noreturn]] void fail_short(std::int64_t end) const;

  std::int64_t behind(const Run& run) const noexcept { return run.offset + run.rows * row_bytes_; }

  const ByteSource& source_;
  FrameEntry entry_;
  FrameHeader header_;
  bool swapped_;
  std::int64_t row_bytes_ = 0;
  mutable std::mutex mutex_;
  mutable std::vector<Run>
    runs_; ///< those that were met, with rows; first the empty one before all
};

/// Some rows, all in memory.
class BinaryReader final : public RowReader
{
public:
  explicit BinaryReader(const BinaryRows& of)
    : of_(of)
  {
  }

  void open(std::int64_t first, std::int64_t last) override;
  std::int64_t rows() const noexcept override { return rows_; }
  bool more() const noexcept override { return decoded_ < rows_; }
  std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows) override;

private:
  void fill(std::int64_t end);
  const char* convert_column(const char* row, std::size_t rows, ColumnSink& sink) const noexcept;
  void convert(std::span<ColumnSink> sinks, const char* from, std::size_t rows) const;
  [[noreturn]] void fail(
    std::span<const ColumnSink> sinks, const char* from, std::size_t rows) const;
  Misfit misfit_of(const ColumnSink& sink, const char* value) const;

  const BinaryRows& of_;
  std::vector<BinaryRows::Run> runs_; ///< their rows, all or some of them
  std::size_t run_ = 0;               ///< of the next row
  std::int64_t in_run_ = 0;           ///< its rows that were decoded
  PaddedBuffer buffer_;
  std::size_t filled_ = 0;
  std::int64_t offset_ = 0; ///< of buffer_ in the content
  std::int64_t rows_ = 0;
  std::int64_t decoded_ = 0;
};
}
#endif
