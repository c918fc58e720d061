// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_text_rows_h
#define granular_formats_dump_grammar_text_rows_h

#include "granular/formats/dump/grammar/frame_rows.h"
#include "granular/formats/dump/grammar/text_header.h"
#include "granular/text/text_scanner.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The rows of a frame of a text dump: the lines after its header.
class TextRows final : public FrameRows
{
public:
  TextRows(const ByteSource& source, const FrameEntry& entry);

  const FrameHeader& header() const noexcept override { return header_; }
  std::vector<int> digits() const override;
  std::unique_ptr<RowReader> reader() const override;
  void locate(Misfits& misfits) const override;

private:
  friend class TextReader;

  void read_header();
  void read_header(RowsOf rows_of);
  bool is_mended(const Misfit& misfit) const;
  Where where(const Misfit& misfit) const;
  std::string row_of(const Misfit& misfit) const;
  std::string name_of(const Misfit& misfit) const;

  const ByteSource& source_;
  FrameEntry entry_;
  FrameHeader header_;
  std::int64_t rows_offset_ = 0;
  std::int64_t rows_line_ = 0;
};

/// Reads whole lines that are in memory. A row belongs to the chunk that holds its first byte.
class TextReader final : public RowReader
{
public:
  explicit TextReader(const TextRows& of)
    : of_(of)
  {
  }

  void open(std::int64_t first, std::int64_t last) override;
  std::int64_t rows() const noexcept override;
  bool more() const noexcept override;
  std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows) override;
  RowCounts decode_chosen(
    std::span<ColumnSink> sinks, std::int64_t max_rows, const RowChoice& choice) override;

private:
  bool decode_numbers(
    std::span<ColumnSink> sinks, std::int64_t max_rows, const RowChoice& choice, RowCounts& counts);
  void load(std::int64_t from, std::int64_t to);
  std::size_t load_line(std::size_t at);
  void check_length(std::size_t first, std::size_t end) const;
  RowWords columns() const noexcept;
  void check(const char* first, const char* last, const RowResult& result,
    std::span<const ColumnSink> sinks) const;

  const TextRows& of_;
  PaddedBuffer buffer_;
  std::int64_t offset_ = 0; ///< of buffer_ in the content
  std::size_t filled_ = 0;  ///< bytes in buffer_
  std::size_t first_ = 0;   ///< of the rows
  std::size_t at_ = 0;      ///< next row
  std::size_t end_ = 0;     ///< of the rows
  RowMemory memory_;
  std::vector<std::int64_t> chosen_by_; ///< the integers of a choice
  bool many_chosen_ = false;            ///< of the last rows so many that decoding all is faster
};
}
#endif
