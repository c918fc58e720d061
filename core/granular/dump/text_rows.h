// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_text_rows_h
#define granular_dump_text_rows_h

#include "granular/dump/frame_rows.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The rows of a frame of a text dump: the lines behind its header.
class TextRows final : public FrameRows
{
public:
  TextRows(const ByteSource& source, const FrameEntry& entry);

  const FrameHeader& header() const noexcept override { return header_; }
  std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows) override;
  std::optional<Misfit> misfit() const override;
  double fraction() const noexcept override;
  void note(Notices& notices) const override;

private:
  std::vector<std::string> read_header();
  bool fill();
  bool is_misfit() const;
  void check_count(std::int64_t rows) const;
  std::string_view word() const;
  Where where() const;
  [[noreturn]] void fail() const;

  const ByteSource& source_;
  FrameEntry entry_;
  FrameHeader header_;
  std::int64_t rows_offset_ = 0;
  std::int64_t rows_line_ = 0;
  PaddedBuffer buffer_;
  std::size_t at_ = 0;             ///< next row in buffer_
  std::size_t lines_end_ = 0;      ///< end of the last whole line in buffer_
  std::size_t end_ = 0;            ///< bytes in buffer_
  std::int64_t buffer_offset_ = 0; ///< of buffer_ in the file
  std::int64_t rows_ = 0;
  RowResult result_{ nullptr };
  bool surplus_ = false; ///< a row had more words than the header names columns
};
}
#endif
