// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_find_chunks_h
#define granular_restart_find_chunks_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/restart/restart_header.h"
#include "granular/restart/restart_layout.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace granular
{
/// The result of a search for the particles.
struct ChunkSearch
{
  bool found = false;
  std::int64_t begin = 0; ///< byte of the count of the first chunk
  std::vector<RestartChunk> chunks;
  std::optional<std::int64_t>
    misfit;             ///< the most records of chunks that were right but for this number
  bool gave_up = false; ///< too many places looked like chunks
};

/// Finds the chunks of records of all processes behind a byte. They begin with those without records, if any, and then with a count
/// and the length of a record: only bytes that could be such a pair are looked at further, and lead, chunk by chunk, to the end of the
/// file or nowhere; the chunks without records before are known by what is missing in number. With a time in the header (INL) and no
/// such place: to as many records as the header says, which lie near the box. Time and reading are limited by a budget of a few times
/// the size of the file. The source must know its size. Throws IoError, Cancelled.
ChunkSearch find_chunks(const ByteSource& source, bool swapped, const RestartHeader& header,
  std::int64_t begin, Progress& progress);
}
#endif
