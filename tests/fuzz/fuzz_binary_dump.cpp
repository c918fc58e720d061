// SPDX-License-Identifier: BSD-3-Clause
// A dump from memory, text or binary as its bytes say, all the way: index, then frames with several
// requests, also of a file that changed since. Whatever the bytes are, there is an Error or a frame of
// the rows it says, and no more memory than the bytes are worth.
#include "binary_mutations.h"
#include "dump_checks.h"

#include "granular/common/words.h"
#include "granular/formats/dump/grammar/binary_dump.h"
#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/frames/file_index.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

using namespace granular;

namespace
{
void check_index(const FileIndex& index, std::size_t size)
{
  std::int64_t end = 0;
  for (const FrameEntry& frame : index.frames)
  {
    require(frame.offset >= end && frame.offset < frame.end, "the places of a frame");
    end = frame.end;
    const std::int64_t bytes = frame.end - frame.offset;
    require(frame.rows >= 0 && frame.rows <= bytes, "more rows than bytes");
    if (frame.kind->layout != FrameKind::text)
    {
      const auto columns = static_cast<std::int64_t>(frame.kind->schema.columns().size());
      require(columns > 0 && frame.rows <= bytes / 8 / columns, "more values than bytes");
    }
  }
  require(end <= static_cast<std::int64_t>(size), "a frame beyond the end");
}

FileIndex index(std::string_view bytes, FileIndex index)
{
  const auto source = open_memory(bytes);
  Progress progress;
  try
  {
    index_dump(*source, index, progress);
  }
  catch (const Error&)
  {
    // a limit
  }
  check_index(index, bytes.size());
  return index;
}

/// All there is to do with a file whose columns have names, or have none.
void use(std::string_view bytes, std::string_view names)
{
  FileIndex blank;
  for (const std::string_view name : split_words(names))
  {
    blank.column_names.emplace_back(name);
  }
  const FileIndex all = index(bytes, blank);
  // as if the file had been half as long before
  const FileIndex half = index(bytes.substr(0, bytes.size() / 2), blank);
  const FileIndex grown = index(bytes, half);
  // what was there is still there; to begin with, a file may be taken for one of another layout
  require(grown.frames.size() >= half.frames.size(), "a file that grew has fewer frames");

  const auto source = open_memory(bytes);
  std::string changed(bytes);
  std::for_each(changed.begin() + static_cast<std::ptrdiff_t>(changed.size() / 2), changed.end(),
    [](char& byte) { byte = static_cast<char>(byte ^ 0x11); });
  const auto other = open_memory(changed);
  const auto cut = open_memory(bytes.substr(0, bytes.size() - bytes.size() / 8));
  static const std::vector<Request> every = requests();
  constexpr std::size_t most_frames = 8;
  for (std::size_t i = 0; i < std::min(all.frames.size(), most_frames); ++i)
  {
    for (const Request& request : every)
    {
      check_readings(*source, all.frames[i], request);
    }
    check_changed(*other, all.frames[i], every[0]);
    check_changed(*cut, all.frames[i], every[1]);
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  static_cast<void>(is_dump(bytes));
  static_cast<void>(is_binary_dump(bytes.substr(0, size / 2)));
  use(bytes, "");
  use(bytes, "id type x y z ix iy iz vx vy vz radius");
  return 0;
}
