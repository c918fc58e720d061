// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_first_rows_h
#define granular_dump_formats_first_rows_h

#include "granular/frames/file_format.h"
#include "granular/frames/frame.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// FileFormat::first_rows for particles: the ids, if there are any.
std::vector<std::int64_t> find_first_ids(const FileIndex& file, const FrameEntry& entry);

/// FileFormat::first_rows for other rows, which may be equal by chance: a hash of all first rows together.
std::vector<std::int64_t> hash_first_rows(const FileIndex& file, const FrameEntry& entry);
}
#endif
