// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_text_dump_h
#define granular_dump_text_dump_h

#include "granular/base/byte_source.h"
#include "granular/base/error.h"
#include "granular/base/progress.h"
#include "granular/dump/frame_index.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// True if the first bytes of a file are those of a text dump of particles: after an optional
/// byte order mark and blank lines an ITEM: TIMESTEP, UNITS or TIME, and, as far as the bytes
/// go, ITEM: NUMBER OF ATOMS (files of dump local count ENTRIES or a word of the user's).
bool is_text_dump(std::string_view first_bytes);

/// Frames of one text dump, found so far.
struct TextIndex
{
  std::vector<FrameEntry> frames;
  std::int64_t resume_offset = 0; ///< end of the last complete frame: where to go on
  std::int64_t resume_line = 1;
  std::string units; ///< of the last ITEM: UNITS; it is printed once a file
  Notices notices;   ///< frames that were left out, and why
  std::optional<Notice>
    defect; ///< what is wrong with the first frame that was left out, or missing
};

/// Goes on from index.resume_offset to the end of the source, passing over rows at scan speed.
/// A last frame that is not complete is left out, silently. A frame in the middle that is not
/// what its header says is left out with a notice. Throws IoError, LimitError, Cancelled.
void index_text_dump(const ByteSource& source, TextIndex& index, Progress& progress);

/// Makes sure that the frame is still where the index says. Throws IoError.
void check_unchanged(const ByteSource& source, const FrameEntry& entry);
}
#endif
