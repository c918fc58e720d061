// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_text_rows_h
#define granular_dump_formats_text_rows_h

#include "granular/dump/formats/frame_rows.h"
#include "granular/text/text_scanner.h"

#include <cstddef>
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

  std::vector<std::string> read_header();
  std::vector<std::string_view> first_row(TextScanner& scanner) const;
  bool is_mended(const Misfit& misfit) const;
  Where where(const Misfit& misfit) const;
  std::string name_of(const Misfit& misfit) const;

  const ByteSource& source_;
  FrameEntry entry_;
  FrameHeader header_;
  std::int64_t rows_offset_ = 0;
  std::int64_t rows_line_ = 0;
};
}
#endif
