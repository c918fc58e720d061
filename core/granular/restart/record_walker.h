// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_record_walker_h
#define granular_restart_record_walker_h

#include "granular/common/progress.h"
#include "granular/restart/restart_bytes.h"
#include "granular/restart/restart_header.h"

#include <cstdint>
#include <optional>

namespace granular
{
/// What a search may cost, whatever a file is made of: it is over when this is used up.
struct SearchBudget
{
  std::int64_t steps = 0; ///< counts, strings and records that may still be looked at
  std::int64_t bytes = 0; ///< that may still be read from the file

  bool spent() const noexcept { return steps <= 0 || bytes <= 0; }
};

/// Goes from record to record, and looks whether each could be one of a particle.
class RecordWalker
{
public:
  /// in_box: positions must lie in the box, or no further away than it is long.
  RecordWalker(const ByteSource& source, bool swapped, const RestartHeader& header, bool in_box,
    Progress& progress);

  /// Walks the records of a chunk, which must end where the chunk does: each of a whole length, with a whole id of at least 0, a type of
  /// those that there are, and a whole mask. False if they do not, at() is then the record that is none; or when the budget is spent.
  bool walk(std::int64_t offset, std::int64_t doubles, SearchBudget& budget);

  /// In all chunks since the last reset.
  std::int64_t records() const noexcept { return records_; }
  std::int64_t at() const noexcept { return at_; }
  void reset() noexcept { records_ = 0; }

private:
  bool is_record(const char* record) const noexcept;
  bool near_box(const char* record) const noexcept;

  RestartBytes bytes_;
  const RestartHeader& header_;
  std::optional<BoxBounds> bounds_; ///< of where particles may be; none: anywhere
  Progress& progress_;
  std::int64_t records_ = 0;
  std::int64_t at_ = 0;
};
}
#endif
