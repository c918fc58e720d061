// SPDX-License-Identifier: BSD-3-Clause
// A frame of an open source, which need not be a file.
#ifndef tests_support_read_source_h
#define tests_support_read_source_h

#include "granular/formats/dump/read/dump_reader.h"
#include "granular/frames/file_index.h"

namespace granular
{
inline Table read_dump(const ByteSource& source, const FrameEntry& entry, const Request& request,
  Notices& notices, Progress& progress)
{
  FileIndex file;
  file.path = source.path();
  return read_dump({ { file, entry, &source } }, request, notices, progress);
}
}
#endif
