// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_byte_source_segments_h
#define granular_bytes_byte_source_segments_h

#include "granular/bytes/byte_source.h"

#include <cstdint>
#include <memory>

namespace granular
{
/// Returns the contents of a source as unpack does, by seek points to which none is added: other readers may use them at the same
/// time. Without points it finds its own.
std::unique_ptr<ByteSource> unpack_known(
  std::unique_ptr<ByteSource> packed, std::shared_ptr<const SeekPoints> points);

/// Returns the content of a compressed file from an offset to another for several threads at once: each decompresses what it
/// needs from one seek point to the next, keeps that for the others, and decompresses the next part where it would have to wait. At
/// the end offset the content seems to end. Returns null where that would not help: with one thread, with fewer than three such
/// parts, or with one above 64 MiB. Memory: twice as many parts as threads, two more, those that threads copy from, and a decoder for
/// each thread. The sums of the file are compared for each part. Throws, and reading throws, as unpack does.
std::unique_ptr<ByteSource> unpack_segments(std::unique_ptr<ByteSource>& packed,
  const SeekPoints& points, std::int64_t begin, std::int64_t end, int threads);
}
#endif
