// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/frame_rows.h"

#include "granular/formats/dump/grammar/binary_dump.h"
#include "granular/formats/dump/grammar/text_rows.h"

#include <algorithm>

namespace granular
{
std::int64_t extent_of(const FrameEntry& entry) noexcept
{
  return entry.kind->is_text() ? entry.end - entry.offset : entry.rows;
}

std::int64_t chunk_extent(const FrameEntry& entry, std::size_t bytes) noexcept
{
  const std::size_t unit =
    entry.kind->is_text() ? 1 : entry.kind->schema.columns().size() * sizeof(double);
  return static_cast<std::int64_t>(
    std::max(std::size_t{ 1 }, bytes / std::max<std::size_t>(unit, 1)));
}

std::unique_ptr<FrameRows> open_rows(const ByteSource& source, const FrameEntry& entry)
{
  if (entry.kind->is_text())
  {
    return std::make_unique<TextRows>(source, entry);
  }
  return open_binary_rows(source, entry);
}
}
