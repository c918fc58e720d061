// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_find_fixes_h
#define granular_restart_find_fixes_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/restart/restart_layout.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// The known properties of fixes.
struct FixSearch
{
  bool found = false;
  std::int64_t global = 0; ///< number of fixes with a state of their own
  std::vector<RestartFix> fixes;
};

/// Finds what fixes have stored between two bytes: the first place from which it leads to `end` exactly. A fix with a state of
/// its own has an id, a style, a count of bytes and these; one that adds to records an id, a style and the doubles that it
/// may have in one. Throws IoError.
FixSearch find_fixes(
  const ByteSource& source, bool swapped, std::int64_t begin, std::int64_t end, Progress& progress);
}
#endif
