// SPDX-License-Identifier: BSD-3-Clause
// The functions of granular.h for the content of any file.
#include "guard.h"

#include "granular/bytes/byte_source.h"

#include <memory>

using namespace granular_c;

struct granular_bytes
{
  std::unique_ptr<granular::ByteSource> content;
  std::int64_t next = 0; ///< offset of the byte to read
};

extern "C"
{
  granular_status granular_open_bytes(const char* path, granular_bytes** bytes)
  {
    return guarded(
      [&]
      {
        granular_bytes*& made = needed(bytes, "bytes");
        made = new granular_bytes{ granular::unpack(granular::open_file(&needed(path, "a path"))) };
      });
  }

  granular_status granular_read_bytes(
    granular_bytes* bytes, void* buffer, size_t most, size_t* got, int* is_cut)
  {
    return guarded(
      [&]
      {
        auto& [content, next] = needed(bytes, "bytes");
        char& begin = needed(static_cast<char*>(buffer), "a buffer");
        needed(is_cut, "is_cut") = 0;
        const std::size_t read = content->read(next, &begin, most);
        needed(got, "got") = read;
        next += static_cast<std::int64_t>(read);
        *is_cut = read < most && !content->unchecked().empty() ? 1 : 0;
      });
  }

  void granular_close_bytes(granular_bytes* bytes)
  {
    delete bytes;
  }
}
