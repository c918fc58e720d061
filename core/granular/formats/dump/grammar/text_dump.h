// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_text_dump_h
#define granular_formats_dump_grammar_text_dump_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/formats/dump/grammar/text_header.h"
#include "granular/frames/file_index.h"
#include "granular/text/text_scanner.h"

#include <cstddef>
#include <cstdint>
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

/// Returns the schema of a frame, from its names and its first row: a column that may hold words does if the first one is no
/// number. counted: the rows. Throws FormatError for a number of columns without names that no dump has.
ColumnSchema make_schema(std::vector<std::string> names,
  const std::vector<std::string_view>& first_row, const std::string& counted, const Where& where);

/// Returns true if make_schema would give that schema; false where rows have columns without names.
bool makes_schema(const std::vector<std::string>& names,
  const std::vector<std::string_view>& first_row, const ColumnSchema& schema);

/// Takes the words of the first row, if there is one. They stay until the scanner moves on.
bool take_first_row(TextScanner& scanner, std::int64_t rows, std::vector<std::string_view>& words);

/// Returns true if the names in a header and the words of the first row, which the scanner is at, make these columns.
bool makes_columns(const TextHeader& header, TextScanner& scanner, const ColumnSchema& schema);

/// Indexes a text dump; see index_dump.
void index_text_dump(const ByteSource& source, FileIndex& index, Progress& progress,
  const ScanAhead& ahead = {}, RowsOf rows_of = RowsOf::Particles);

/// Indexes a text of rows without headers (`dump_modify header no`), whose columns the user names. If each id comes again as
/// often as the others, and not before all have come, frames are told apart by that; else all rows are one frame. A notice says
/// so. Throws FormatError for another number of words than of names.
void index_bare_dump(const ByteSource& source, FileIndex& index);

/// FileFormat::first_rows for rows that are no particles, and may be equal by chance: a hash of all first rows together.
std::vector<std::int64_t> hash_first_rows(const FileIndex& file, const FrameEntry& entry);
}
#endif
