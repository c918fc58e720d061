// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_parallel_gather_h
#define granular_parallel_gather_h

#include "granular/common/pass.h"
#include "granular/parallel/communicator.h"

#include <cstddef>
#include <string>
#include <vector>

namespace granular
{
/// Returns the value of every rank, by rank, on all ranks. Collective; for small data. A value consists of plain numbers,
/// which are sent as in memory, or is known to pass(archive, thing).
template <typename Thing>
std::vector<Thing> gather(Communicator& ranks, const Thing& own)
{
  ArchiveWriter packer;
  pass_item(packer, own);
  const std::vector<std::string> all = ranks.all_gather(packer.bytes);
  std::vector<Thing> things(all.size());
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    ArchiveReader unpacker(all[rank]);
    pass_item(unpacker, things[rank]);
  }
  return things;
}
}
#endif
