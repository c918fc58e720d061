// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_binary_dump_h
#define granular_dump_formats_binary_dump_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/dump/formats/binary_header.h"
#include "granular/frames/file_index.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace granular
{
/// True if the first bytes of a file are those of a binary dump in one of binary_layouts().
bool is_binary_dump(std::string_view first_bytes);

/// True if the first bytes are no text, whatever else they are.
bool holds_binary(std::string_view first_bytes) noexcept;

/// "; its first row is ...": the values of the first row there is from the frame at offset on, for
/// somebody who is to name the columns. Empty if there is none.
std::string describe_first_row(
  const ByteSource& source, std::int64_t offset, const BinaryLayout& layout);

/// FileFormat::fits of a binary dump.
bool binary_dump_fits(const ByteSource& source, const FileIndex& index);

/// As index_dump, of a binary file. index.kinds must be there. Passes over the values from chunk to chunk.
///
/// Files without magic, and those of revision 1, do not name their columns: index.column_names does,
/// and must name all; where it is empty, frames of 5 or 8 columns are taken for those of dump atom
/// with its default of scaled coordinates, and others cannot be read. What is at fault is never passed over: a frame that is not
/// what its header says is left out, with all that follow.
void index_binary_dump(const ByteSource& source, FileIndex& index, Progress& progress);
}
#endif
