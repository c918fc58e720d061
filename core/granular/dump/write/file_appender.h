// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_file_appender_h
#define granular_dump_write_file_appender_h

#include "granular/bytes/byte_sink.h"
#include "granular/bytes/compression.h"
#include "granular/parallel/executor.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Writes bytes one after the other, compressed or not, on several threads. The result depends only on the bytes and on where
/// parts end.
class FileAppender
{
public:
  /// member_bytes: uncompressed bytes in a member of a gzip file or a frame of a Zstandard file.
  FileAppender(OutputFile& file, Compression compression, const Executor& executor,
    std::size_t member_bytes = std::size_t{ 1 } << 20);

  void append(std::string_view bytes) { this->append(std::span(&bytes, 1)); }
  void append(std::span<const std::string_view> pieces);

  /// Returns true if bytes go into the file unchanged: then they may also be written to the position at the end, from any
  /// thread.
  bool is_plain() const noexcept { return compression_ == Compression::None; }
  std::int64_t take(std::size_t bytes) noexcept;
  void write_at(std::int64_t offset, std::string_view bytes) { file_.write_at(offset, bytes); }

  /// Ends a part of the file, so that a reader may begin after it: a new member begins there.
  void end_part() { this->compress_pending(true); }

  std::int64_t size() const noexcept
  {
    return size_;
  } ///< of the file, without what waits to be compressed

private:
  void write(std::span<const std::string_view> pieces);
  void compress_pending(bool all);

  OutputFile& file_;
  Compression compression_;
  const Executor& executor_;
  std::size_t member_bytes_;
  std::string pending_; ///< not compressed yet: less than a member for each thread
  std::int64_t size_ = 0;
};
}
#endif
