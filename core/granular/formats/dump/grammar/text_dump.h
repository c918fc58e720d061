// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_text_dump_h
#define granular_formats_dump_grammar_text_dump_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/formats/dump/grammar/text_header.h"
#include "granular/frames/file_index.h"
#include "granular/text/text_scanner.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Returns the kind of rows of a text dump, as its first bytes tell it; Any if they do not reach that far. Returns nothing for
/// other files: a dump begins, after an optional byte order mark and blank lines, with ITEM: TIMESTEP, UNITS or TIME.
std::optional<RowsOf> tell_rows(std::string_view first_bytes);

/// Returns true if a file begins like a text dump of particles, or like one whose rows the bytes do not tell.
bool is_text_dump(std::string_view first_bytes);

/// Returns names for columns that are not named: column1, column2 and so on.
std::vector<std::string> numbered_columns(std::size_t count);

/// Returns true if the names in a header and the words of the first row, which the scanner is at, make these columns.
bool makes_columns(const TextHeader& header, TextScanner& scanner, const ColumnSchema& schema);

/// Indexes a text dump; see index_dump.
void index_text_dump(const ByteSource& source, FileIndex& index, Progress& progress,
  const ScanAhead& ahead = {}, RowsOf rows_of = RowsOf::Particles);

/// FileFormat::first_rows for rows that are no particles, and may be equal by chance: a hash of all first rows together.
std::vector<std::int64_t> hash_first_rows(const FileIndex& file, const FrameEntry& entry);
}
#endif
