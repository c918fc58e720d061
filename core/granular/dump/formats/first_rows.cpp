// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/formats/first_rows.h"

#include "granular/common/hash.h"
#include "granular/dump/formats/frame_rows.h"
#include "granular/frames/file_index.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <string>

namespace granular
{
namespace
{
constexpr std::int64_t most_bytes = std::int64_t{ 1 } << 18;
}

std::vector<std::int64_t> find_first_ids(const FileIndex& file, const FrameEntry& entry)
{
  constexpr std::int64_t most = 20'000;
  const int column = entry.kind->schema.find(ColumnRole::Id);
  if (column < 0)
  {
    return {};
  }
  std::vector<std::int64_t> ids(most);
  std::int64_t count = 0;
  ColumnSink sink = { static_cast<std::uint32_t>(column), ValueType::Int64,
    reinterpret_cast<char*>(ids.data()), sizeof ids[0] };
  try
  {
    const std::unique_ptr<ByteSource> source = open_indexed(file);
    const std::unique_ptr<FrameRows> rows = open_rows(*source, entry);
    const std::unique_ptr<RowReader> reader = rows->reader();
    const std::int64_t step = chunk_extent(entry, most_bytes);
    for (std::int64_t at = 0; at < extent_of(entry) && count < most; at += step)
    {
      reader->open(at, std::min(at + step, extent_of(entry)));
      count += reader->decode({ &sink, 1 }, most - count);
    }
  }
  catch (const Misfits&)
  {
  }
  ids.resize(static_cast<std::size_t>(count));
  return ids;
}

std::vector<std::int64_t> hash_first_rows(const FileIndex& file, const FrameEntry& entry)
{
  std::string bytes(static_cast<std::size_t>(std::min(entry.end - entry.offset, most_bytes)), ' ');
  bytes.resize(open_indexed(file)->read(entry.offset, bytes.data(), bytes.size()));
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return { std::bit_cast<std::int64_t>(hash.value()) };
}
}
