// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLookTogether_h
#define vtkGranularLookTogether_h

#include "granular/common/pass.h"
#include "granular/parallel/communicator.h"

namespace vtkGranularPrivate
{
/**
 * Lets rank 0 examine something for all ranks: look(packer) puts the findings into the packer there, and take(unpacker)
 * extracts them on all ranks. Throws on all ranks what one of them throws. Collective.
 */
template <typename Look, typename Take>
void LookTogether(granular::Communicator& ranks, const Look& look, const Take& take)
{
  granular::do_together(ranks,
    [&]
    {
      granular::ArchiveWriter packer;
      if (ranks.rank() == 0)
      {
        look(packer);
      }
      ranks.broadcast(packer.bytes, 0);
      granular::ArchiveReader unpacker{ packer.bytes };
      take(unpacker);
    });
}
}

#endif
