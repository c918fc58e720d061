// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_find_chunks_h
#define granular_formats_restart_find_chunks_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/formats/restart/restart_bytes.h"
#include "granular/formats/restart/restart_layout.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace granular
{
/// Goes from record to record, and checks whether each could be a particle.
class RecordWalker
{
public:
  RecordWalker(const ByteSource& source, bool swapped, const RestartHeader& header,
    SearchBudget& budget, Progress& progress);

  /// Forgets the records. in_box: from now on positions must lie in the box, or at most one box length outside.
  void restart(bool in_box) noexcept
  {
    records_ = 0;
    blocks_.clear();
    in_box_ = in_box;
  }

  /// Walks the records of a chunk, which must end with the chunk. Each must have an integer length, an integer id of at
  /// least 0, an existing type, and an integer mask. Returns false if one does not, in which case at() is that record,
  /// or if the budget is spent.
  bool walk(std::int64_t offset, std::int64_t doubles);

  /// Returns the number of records in all chunks since the last restart.
  std::int64_t records() const noexcept { return records_; }

  /// Returns these records in blocks of about 1 MiB, of which none is in two chunks.
  const std::vector<RecordBlock>& blocks() const noexcept { return blocks_; }

  std::int64_t at() const noexcept { return at_; }

private:
  template <class Number>
  Number load(const char* record, std::size_t slot) const noexcept
  {
    return bytes_.load<Number>(record + slot * sizeof(Number));
  }

  bool is_record(const char* record) const noexcept;
  bool near_box(const char* record) const noexcept;

  RestartBytes bytes_;
  const RestartHeader& header_;
  SearchBudget& budget_;
  BoxBounds bounds_; ///< of where particles may be, if they must be near the box
  bool in_box_ = false;
  Progress& progress_;
  std::int64_t records_ = 0;
  std::vector<RecordBlock> blocks_;
  std::int64_t at_ = 0;
};

/// The result of a search for the particles.
struct ChunkSearch
{
  bool found = false;
  std::optional<std::int64_t>
    misfit;             ///< the most records of chunks that were right but for this number
  bool gave_up = false; ///< too many places looked like chunks
};

/// Finds the chunks of records of all processes behind a byte, and fills begin, chunks, blocks and records of a layout that has the
/// header. Chunks without records come first, if there are any, and then a count and the length of a record: only bytes that could be
/// such a pair are looked at further, and lead, chunk by chunk, to the end of the file or nowhere; the chunks without records before are
/// known by what is missing in number. With a time in the header (INL) and no such place: to as many records as the header says, which
/// lie near the box. Time and reading are limited by a budget of a few times the size of the file. The source must know its size. Throws
/// IoError, Cancelled.
ChunkSearch find_chunks(
  const ByteSource& source, std::int64_t begin, RestartLayout& layout, Progress& progress);
}
#endif
