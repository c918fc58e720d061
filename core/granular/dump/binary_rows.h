// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_binary_rows_h
#define granular_dump_binary_rows_h

#include "granular/dump/frame_rows.h"

#include <cstddef>

namespace granular
{
/// The rows of a frame of a binary dump: chunks of doubles, row-major. Values are narrowed to the
/// column's type where that is exact; others are a misfit.
class BinaryRows final : public FrameRows
{
public:
  BinaryRows(const ByteSource& source, const FrameEntry& entry);

  const FrameHeader& header() const noexcept override { return header_; }
  std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows) override;
  std::optional<Misfit> misfit() const override { return misfit_; }
  double fraction() const noexcept override;

private:
  void fill(std::size_t bytes);
  void next_chunk();
  void convert(std::span<ColumnSink> sinks, std::int64_t rows);
  void set_misfit(const ColumnSink& sink, const char* value);

  const ByteSource& source_;
  FrameEntry entry_;
  FrameHeader header_;
  bool swapped_;
  std::size_t row_bytes_ = 0;
  std::unique_ptr<char[]> buffer_;
  std::size_t at_ = 0;           ///< next byte in buffer_
  std::size_t end_ = 0;          ///< bytes in buffer_
  std::int64_t next_offset_ = 0; ///< of the byte behind buffer_ in the file
  std::int64_t chunk_rows_ = 0;  ///< left of the chunk at hand
  std::int64_t rows_ = 0;        ///< decoded
  std::optional<Misfit> misfit_;
};
}
#endif
