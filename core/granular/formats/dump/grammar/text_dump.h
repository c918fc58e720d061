// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_text_dump_h
#define granular_formats_dump_grammar_text_dump_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/formats/dump/grammar/text_header.h"
#include "granular/frames/file_index.h"
#include "granular/text/text_scanner.h"

#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Returns true if a file begins like a text dump of particles: after an optional byte order mark and blank lines,
/// ITEM: TIMESTEP, UNITS or TIME, and, if the bytes reach so far, ITEM: NUMBER OF ATOMS. Files of dump local count
/// ENTRIES or a word chosen by the user instead.
bool is_text_dump(std::string_view first_bytes);

/// Returns true if a file begins like a text of dump local: as is_text_dump, but the bytes must reach a count of
/// something other than atoms.
bool is_text_of_others(std::string_view first_bytes);

/// Returns true if a file begins like a text of dump grid: the bytes must reach ITEM: GRID SIZE.
bool is_text_of_cells(std::string_view first_bytes);

/// Returns true if the names in a header and the words of the first row make these columns. first_row is empty if there
/// are no rows.
bool makes_columns(const std::vector<std::string>& names,
  const std::vector<std::string_view>& first_row, const ColumnSchema& schema);

/// Indexes a text dump; see index_dump.
void index_text_dump(const ByteSource& source, FileIndex& index, Progress& progress,
  const ScanAhead& ahead = {}, RowsOf rows_of = RowsOf::Particles);

/// FileFormat::first_rows for rows that are no particles, and may be equal by chance: a hash of all first rows together.
std::vector<std::int64_t> hash_first_rows(const FileIndex& file, const FrameEntry& entry);
}
#endif
