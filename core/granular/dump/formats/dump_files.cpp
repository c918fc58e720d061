// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/formats/dump_files.h"

#include "granular/dump/formats/atom_fit.h"
#include "granular/dump/formats/binary_dump.h"
#include "granular/dump/formats/binary_header.h"
#include "granular/dump/formats/first_rows.h"
#include "granular/dump/formats/frame_rows.h"
#include "granular/dump/formats/text_dump.h"

#include <array>
#include <memory>

namespace granular
{
namespace
{
/// Throws if the header of the frame is another.
void check_frame(const ByteSource& source, const FrameEntry& entry)
{
  if (entry.kind->named) // else it says so when it is read
  {
    open_rows(source, entry);
  }
}

std::string describe_first(const ByteSource& source, const FrameEntry& entry)
{
  return entry.kind->is_text() ? ""
                               : describe_first_row(source, entry.offset,
                                   binary_layouts()[static_cast<std::size_t>(entry.kind->layout)]);
}
}

const FileFormat& dump_format() noexcept
{
  static const FileFormat format = { .name = "a dump",
    .index = index_dump,
    .complete = complete_atom_names,
    .lacks = lack_atom_names,
    .fits = dump_fits,
    .describe = describe_first,
    .first_rows = find_first_ids,
    .large_runs = true,
    .layouts = static_cast<int>(binary_layouts().size()) };
  return format;
}

bool is_dump(std::string_view first_bytes)
{
  return is_text_dump(first_bytes) || is_binary_dump(first_bytes);
}

bool is_dump_file(const std::string& path) noexcept
{
  return looks_so(path, [](const ByteSource& source) { return is_dump(first_bytes_of(source)); });
}

bool dump_fits(const ByteSource& source, const FileIndex& index)
{
  const std::vector<FrameEntry>& frames = index.frames;
  const bool text = frames.front().kind->is_text();
  if (!(text ? text_dump_fits(source, index) : binary_dump_fits(source, index)))
  {
    return false;
  }
  check_frame(source, frames.front());
  for (std::size_t i = 1; i < frames.size(); ++i)
  {
    const bool hides =
      frames[i].timestep <= frames[i - 1].timestep; // a frame that nobody will read
    if (hides || i + 1 == frames.size())
    {
      check_frame(source, frames[i - (hides ? 1 : 0)]);
      check_frame(source, frames[i]);
    }
  }
  return true;
}

void index_dump(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead)
{
  if (!index.kinds)
  {
    index.kinds = std::make_shared<FrameKinds>();
  }
  std::array<char, 4096> first;
  if (holds_binary({ first.data(), source.read(0, first.data(), first.size()) }))
  {
    index_binary_dump(source, index, progress);
  }
  else
  {
    index_text_dump(source, index, progress, ahead);
  }
}
}
