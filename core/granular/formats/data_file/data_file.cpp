// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/data_file.h"

#include <algorithm>
#include <array>

namespace granular
{
namespace
{
/// The size of the content; of a compressed file it is known where nothing more comes.
std::int64_t end_of(const ByteSource& source, const DataLayout& layout)
{
  if (!source.compressed())
  {
    return source.stamp().size;
  }
  std::int64_t end = 0;
  for (const DataSection& section : layout.sections)
  {
    end = std::max(end, section.end);
  }
  std::array<char, 4096> bytes;
  while (const std::size_t got = source.read(end, bytes.data(), bytes.size()))
  {
    end += static_cast<std::int64_t>(got);
  }
  return end;
}

void index_data_file(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead&)
{
  forget_frames(index);
  try
  {
    const auto found = std::make_shared<const DataLayout>(read_data_layout(source, progress));
    add_whole(index,
      { .timestep = found->timestep,
        .rows = found->atoms,
        .end = end_of(source, *found),
        .line = 1 },
      found);
  }
  catch (const FormatError& error)
  {
    if (error.where().byte >= 0)
    {
      throw; // compressed data that are damaged
    }
    leave_out(index, error);
  }
}
}

const FileFormat& data_file_format() noexcept
{
  static constexpr FileFormat format = { .name = "a data file", .index = &index_data_file };
  return format;
}

std::shared_ptr<const DataLayout> find_data_layout(
  const FileIndex& file, const ByteSource& source, Progress& progress)
{
  auto known = known_layout<DataLayout>(file);
  return known ? known : std::make_shared<const DataLayout>(read_data_layout(source, progress));
}

bool is_data_file(const std::string& path) noexcept
{
  return looks_so(
    path, [](const ByteSource& source) { return starts_data_file(first_bytes_of(source)); });
}
}
