// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/restart_file.h"

#include "granular/bytes/find_files.h"
#include "granular/formats/restart/process_files.h"
#include "granular/formats/restart/restart_bytes.h"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
namespace
{
constexpr std::string_view part_text = "expected a restart file, got what one of several processes "
                                       "has written of it: open the file with "
                                       "'base' in its name";

void index_restart(const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead&)
{
  forget_frames(index);
  if (is_process_file(source))
  {
    set_defect(index, { { source.path() }, std::string(part_text) });
    return;
  }
  try
  {
    Notices notices; // what is missing of a frame that can be read is told when it is
    const auto found =
      std::make_shared<const RestartLayout>(read_layout(source, notices, progress));
    const RestartLayout& layout = *found;
    add_whole(index,
      { .timestep = layout.header.timestep,
        .rows = layout.records,
        .end = layout.size,
        .time = layout.header.time.value_or(FrameEntry::no_time) },
      found);
    for (const RestartChunk& chunk : layout.chunks)
    {
      if (!chunk.path.empty())
      {
        index.beside.push_back({ chunk.path, chunk.stamp });
      }
    }
  }
  catch (const FormatError& error)
  {
    if (error.where().path != source.path())
    {
      // it may come, or be completed, and this file does not change then
      index.beside.push_back({ error.where().path, stamp_of(error.where().path) });
    }
    leave_out(index, error);
  }
  catch (const UnsupportedError& error)
  {
    leave_out(index, error);
  }
}

/// Files of processes are known by their base, where it is.
void pass_over_parts(std::vector<FileIndex>& files, Notices& notices)
{
  std::vector<std::pair<ProcessNames, const FileIndex*>> bases;
  for (const FileIndex& file : files)
  {
    for (ProcessNames& names : process_names(file.path))
    {
      bases.emplace_back(std::move(names), &file);
    }
  }
  std::size_t alone = 0;
  const FileIndex* first = nullptr;
  for (FileIndex& file : files)
  {
    if (!file.defect || file.defect->text != part_text)
    {
      continue;
    }
    const auto base = std::ranges::find_if(
      bases, [&](const auto& candidate) { return candidate.first.match(file.path); });
    if (base == bases.end())
    {
      first = first ? first : &file;
      ++alone;
    }
    else if (base->second->defect)
    {
      file.defect = base->second->defect; // if there is no frame at all, it is why
    }
  }
  if (first)
  {
    Notice notice = *first->defect;
    notice.text += alone > 1 ? "; " + std::to_string(alone) + " such files are left out" : "";
    notices.push_back(std::move(notice));
  }
}

/// Returns true if a file that could be of a process is beside its base: one name in the folder has `base` in place of the number.
bool has_base(const std::string& path)
{
  const std::size_t slash = path.rfind('/');
  std::size_t end = path.size();
  constexpr std::string_view digits = "0123456789";
  while (
    (end = path.find_last_of(digits, end - 1)) != path.npos && (slash == path.npos || end > slash))
  {
    const std::size_t before = path.find_last_not_of(digits, end);
    const std::size_t begin = before == path.npos ? 0 : before + 1;
    if (is_there(path.substr(0, begin) + "base" + path.substr(end + 1)))
    {
      return true;
    }
    if (begin == 0)
    {
      break;
    }
    end = begin;
  }
  return false;
}

bool looks_like_restart(const ByteSource& source)
{
  constexpr std::string_view newer = "LammpS RestartT";
  RestartBytes bytes(source);
  if (bytes.view(0, newer.size()).starts_with(newer))
  {
    return true;
  }
  for (const bool swapped : { false, true })
  {
    bytes.set_swapped(swapped);
    const std::int64_t end = bytes.text_end(4);
    const auto number = [&](std::int64_t at) { return bytes.number_at<std::int32_t>(at, ""); };
    if (end > 0 && bytes.has(end, 8) && number(0) == 0 && number(end) == 1)
    {
      return number(end + 4) == 4 || number(end + 4) == 8;
    }
  }
  return false;
}
}

const FileFormat& restart_format() noexcept
{
  static constexpr FileFormat format = {
    .name = "a restart file of LIGGGHTS", .index = &index_restart, .complete = &pass_over_parts
  };
  return format;
}

std::shared_ptr<const RestartLayout> find_restart_layout(
  const FileIndex& file, const ByteSource& source, Notices& notices, Progress& progress)
{
  if (auto known = known_layout<RestartLayout>(file))
  {
    note_fixes(*known, source.path(), notices);
    return known;
  }
  return std::make_shared<const RestartLayout>(read_layout(source, notices, progress));
}

bool is_restart_file(const std::string& path) noexcept
{
  return looks_so(path,
    [&](const ByteSource& source)
    { return looks_like_restart(source) || (is_process_file(source) && has_base(path)); });
}
}
