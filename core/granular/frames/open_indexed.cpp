// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source_segments.h"
#include "granular/frames/file_index.h"

#include <string>
#include <utility>

namespace granular
{
namespace
{
/// Throws if the file is no longer the one that was indexed.
std::unique_ptr<ByteSource> open_packed(const FileIndex& index)
{
  std::unique_ptr<ByteSource> packed = open_file(index.path);
  const FileStamp now = packed->stamp();
  if (now.size < index.stamp.size)
  {
    throw IoError("the file was shortened since it was indexed: expected at least " +
        std::to_string(index.stamp.size) + " bytes, got " + std::to_string(now.size) +
        "; reload the files",
      { index.path });
  }
  if (!(now == index.stamp) && hash_ends(*packed, index.stamp.size) != index.ends_hash)
  {
    throw IoError("the file changed since it was indexed; reload the files", { index.path });
  }
  return packed;
}
}

std::unique_ptr<ByteSource> open_indexed(const FileIndex& index)
{
  return unpack_known(open_packed(index), index.points);
}

std::unique_ptr<ByteSource> open_indexed(
  const FileIndex& index, const FrameEntry& entry, int threads)
{
  std::unique_ptr<ByteSource> packed = open_packed(index);
  if (!index.points)
  {
    return unpack_known(std::move(packed), std::make_shared<const SeekPoints>());
  }
  std::unique_ptr<ByteSource> source =
    unpack_segments(packed, *index.points, entry.offset, entry.end, threads);
  return source ? std::move(source) : unpack_known(std::move(packed), index.points);
}
}
