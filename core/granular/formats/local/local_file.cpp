// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/local/local_file.h"

#include "granular/formats/dump/grammar/text_dump.h"
#include "granular/frames/file_index.h"
#include "granular/frames/named_steps.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace granular
{
namespace
{
/// Returns true if a text begins with a row of numbers; so does one that is empty, of a process without rows.
bool is_bare(std::string_view first_bytes)
{
  const std::size_t first = first_bytes.find_first_not_of(" \t\r\n");
  first_bytes.remove_prefix(std::min(first, first_bytes.size()));
  const std::vector<std::string_view> words =
    split_words(first_bytes.substr(0, first_bytes.find('\n')));
  return std::ranges::all_of(words,
    [](std::string_view word)
    {
      double number = 0;
      return static_cast<bool>(parse_double(word.data(), word.data() + word.size(), number));
    });
}

/// Returns true if a frame is a file of rows, without the header that the first process has.
bool is_headless(const FrameEntry& entry)
{
  return entry.kind->layout == FrameKind::bare && entry.offset == 0;
}

void index_bare(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead)
{
  TextScanner scanner(
    source, index.resume_offset, index.resume_line, std::size_t{ 1 } << 18, ahead);
  FrameEntry entry;
  if (!index.frames.empty())
  {
    entry = index.frames.front();
  }
  else
  {
    std::string_view line;
    FrameKind kind;
    kind.layout = FrameKind::bare;
    while (scanner.next(line))
    {
      if (has_words(line))
      {
        kind.schema = ColumnSchema(
          numbered_columns(split_words(line).size()), known_columns(), scanner.where());
        scanner.put_back();
        break;
      }
    }
    entry.line = 1;
    entry.kind = index.kinds->share(std::move(kind));
    index.unnamed = true;
  }
  entry.rows += scanner.skip_to_item(progress);
  entry.end = scanner.offset();
  std::string_view line;
  if (scanner.next(line))
  {
    index.frames.clear();
    set_defect(index,
      { scanner.where(),
        "expected rows without a header to the end of the file, got " + quoted(line) });
    return;
  }
  index.frames.assign(1, entry);
  index.resume_offset = entry.end;
  index.resume_line = scanner.line();
}

void index_local(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead)
{
  const bool blank =
    !index.frames.empty() && is_headless(index.frames.front()) && index.frames.front().rows == 0;
  if (index.resume_offset == 0 || blank)
  {
    index.frames.clear(); // a file without a word may become any
    index.resume_offset = 0;
    index.resume_line = 1;
  }
  const std::string first_bytes = first_bytes_of(source);
  if (is_bare(first_bytes))
  {
    index_bare(source, index, progress, ahead);
  }
  else
  {
    index_text_dump(source, index, progress, ahead, RowsOf::Others);
  }
}

/// Makes a file of rows a piece of the frame whose header another file has. False if the columns are others.
bool adopt(FileIndex& file, const FrameEntry& head, FrameKinds& kinds)
{
  FrameEntry& entry = file.frames.front();
  const std::size_t columns = entry.kind->schema.columns().size();
  if (entry.rows > 0 && columns != head.kind->schema.columns().size())
  {
    return false;
  }
  FrameKind kind = *head.kind;
  kind.layout = FrameKind::bare;
  entry.kind = kinds.share(std::move(kind));
  entry.timestep = head.timestep;
  entry.time = head.time;
  entry.shape = head.shape;
  return true;
}

/// The files of a run that differ in the number of the process.
using Group = std::map<NameNumber, std::uint32_t>;

/// Calls visit(head, group) for files whose names differ in one number, where that with 0 has a header.
template <class Visit>
void for_each_group(const std::vector<FileIndex>& files, const Visit& visit)
{
  for (const auto& [rest, family] : families_of(files))
  {
    const std::size_t places = family.begin()->second.size();
    for (std::size_t at = 0; at < places; ++at)
    {
      for (const auto& [others, group] : group_by_others(family, at))
      {
        const auto head = group.find(NameNumber{ "0" });
        const bool has_head = head != group.end() && !files[head->second].frames.empty() &&
          files[head->second].frames.front().kind->layout == FrameKind::text;
        if (has_head)
        {
          visit(head->second, group);
        }
      }
    }
  }
}

bool is_headless(const FileIndex& file)
{
  return !file.frames.empty() && is_headless(file.frames.front());
}

/// Forgets what is in a file, which is read again when the files of the run are looked at again.
void leave_out(FileIndex& file)
{
  file.frames.clear();
  file.resume_offset = 0;
  file.resume_line = 1;
  file.stamp = {};
  file.points.reset();
}

/// Returns the notice about rows alone that belong to no header, or whose header has other columns.
std::string why_left_out(std::size_t columns, std::size_t wanted)
{
  if (wanted > 0)
  {
    return "expected rows of " + std::to_string(wanted) +
      " columns, as the file with 0 in its name has, got " + std::to_string(columns) +
      "; they are left out, and so is what they belong to";
  }
  return "expected a header, or rows of one timestep of which the file with 0 in its name has the "
         "header, got rows alone; they are left out, and so is what they belong to. A name with % "
         "and * gives each timestep its own files; ColumnMap makes rows of any timesteps one frame";
}

/// Returns true if the file of the next process, which would have 1 where this has 0 in its name, lies beside it, and has rows without a
/// header.
bool has_bare_sibling(const std::string& path)
{
  const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
  for (std::size_t at = path.rfind('/') + 1; at < path.size(); ++at)
  {
    const bool alone = path[at] == '0' && (at == 0 || !is_digit(path[at - 1])) &&
      (at + 1 == path.size() || !is_digit(path[at + 1]));
    if (!alone)
    {
      continue;
    }
    std::string sibling = path;
    sibling[at] = '1';
    try
    {
      const std::string bytes = first_bytes_of(*unpack(open_file(sibling)));
      if (is_bare(bytes))
      {
        return true;
      }
    }
    catch (const Error&)
    {
      // there is none, or none that can be read
    }
  }
  return false;
}

/// Says so where what one process has written is read alone. Only the first file is looked at: there may be many.
void note_siblings(const std::vector<FileIndex>& files, Notices& notices)
{
  const bool together =
    std::ranges::any_of(files, [](const FileIndex& file) { return is_headless(file); });
  if (!together && !files.empty() && !files.front().frames.empty() &&
    has_bare_sibling(files.front().path))
  {
    notices.push_back({ { files.front().path },
      "this has the rows of one process alone: those of the others are in files beside it, with 1, "
      "2 and so on for the 0 in its name; open them all together" });
  }
}

/// Makes each file a frame, whose columns the user has named. Its name may tell the timestep.
void make_frames(std::vector<FileIndex>& files, Notices& notices)
{
  for (const FileIndex& file : files)
  {
    notices.push_back({ { file.path },
      "the rows have no header with a timestep or a box: all rows of the file are one frame" });
  }
  if (files.size() > 1)
  {
    name_steps(files, notices);
  }
}

/// Gives the files of rows that `%` makes what the file with the header says, and leaves out the others; so are frames that lack
/// their rows.
void complete_pieces(std::vector<FileIndex>& files, Notices& notices)
{
  std::set<std::uint32_t> adopted;
  std::set<std::uint32_t> incomplete;
  std::map<std::uint32_t, std::size_t> wanted; ///< columns, of files that have others
  if (std::ranges::all_of(files,
        [](const FileIndex& file) { return is_headless(file) && !file.column_names.empty(); }))
  {
    return make_frames(files, notices);
  }
  note_siblings(files, notices);
  for_each_group(files,
    [&](std::uint32_t head, const Group& group)
    {
      const FrameEntry& entry = files[head].frames.front();
      for (const auto& [value, file] : group)
      {
        if (!is_headless(files[file]))
        {
          continue;
        }
        const bool whole = files[head].frames.size() == 1;
        if (whole && adopt(files[file], entry, *files[file].kinds))
        {
          adopted.insert(file);
        }
        else if (files[file].frames.front().rows > 0)
        {
          incomplete.insert(head);
          wanted[file] = whole ? entry.kind->schema.columns().size() : 0;
        }
      }
    });
  for (std::uint32_t number = 0; number < files.size(); ++number)
  {
    FileIndex& file = files[number];
    const bool alone = is_headless(file) && !adopted.contains(number);
    if (alone && file.frames.front().end > 0)
    {
      notices.push_back({ { file.path },
        why_left_out(file.frames.front().kind->schema.columns().size(), wanted[number]) });
    }
    if (alone || incomplete.contains(number))
    {
      leave_out(file);
    }
  }
}
}

const FileFormat& local_format() noexcept
{
  static constexpr FileFormat format = { .name = "a dump of local data",
    .index = index_local,
    .complete = complete_pieces,
    .first_rows = hash_first_rows,
    .large_runs = true };
  return format;
}

bool is_local(std::string_view first_bytes)
{
  return tell_rows(first_bytes) == RowsOf::Others;
}

bool is_local_file(const std::string& path) noexcept
{
  return looks_so(path, [](const ByteSource& source) { return is_local(first_bytes_of(source)); });
}
}
