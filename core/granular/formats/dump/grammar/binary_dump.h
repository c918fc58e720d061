// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_binary_dump_h
#define granular_formats_dump_grammar_binary_dump_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/formats/dump/grammar/binary_header.h"
#include "granular/formats/dump/grammar/frame_rows.h"
#include "granular/frames/file_index.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace granular
{
/// Returns true if the first bytes of a file are those of a binary dump in one of binary_layouts().
bool is_binary_dump(std::string_view first_bytes);

/// Returns true if the first bytes are not text.
bool holds_binary(std::string_view first_bytes) noexcept;

/// Returns "; its first row is ...": the values of the first row from the frame at offset on, for a user who has to name the
/// columns. Empty if there is none.
std::string describe_first_row(
  const ByteSource& source, std::int64_t offset, const BinaryLayout& layout);

/// Indexes a binary file: see index_dump. Skips the values from chunk to chunk.
///
/// Files without magic, and those of revision 1, do not name their columns; index.column_names must name all of them. If it
/// is empty, frames of 5 or 8 columns are taken for dump atom, and the box tells which coordinates they hold: see fit_atom.
/// Others, and those where it does not tell, cannot be read. A frame that contradicts its header is left out, with all that follow.
void index_binary_dump(const ByteSource& source, FileIndex& index, Progress& progress);

/// open_rows for a frame of a binary dump.
std::unique_ptr<FrameRows> open_binary_rows(const ByteSource& source, const FrameEntry& entry);
}
#endif
