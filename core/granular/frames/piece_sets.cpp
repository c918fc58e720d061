// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/run_index_parts.h"

#include "granular/frames/named_steps.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace granular
{
namespace
{
std::vector<NameNumber> values_of(const Siblings& groups)
{
  std::set<NameNumber> values;
  for (const auto& [others, group] : groups)
  {
    for (const auto& [value, file] : group)
    {
      values.insert(value);
    }
  }
  return { values.begin(), values.end() };
}

/// The numbers of all pieces, with those that are missing.
std::vector<NameNumber> piece_numbers(const std::vector<NameNumber>& values)
{
  constexpr std::size_t most_digits = 9;
  const std::string& largest = values.back().text;
  std::int64_t last = 0;
  parse_int64(largest.data(), largest.data() + std::min(largest.size(), most_digits), last);
  const std::size_t count = static_cast<std::size_t>(last) + 1;
  if (largest.size() > most_digits || count > 2 * values.size())
  {
    return values; // they count something else
  }
  std::vector<NameNumber> numbers;
  for (std::size_t i = 0; i < count; ++i)
  {
    numbers.push_back({ std::to_string(i) });
  }
  return numbers;
}

/// A frame in a group of files.
struct GroupFrame
{
  std::size_t group;
  std::uint32_t file;
  const FrameEntry* entry;

  std::int64_t timestep() const noexcept { return entry->timestep; }
};

/// The frames of all groups by timestep; of frames that a file repeats the last.
std::vector<GroupFrame> list_frames(const std::vector<FileIndex>& files, const Siblings& groups)
{
  std::vector<GroupFrame> frames;
  std::size_t number = 0;
  for (const auto& [others, group] : groups)
  {
    for (const auto& [value, file] : group)
    {
      for (const FrameEntry& entry : files[file].frames)
      {
        frames.push_back({ number, file, &entry });
      }
    }
    ++number;
  }
  const auto key = [](const GroupFrame& frame)
  { return std::tuple(frame.timestep(), frame.group, frame.file); };
  std::ranges::stable_sort(frames, {}, key);
  std::vector<GroupFrame> last;
  for (const GroupFrame& frame : frames)
  {
    if (!last.empty() && key(last.back()) == key(frame))
    {
      last.pop_back();
    }
    last.push_back(frame);
  }
  return last;
}

/// Returns the end of the frames of one timestep and group.
template <class Place>
Place end_of_step(Place first, Place last)
{
  return std::find_if(first, last,
    [&](const GroupFrame& frame)
    { return frame.timestep() != first->timestep() || frame.group != first->group; });
}

/// Returns true if files begin a run together: only one of them has frames so far, and all are there.
bool just_begun(const std::vector<FileIndex>& files, const Siblings& groups)
{
  constexpr std::size_t least = 3; // two may be a series as well
  const auto& group = groups.begin()->second;
  const auto has_frames = [&](const auto& entry) { return !files[entry.second].frames.empty(); };
  const auto is_whole = [&](const auto& entry)
  { return has_frames(entry) && files[entry.second].frames.front().shape == FrameEntry::whole; };
  return groups.size() == 1 && group.size() >= least &&
    std::ranges::count_if(group, has_frames) == 1 && std::ranges::none_of(group, is_whole) &&
    std::ranges::none_of(
      group, [&](const auto& entry) { return files[entry.second].error != nullptr; });
}

/// Returns true if files list the same frames as far as they go.
bool only_lag(const std::vector<FileIndex>& files, const std::map<NameNumber, std::uint32_t>& group)
{
  const std::vector<FrameEntry>* longest = nullptr;
  for (const auto& [value, file] : group)
  {
    const std::vector<FrameEntry>& frames = files[file].frames;
    longest = !longest || frames.size() > longest->size() ? &frames : longest;
  }
  return std::ranges::all_of(group,
    [&](const auto& entry)
    {
      const std::vector<FrameEntry>& frames = files[entry.second].frames;
      return std::equal(frames.begin(), frames.end(), longest->begin(),
        [](const FrameEntry& a, const FrameEntry& b)
        { return a.timestep == b.timestep && a.shape == b.shape; });
    });
}

/// Returns true if the files of the groups hold pieces of the same frames, rather than frames of a series or
/// of a run that was restarted: the first frame is shared, and most are, or all that a file has.
bool share_frames(const std::vector<FileIndex>& files, const Siblings& groups,
  const std::vector<GroupFrame>& frames)
{
  std::size_t all = 0;
  std::size_t shared = 0;
  bool first_shared = false; // or would be, if the files that there are by name could be read
  const auto files_of = [&](std::size_t group)
  { return std::next(groups.begin(), static_cast<std::ptrdiff_t>(group))->second.size(); };
  for (auto first = frames.begin(); first != frames.end();)
  {
    const auto end = end_of_step(first, frames.end());
    const bool same = end - first > 1 && first->entry->shape != FrameEntry::whole &&
      std::all_of(first, end,
        [&](const GroupFrame& frame) { return frame.entry->shape == first->entry->shape; });
    if (all == 0)
    {
      first_shared = same || (groups.size() > 1 && files_of(first->group) > 1);
    }
    shared += same ? 1U : 0U;
    ++all;
    first = end;
  }
  if (shared == 0)
  {
    return just_begun(files, groups);
  }
  return first_shared &&
    (2 * shared >= all || (groups.size() == 1 && only_lag(files, groups.begin()->second)));
}

/// Returns true if a frame has rows that were seen before. Rows that cannot be read are left to the reader of the frame; without
/// the file nobody can tell pieces from repetitions.
bool is_seen(const FileIndex& file, const FrameEntry& entry, std::set<std::int64_t>& seen)
{
  if (!file.format || !file.format->first_rows)
  {
    return false;
  }
  std::vector<std::int64_t> rows;
  try
  {
    rows = file.format->first_rows(file, entry);
  }
  catch (const IoError&)
  {
    throw;
  }
  catch (const Error&)
  {
  }
  const auto is_there = [&](std::int64_t row) { return seen.contains(row); };
  const bool again = std::ranges::any_of(rows, is_there);
  seen.insert(rows.begin(), rows.end());
  return again;
}

/// Returns true if several files have the same particle in the first frame in which they have any: a run that
/// was done again, under the same name with another number, looks like pieces but for that.
bool share_particles(const std::vector<FileIndex>& files, const std::vector<GroupFrame>& frames)
{
  constexpr int most_files = 4;
  for (auto first = frames.begin(); first != frames.end();)
  {
    const auto end = end_of_step(first, frames.end());
    std::set<std::int64_t> seen;
    int looked = 0;
    for (; first != end; ++first)
    {
      if (first->entry->rows > 0 && looked < most_files)
      {
        if (is_seen(files[first->file], *first->entry, seen))
        {
          return true;
        }
        ++looked;
      }
    }
    if (looked > 1)
    {
      return false;
    }
  }
  return false;
}

/// The sets if the number that tells the files of a group apart counts pieces; else none.
std::vector<PieceSet> sets_of(const std::vector<FileIndex>& files, const Siblings& groups)
{
  const std::vector<NameNumber> values = values_of(groups);
  if (values.size() < 2 || values.front().text != "0")
  {
    return {}; // the programs count processes from 0
  }
  const std::vector<GroupFrame> frames = list_frames(files, groups);
  if (!share_frames(files, groups, frames) || share_particles(files, frames))
  {
    return {};
  }
  const std::vector<NameNumber> numbers = piece_numbers(values);
  std::vector<PieceSet> sets;
  for (const auto& [others, group] : groups)
  {
    PieceSet& set = sets.emplace_back();
    set.expected = numbers.size();
    for (const NameNumber& number : numbers)
    {
      const auto found = group.find(number);
      if (found == group.end())
      {
        set.missing += " " + number.text;
      }
      else
      {
        set.files.push_back(found->second);
      }
    }
  }
  return sets;
}
}

std::vector<PieceSet> find_piece_sets(const std::vector<FileIndex>& files)
{
  std::vector<PieceSet> all;
  for (const auto& [rest, family] : families_of(files))
  {
    const std::size_t places = family.size() > 1 ? family.begin()->second.size() : 0;
    std::vector<PieceSet> sets;
    for (std::size_t at = 0; at < places && sets.empty(); ++at)
    {
      sets = sets_of(files, group_by_others(family, at));
    }
    all.insert(all.end(), sets.begin(), sets.end());
  }
  return all;
}
}
