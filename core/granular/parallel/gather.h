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
/// Returns the thing of every rank, by rank, on all ranks. Collective; meant for what is small. A thing is of plain numbers, which
/// are sent as they are in memory, or one that pass(archive, thing) knows.
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
