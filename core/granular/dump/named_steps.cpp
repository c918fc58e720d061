// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/named_steps.h"

#include "granular/base/number.h"
#include "granular/dump/numbered_name.h"

#include <algorithm>
#include <optional>
#include <string>

namespace granular
{
namespace
{
bool counts_from_zero(const std::map<Digits, std::uint32_t>& group)
{
  std::size_t next = 0;
  return std::ranges::all_of(
    group, [&](const auto& entry) { return entry.first.text == std::to_string(next++); });
}

/// Whether the contents of the files say that they are pieces: see name_steps.
bool hold_pieces(const std::vector<FileIndex>& files, const std::map<Digits, std::uint32_t>& group)
{
  const auto frames_of = [&](std::uint32_t file) -> const std::vector<FrameEntry>&
  { return files[file].frames; };
  const auto is_piece = [&](const auto& entry)
  {
    return std::ranges::any_of(frames_of(entry.second),
      [](const FrameEntry& frame) { return frame.shape != FrameEntry::whole; });
  };
  const auto is_empty = [&](const auto& entry) { return frames_of(entry.second).empty(); };
  return std::ranges::any_of(group, is_piece) ||
    (!is_empty(*group.begin()) && std::all_of(std::next(group.begin()), group.end(), is_empty));
}

/// Which of the numbers of a family counts pieces, if any does.
std::optional<std::size_t> place_of_pieces(
  const std::vector<FileIndex>& files, const Family& family)
{
  const std::size_t places = family.begin()->second.size();
  for (std::size_t at = 0; places > 1 && at < places; ++at)
  {
    const Siblings groups = group_by_others(family, at);
    const std::size_t size = groups.begin()->second.size();
    const bool counted = size > 1 &&
      std::ranges::all_of(groups,
        [&](const auto& group)
        { return group.second.size() == size && counts_from_zero(group.second); });
    if (counted && (groups.size() > 1 || hold_pieces(files, groups.begin()->second)))
    {
      return at;
    }
  }
  return {};
}

/// The last number but that at a place.
std::optional<std::int64_t> last_number(
  const std::vector<Digits>& numbers, std::optional<std::size_t> without)
{
  for (std::size_t at = numbers.size(); at-- > 0;)
  {
    const std::string& text = numbers[at].text;
    std::int64_t number = 0;
    if (at != without && parse_int64(text.data(), text.data() + text.size(), number))
    {
      return number;
    }
  }
  return {};
}
}

void name_steps(std::vector<FileIndex>& files, Notices& notices)
{
  std::size_t counted = 0;
  std::string first;
  for (const auto& [rest, family] : families_of(files))
  {
    const std::optional<std::size_t> pieces = place_of_pieces(files, family);
    for (const auto& [number, numbers] : family)
    {
      FileIndex& file = files[number];
      const std::optional<std::int64_t> step = last_number(numbers, pieces);
      const bool counts = file.frames.size() > 1 || !step;
      if (counts && !file.frames.empty() && ++counted == 1)
      {
        first = file.path;
      }
      for (std::size_t i = 0; i < file.frames.size(); ++i)
      {
        file.frames[i].timestep = counts ? static_cast<std::int64_t>(i) : *step;
      }
    }
  }
  if (counted > 1)
  {
    Notice notice;
    notice.where.path = first;
    notice.text = "neither this file nor its name says the timesteps, nor those of " +
      std::to_string(counted - 1) +
      " more: frames of each are counted from 0, and of equal ones those of the last file are "
      "shown";
    notices.push_back(notice);
  }
}
}
