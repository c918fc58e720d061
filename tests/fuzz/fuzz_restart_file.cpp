// SPDX-License-Identifier: BSD-3-Clause
// A restart file from memory, all the way: layout, then particles and bonds. Whatever the bytes are, there is an Error with a
// place, or chunks that lie in the file, one behind the other, for as many particles as the header says; and the same arrays
// with any number of threads, of which three parts have each row once.
#include "dump_checks.h"
#include "restart_mutations.h"

#include "granular/formats/restart/restart_file.h"
#include "granular/formats/restart/restart_reader.h"

#include <cstddef>
#include <cstdint>
#include <string>
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
  require(layout.masses.empty() || layout.masses.size() == static_cast<std::size_t>(header.types),
    "masses");
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

/// What came of reading: all arrays, or what is wrong.
std::string content_of(const Tables& frame)
{
  std::string all = granular::content_of({ &frame.rows, &frame.bonds });
  return all.append(
    static_cast<const char*>(frame.bonds.lines.points.data()), frame.bonds.lines.points.bytes());
}

Tables read(
  const ByteSource& source, const RestartLayout& layout, int history_layout, const Request& request)
{
  Notices notices;
  Progress progress;
  Tables frame = read_restart(source, layout, history_layout, request, notices, progress);
  FrameEntry entry;
  entry.rows = frame.rows.rows;
  check_frame(frame.rows, entry, {});
  require(
    frame.bonds.rows <= frame.bonds.lines.count || !frame.bonds.has_lines, "a line for each bond");
  return frame;
}

void check_reading(
  const ByteSource& source, const RestartLayout& layout, int history_layout, Request request)
{
  request.threads = 1;
  const Tables whole = read(source, layout, history_layout, request);
  require(whole.rows.rows == layout.records, "the particles");
  request.threads = 3;
  request.pool = used_memory();
  require(content_of(read(source, layout, history_layout, request)) == content_of(whole),
    "threads differ");
  std::int64_t particles = 0;
  std::int64_t bonds = 0;
  request.pieces = 3;
  for (; request.piece < request.pieces; ++request.piece)
  {
    const Tables part = read(source, layout, history_layout, request);
    particles += part.rows.rows;
    bonds += part.bonds.rows;
  }
  require(particles == whole.rows.rows && bonds == whole.bonds.rows, "rows of parts");
}

std::vector<Request> restart_requests()
{
  std::vector<Request> all(3);
  all[1].bonds = false;
  all[1].wanted = [](std::string_view name, bool) { return name.size() % 2 == 0; };
  all[2].wanted = [](std::string_view, bool) { return false; };
  all[2].periodic_lines = PeriodicLines::Split;
  all[2].point_origin = { 1, 2, 3 };
  return all;
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto source = open_memory(bytes);
  Notices notices;
  Progress progress;
  FileIndex index;
  index.path = source->path();
  index.stamp = source->stamp();
  restart_format().index(*source, index, progress, {});
  try
  {
    const RestartLayout layout = read_layout(*source, notices, progress);
    check(layout, static_cast<std::int64_t>(size));
    require(index.frames.size() == 1, "a file that can be read is a frame");
    for (const Request& request : restart_requests())
    {
      const bool plain = request.periodic_lines == PeriodicLines::MinimumImage;
      check_reading(*source, layout, plain ? automatic_history : numbered_history, request);
    }
  }
  catch (const Error& error)
  {
    require(error.where().byte >= 0, "an error without a place");
  }
  return 0;
}
