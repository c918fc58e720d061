// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_row_encoder_h
#define granular_dump_write_row_encoder_h

#include "granular/dump/write/column_plan.h"
#include "granular/dump/write/dump_format.h"
#include "granular/dump/write/encode_header.h"
#include "granular/dump/write/print_loss.h"
#include "granular/dump/write/row_buffer.h"
#include "granular/dump/write/row_values.h"

#include <cstdint>

namespace granular
{
/// Stores the values of rows [first, first + count) as the doubles of a binary dump, row by row. `to` has room for all, and
/// need not be aligned. Throws LimitError for integers that are not doubles.
void pack_rows(
  const RowValues& values, const ColumnPlan& plan, std::size_t first, std::size_t count, char* to);

/// Packs rows of a frame as the bytes of a dump. Several threads may share an encoder.
struct RowEncoder
{
  const FrameView& frame;
  const ColumnPlan& plan;
  const Box& box;
  const DumpFormat& format;
  const ChunkLengths& chunks;
  std::int64_t first_row;     ///< which of all rows of the frame is the first of this process
  std::int64_t first_in_file; ///< which of those in its file
  PrintLoss print_loss = {};

  /// Adds the rows of the view from first to first + count, without duplicates; kept_before is the number of earlier rows
  /// that are not duplicates. loss: of the rows. Throws LimitError, FormatError.
  void encode(std::int64_t first, std::int64_t count, std::int64_t kept_before, RowValues& values,
    RowBuffer& to, RoundingLoss& loss) const;

private:
  void encode_binary(const RowValues& values, std::int64_t in_file, RowBuffer& to) const;
};
}
#endif
