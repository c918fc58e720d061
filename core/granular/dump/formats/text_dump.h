// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_text_dump_h
#define granular_dump_formats_text_dump_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/dump/formats/text_header.h"
#include "granular/frames/file_index.h"
#include "granular/text/text_scanner.h"

#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// True if the first bytes of a file are those of a text dump of particles: after an optional
/// byte order mark and blank lines an ITEM: TIMESTEP, UNITS or TIME, and, as far as the bytes
/// go, ITEM: NUMBER OF ATOMS (files of dump local count ENTRIES or a word of the user's).
bool is_text_dump(std::string_view first_bytes);

/// Whether the first bytes of a file are those of a text of dump local: as is_text_dump, but with something else than
/// atoms that is counted, within these bytes.
bool is_text_of_others(std::string_view first_bytes);

/// Whether the names in a header, and the words of the first row, which has none where there are no rows, make these columns.
bool makes_columns(const std::vector<std::string>& names,
  const std::vector<std::string_view>& first_row, const ColumnSchema& schema);

/// FileFormat::fits of a text.
bool text_dump_fits(const ByteSource& source, const FileIndex& index);

/// As index_dump, of a text. index.kinds must be there.
void index_text_dump(const ByteSource& source, FileIndex& index, Progress& progress,
  const ScanAhead& ahead = {}, RowsOf rows_of = RowsOf::Particles);
}
#endif
