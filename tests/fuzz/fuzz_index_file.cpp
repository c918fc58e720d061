// SPDX-License-Identifier: BSD-3-Clause
// The bytes of an index file, as they are, and again with a head and a hash that make a reader
// believe the rest. Whatever they are, there is an Error, or files in which all is within bounds,
// and which come back as they are when they are written and read again.
#include "granular/common/hash.h"
#include "granular/frames/saved_index.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

using namespace granular;

namespace
{
void require(bool good, const char* what)
{
  if (!good)
  {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  }
}

std::vector<FileIndex> decode(std::string_view bytes, const std::string& first_file)
{
  return decode_index(bytes, first_file, std::make_shared<FrameKinds>());
}

void check(const FileIndex& file)
{
  require(file.loaded && !file.error && file.kinds != nullptr, "the state of a file");
  require(file.stamp.size >= 0 && file.resume_offset >= 0 && file.resume_line >= 1, "a place");
  std::int64_t last = 0;
  for (const FrameEntry& frame : file.frames)
  {
    require(frame.offset >= last, "the order of the frames");
    require(file.compressed || frame.end <= file.stamp.size, "the end of a frame");
    last = frame.end;
    require(frame.kind && frame.kind->layout >= FrameKind::bare, "the kind of a frame");
    require(frame.rows >= 0 && frame.offset >= 0 && frame.rows <= frame.end - frame.offset,
      "the place of a frame");
  }
}

/// What encode_index puts around the rest.
std::string believable(std::string_view body)
{
  static const std::string head = encode_index({}).substr(0, 16);
  std::string bytes = head + std::string(body);
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  const std::uint64_t value = hash.value();
  return bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  try
  {
    decode(input, "folder/a.dump");
  }
  catch (const Error&)
  {
    // what it says is for a reader to judge
  }
  try
  {
    const std::vector<FileIndex> files = decode(believable(input), "folder/a.dump");
    for (const FileIndex& file : files)
    {
      check(file);
    }
    const std::string bytes = encode_index(files);
    const std::string first_file = files.empty() ? "" : files.front().path;
    require(encode_index(decode(bytes, first_file)) == bytes, "read and written again");
  }
  catch (const Error&)
  {
    // the same
  }
  return 0;
}
