// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_first_rows_h
#define granular_dump_formats_first_rows_h

#include "granular/frames/file_format.h"
#include "granular/frames/frame.h"

namespace granular
{
/// FileFormat::first_rows of particles: the ids, where there are any.
FirstRows find_first_ids(const FileIndex& file, const FrameEntry& entry);

/// The same of rows of other things, which may be equal by chance: where a text has no ids, a hash of the words of each row.
FirstRows find_first_rows(const FileIndex& file, const FrameEntry& entry);
}
#endif
