// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_bond_frame_h
#define granular_restart_bond_frame_h

#include "granular/restart/collect_bonds.h"
#include "granular/restart/restart_reader.h"

#include <cstdint>

namespace granular
{
/// The collected bonds of which the first particle is in rows from first to end, as lines of a frame whose header is there. Uses up the
/// collector.
void make_bond_frame(BondCollector& bonds, const RestartLayout& layout,
  const RestartRequest& request, std::int64_t first, std::int64_t end, const Where& where,
  LocalFrame& local, Notices& notices, Progress& progress);
}
#endif
