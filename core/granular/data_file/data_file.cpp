// SPDX-License-Identifier: BSD-3-Clause
#include "granular/data_file/data_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

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
  for (const std::optional<DataSection>& section :
    { layout.particles, layout.velocities, layout.bond_rows })
  {
    end = std::max(end, section ? section->end : 0);
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
  if (!index.kinds)
  {
    index.kinds = std::make_shared<FrameKinds>();
  }
  index.frames.clear(); // the file is read as a whole, whatever was there before
  index.defect.reset();
  index.resume_offset = 0;
  index.resume_line = 1;
  try
  {
    const auto found = std::make_shared<const DataLayout>(read_data_layout(source, progress));
    const DataLayout& layout = *found;
    FrameEntry entry;
    entry.timestep = layout.timestep;
    entry.rows = layout.atoms;
    entry.end = end_of(source, layout);
    entry.line = 1;
    entry.kind = index.kinds->share(FrameKind{});
    index.frames.push_back(std::move(entry));
    index.resume_offset = index.frames.back().end;
    index.layout = found;
  }
  catch (const FormatError& error)
  {
    if (error.where().byte >= 0)
    {
      throw; // compressed data that are damaged
    }
    set_defect(index, { error.where(), error.text() });
    index.notices.push_back({ error.where(), error.text() + "; the file is left out" });
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
  try
  {
    return starts_data_file(first_bytes_of(*unpack(open_file(path))));
  }
  catch (const std::exception&)
  {
    return false;
  }
}
}
