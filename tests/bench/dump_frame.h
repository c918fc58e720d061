// SPDX-License-Identifier: BSD-3-Clause
// What the parts do with files of dumps: index them, read their frames, see whether these are right.
#ifndef tests_bench_dump_frame_h
#define tests_bench_dump_frame_h

#include "dump_text.h"

#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"
#include "granular/frames/run_index.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench
{
/// The index of a run. Throws where there is anything to notice.
granular::RunIndex index_of(const std::vector<std::string>& files);

/// A frame of it: double points and all arrays unless the request is for others. Throws where there is
/// anything to notice.
granular::DumpFrame read_frame(
  const granular::RunIndex& index, std::size_t frame, const granular::DumpRequest& request = {});

/// A text file of one frame with its index, and what must come out.
struct TextFrame
{
  /// The file repeats the rows where there are more than most_distinct_rows.
  TextFrame(Form form, std::int64_t row_count);

  static constexpr std::int64_t most_distinct_rows = 1'000'000;

  Rows rows;
  Output truth; ///< of rows
  TemporaryFile file;
  std::int64_t count; ///< of the rows in the file
  granular::RunIndex index;
};

/// Returns true if a frame holds the values of the first truth_rows rows of truth, over and over. The box is
/// that of 0 and 1, so that scaled coordinates are absolute ones. Points are its third array.
bool holds(const granular::DumpFrame& frame, const Output& truth, std::int64_t truth_rows);

/// Returns true if a part of a frame holds the values of truth from a row on. Points are its third array.
bool holds_from(const granular::DumpFrame& frame, const Output& truth, std::int64_t first_row);
}
#endif
