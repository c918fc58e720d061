// SPDX-License-Identifier: BSD-3-Clause
// A data file from memory, all the way: header, sections, columns, particles with their velocities, bonds. Whatever the bytes
// are, there is an Error with a place, or as many rows as the header says; three parts have each row once.
#include "dump_checks.h"

#include "granular/formats/data_file/data_file.h"
#include "granular/formats/data_file/read_data.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

using namespace granular;

namespace
{
Tables read(const FramePiece& file, const Request& request)
{
  SerialCommunicator alone;
  Notices notices;
  Progress progress;
  return read_data(file, {}, request, alone, notices, progress);
}

void check(const FramePiece& file)
{
  Request request;
  request.threads = 2;
  request.chunk_bytes = 64;
  const Tables whole = read(file, request);
  check_frame(whole.rows, file.entry, request);
  require(whole.bonds.lines.count >= whole.bonds.rows, "a line for each bond");
  std::int64_t particles = 0;
  std::int64_t bonds = 0;
  request.pool = used_memory();
  const Tables again = read(file, request);
  require(content_of({ &again.rows, &again.bonds }) == content_of({ &whole.rows, &whole.bonds }),
    "what was read depends on the memory");
  request.pieces = 3;
  for (int& piece = request.piece; piece < 3; ++piece)
  {
    const Tables part = read(file, request);
    particles += part.rows.rows;
    bonds += part.bonds.rows;
  }
  require(particles == whole.rows.rows && bonds == whole.bonds.rows, "rows of parts");
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto source = open_memory(bytes);
  FileIndex index;
  index.path = source->path();
  index.stamp = source->stamp();
  Progress progress;
  static_cast<void>(starts_data_file(bytes));
  data_file_format().index(*source, index, progress, {});
  require(index.frames.empty() == index.defect.has_value(), "a frame, or what is wrong");
  try
  {
    if (!index.frames.empty())
    {
      check({ index, index.frames.front(), source.get() });
    }
  }
  catch (const FormatError& error)
  {
    require(!error.where().path.empty(), "an error without a place");
  }
  return 0;
}
