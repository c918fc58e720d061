// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source_segments.h"
#include "granular/frames/file_index.h"
#include "granular/frames/index_claims.h"

#include <string>
#include <utility>

namespace granular
{
namespace
{
/// The contents of a file of which an index says that they end with its frame: who reads them finds out.
class ClaimedContent final : public ByteSource
{
public:
  ClaimedContent(std::unique_ptr<ByteSource> source, std::int64_t end)
    : source_(std::move(source))
    , end_(end)
  {
  }

  const std::string& path() const override { return source_->path(); }
  FileStamp stamp() const override { return source_->stamp(); }
  bool compressed() const override { return source_->compressed(); }
  std::string unchecked() const override { return source_->unchecked(); }
  double fraction(std::int64_t offset) const override { return source_->fraction(offset); }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    const std::size_t got = source_->read(offset, buffer, bytes);
    const std::int64_t to = offset + static_cast<std::int64_t>(got);
    char byte = 0;
    if (got > 0 && (to > end_ || (to == end_ && source_->read(end_, &byte, 1) > 0)))
    {
      throw FormatError("expected the end of the content where the index file says, got more; "
                        "remove the index file",
        { source_->path() });
    }
    return got;
  }

private:
  std::unique_ptr<ByteSource> source_;
  std::int64_t end_;
};

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

std::unique_ptr<ByteSource> unpack_indexed(const FileIndex& index,
  std::unique_ptr<ByteSource> packed, const std::shared_ptr<SeekPoints>& points)
{
  std::unique_ptr<ByteSource> source =
    unpack_known(std::move(packed), points, index.largest_expansion);
  return claims_end(index)
    ? std::make_unique<ClaimedContent>(std::move(source), index.frames.back().end)
    : std::move(source);
}
}

std::unique_ptr<ByteSource> open_indexed(const FileIndex& index)
{
  return unpack_indexed(index, open_packed(index), index.points);
}

std::unique_ptr<ByteSource> open_indexed(
  const FileIndex& index, const FrameEntry& entry, int threads)
{
  std::unique_ptr<ByteSource> packed = open_packed(index);
  if (!index.points)
  {
    return unpack_indexed(index, std::move(packed), no_points());
  }
  std::unique_ptr<ByteSource> source = unpack_segments(
    packed, *index.points, entry.offset, entry.end, threads, index.largest_expansion);
  return source ? std::move(source) : unpack_indexed(index, std::move(packed), index.points);
}
}
