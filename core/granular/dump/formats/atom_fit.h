// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_atom_fit_h
#define granular_dump_formats_atom_fit_h

#include "granular/bytes/byte_source.h"
#include "granular/dump/formats/binary_header.h"
#include "granular/dump/formats/unnamed_columns.h"
#include "granular/frames/file_index.h"

#include <vector>

namespace granular
{
/// Returns which coordinates lie in the box of a frame, if its columns are those of dump atom: scaled and absolute ones are
/// told apart by the first rows, at most 4096 of them. Four rows in five must lie in the box, or beside it by 2 % of
/// its length: particles leave it for a while. In a frame without rows, and in the unit box, where both are the same, the
/// coordinates count as scaled.
AtomFit fit_atom(const ByteSource& source, const BinaryHeader& header, const BinaryLayout& layout);

/// FileFormat::lacks and FileFormat::complete for frames of dump atom without names, whose rows do not tell the coordinates, or
/// that have none: they are named as the other frames of the run, if these agree.
bool lack_atom_names(const std::vector<FileIndex>& files);
void complete_atom_names(std::vector<FileIndex>& files, Notices& notices);
}
#endif
