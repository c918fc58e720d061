// SPDX-License-Identifier: BSD-3-Clause
// A restart file from memory, up to where its records are. Whatever the bytes are, there is an Error with a place, or chunks
// that lie in the file, one behind the other, for as many particles as the header says.
#include "dump_checks.h"

#include "granular/restart/restart_layout.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

using namespace granular;

namespace
{
void check(const RestartLayout& layout, std::int64_t size)
{
  const RestartHeader& header = layout.header;
  require(header.end <= layout.begin && layout.begin <= size, "the begin of the particles");
  require(layout.size == size, "the size");
  require(layout.records == header.atoms, "records");
  require(layout.masses.size() == static_cast<std::size_t>(header.types), "masses");
  require(layout.groups.size() <= 32, "groups");
  require(layout.has_fixes || layout.fixes.empty(), "fixes");
  require(layout.chunks.empty()
      ? layout.records == 0
      : layout.chunks.size() == static_cast<std::size_t>(header.processes),
    "chunks");
  std::int64_t at = layout.begin;
  std::int64_t doubles = 0;
  for (const RestartChunk& chunk : layout.chunks)
  {
    require(chunk.path.empty(), "the file of a chunk");
    require(chunk.offset == at + 4 && chunk.doubles >= 0, "the place of a chunk");
    at = chunk.offset + 8 * chunk.doubles;
    doubles += chunk.doubles;
  }
  require(at <= size && layout.records <= doubles / 11, "the end of the chunks");
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  Notices notices;
  Progress progress;
  try
  {
    check(read_layout(*open_memory(bytes), notices, progress), static_cast<std::int64_t>(size));
  }
  catch (const Error& error)
  {
    require(error.where().byte >= 0, "an error without a place");
  }
  return 0;
}
