// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_first_rows_h
#define granular_dump_formats_first_rows_h

#include "granular/frames/file_format.h"
#include "granular/frames/frame.h"

namespace granular
{
/// FileFormat::first_rows for particles: the ids, if there are any.
FirstRows find_first_ids(const FileIndex& file, const FrameEntry& entry);

/// FileFormat::first_rows for other rows, which may be equal by chance: for text without ids, a hash of the words of each
/// row.
FirstRows find_first_rows(const FileIndex& file, const FrameEntry& entry);
}
#endif
