// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_bond_frame_h
#define granular_restart_bond_frame_h

#include "granular/restart/collect_bonds.h"
#include "granular/restart/restart_reader.h"

#include <cstdint>

namespace granular
{
/// Makes the lines of a frame, whose header is set, from the collected bonds whose first particle is in rows from first
/// to end. Empties the collector.
void make_bond_frame(BondCollector& bonds, const RestartLayout& layout,
  const RestartRequest& request, std::int64_t first, std::int64_t end, const Where& where,
  LocalFrame& local, Notices& notices, Progress& progress);
}
#endif
