// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/dump_files.h"

#include "granular/formats/dump/grammar/atom_fit.h"
#include "granular/formats/dump/grammar/binary_dump.h"
#include "granular/formats/dump/grammar/text_dump.h"
#include "granular/formats/dump/grammar/text_rows.h"
#include "granular/frames/named_steps.h"

#include <algorithm>
#include <array>
#include <memory>

namespace granular
{
namespace
{
/// FileFormat::first_rows for particles: the ids, if there are any.
std::vector<std::int64_t> find_first_ids(const FileIndex& file, const FrameEntry& entry)
{
  constexpr std::int64_t most = 20'000;
  constexpr std::int64_t most_bytes = std::int64_t{ 1 } << 18;
  const int column = entry.kind->schema.find(ColumnRole::Id);
  if (column < 0)
  {
    return {};
  }
  std::vector<std::int64_t> ids(most);
  std::int64_t count = 0;
  ColumnSink sink = { static_cast<std::uint32_t>(column), ValueType::Int64,
    reinterpret_cast<char*>(ids.data()), sizeof ids[0] };
  try
  {
    const std::unique_ptr<ByteSource> source = open_indexed(file);
    const std::unique_ptr<FrameRows> rows = open_rows(*source, entry);
    const std::unique_ptr<RowReader> reader = rows->reader();
    const std::int64_t step = chunk_extent(entry, most_bytes);
    for (std::int64_t at = 0; at < extent_of(entry) && count < most; at += step)
    {
      reader->open(at, std::min(at + step, extent_of(entry)));
      count += reader->decode({ &sink, 1 }, most - count);
    }
  }
  catch (const Misfits&)
  {
  }
  ids.resize(static_cast<std::size_t>(count));
  return ids;
}

bool is_bare(const FileIndex& file)
{
  return !file.frames.empty() && file.frames.front().kind->layout == FrameKind::bare;
}

/// FileFormat::complete: names of columns, and timesteps where files have no headers.
void complete(std::vector<FileIndex>& files, Notices& notices)
{
  complete_atom_names(files, notices);
  if (!files.empty() && std::ranges::all_of(files, is_bare))
  {
    name_steps(files, notices);
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
    .complete = complete,
    .lacks = [](const std::vector<FileIndex>& files)
    { return lack_atom_names(files) || std::ranges::any_of(files, is_bare); },
    .describe = describe_first,
    .first_rows = find_first_ids,
    .large_runs = true };
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

void index_dump(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead)
{
  std::array<char, 4096> bytes;
  const std::string_view first(bytes.data(), source.read(0, bytes.data(), bytes.size()));
  if (holds_binary(first))
  {
    return index_binary_dump(source, index, progress);
  }
  const bool has_lines = first.size() == bytes.size() || first.find('\n') != first.npos;
  index.unnamed = has_lines && first.find('\0') == first.npos && !tell_rows(first);
  if (index.unnamed && !index.column_names.empty())
  {
    return index_bare_dump(source, index);
  }
  index_text_dump(source, index, progress, ahead);
}

std::int64_t extent_of(const FrameEntry& entry) noexcept
{
  return entry.kind->is_text() ? entry.end - entry.offset : entry.rows;
}

std::int64_t chunk_extent(const FrameEntry& entry, std::size_t bytes) noexcept
{
  const std::size_t unit =
    entry.kind->is_text() ? 1 : entry.kind->schema.columns().size() * sizeof(double);
  return static_cast<std::int64_t>(
    std::max(std::size_t{ 1 }, bytes / std::max<std::size_t>(unit, 1)));
}

std::unique_ptr<FrameRows> open_rows(const ByteSource& source, const FrameEntry& entry)
{
  return entry.kind->is_text() ? std::make_unique<TextRows>(source, entry)
                               : open_binary_rows(source, entry);
}
}
