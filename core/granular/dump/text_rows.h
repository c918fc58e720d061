// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_text_rows_h
#define granular_dump_text_rows_h

#include "granular/base/byte_source.h"
#include "granular/base/error.h"
#include "granular/base/row_text.h"
#include "granular/dump/frame_index.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace granular
{
/// The rows of a frame, read in order through one buffer of constant size.
class TextRows
{
public:
  TextRows(const ByteSource& source, const FrameEntry& entry);

  /// Decodes the next rows, at most max_rows, into the sinks. Returns how many; 0 at the end.
  /// A word that does not fit the type of its column, where another type would do, makes misfit()
  /// true for the caller to deal with; all other errors, and a frame with other than entry.rows rows,
  /// throw FormatError. Texts stay valid until the next call.
  std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows);

  const RowResult& result() const noexcept { return result_; }

  /// Whether result() is about a number that an integer column cannot hold, or a word in a column
  /// that the table does not know.
  bool misfit() const;

  /// Whether a row had more words than the header names columns.
  bool surplus() const noexcept { return surplus_; }

  /// How much of the frame has been decoded, 0 to 1.
  double fraction() const noexcept;

  /// The word that result() points at, and its place.
  std::string_view word() const;
  Where where() const;

private:
  bool fill();
  void check_count(std::int64_t rows) const;
  [[noreturn]] void fail() const;

  const ByteSource& source_;
  const FrameEntry& entry_;
  PaddedBuffer buffer_;
  std::size_t at_ = 0;         ///< next row in buffer_
  std::size_t lines_end_ = 0;  ///< end of the last whole line in buffer_
  std::size_t end_ = 0;        ///< bytes in buffer_
  std::int64_t buffer_offset_; ///< of buffer_ in the file
  std::int64_t rows_ = 0;
  RowResult result_{ nullptr };
  bool surplus_ = false;
};
}
#endif
