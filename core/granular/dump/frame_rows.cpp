// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/frame_rows.h"

#include "granular/dump/binary_rows.h"
#include "granular/dump/text_rows.h"

namespace granular
{
std::unique_ptr<FrameRows> open_rows(const ByteSource& source, const FrameEntry& entry)
{
  if (entry.kind->layout == FrameKind::text)
  {
    return std::make_unique<TextRows>(source, entry);
  }
  return std::make_unique<BinaryRows>(source, entry);
}
}
