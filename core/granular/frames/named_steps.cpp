// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/named_steps.h"

#include "granular/numbers/number.h"
#include "granular/numbers/number_scan.h"

#include <algorithm>
#include <optional>
#include <string>

namespace granular
{
namespace
{
bool counts_from_zero(const std::map<NameNumber, std::uint32_t>& group)
{
  std::size_t next = 0;
  return std::ranges::all_of(
    group, [&](const auto& entry) { return entry.first.text == std::to_string(next++); });
}

/// Returns true if the contents of the files say that they are pieces: see name_steps.
bool hold_pieces(
  const std::vector<FileIndex>& files, const std::map<NameNumber, std::uint32_t>& group)
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
  for (std::size_t at = 0; at < places; ++at)
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

/// Which numbers of a family may be the timestep, best first: the last that differs between files, but not that
/// which counts pieces; then those that are the same for all.
std::vector<std::size_t> places_of_step(const Family& family, std::optional<std::size_t> pieces)
{
  std::vector<std::size_t> places;
  const std::vector<NameNumber>& first = family.begin()->second;
  for (const bool differ : { true, false })
  {
    for (std::size_t at = first.size(); at-- > 0;)
    {
      const bool differs = std::ranges::any_of(
        family, [&](const auto& entry) { return entry.second[at] != first[at]; });
      if (at != pieces && differs == differ)
      {
        places.push_back(at);
      }
    }
  }
  return places;
}

/// The first of these numbers that fits.
std::optional<std::int64_t> number_at(
  const std::vector<NameNumber>& numbers, const std::vector<std::size_t>& places)
{
  for (const std::size_t at : places)
  {
    const std::string& text = numbers[at].text;
    std::int64_t number = 0;
    if (parse_int64(text.data(), text.data() + text.size(), number))
    {
      return number;
    }
  }
  return {};
}
}

NumberedName split_name(std::string_view path)
{
  for (const std::string_view suffix : { ".gz", ".zst" })
  {
    path = path.ends_with(suffix) ? path.substr(0, path.size() - suffix.size()) : path;
  }
  const std::size_t start = path.rfind('/') + 1; // 0 without a slash
  NumberedName name = { std::string(path.substr(0, start)), {} };
  for (const char *at = path.data() + start, *end = path.data() + path.size(); at < end;)
  {
    const char* const last = std::find_if_not(at, end, is_digit);
    if (last == at)
    {
      name.rest += *at++;
      continue;
    }
    at = std::find_if(at, last - 1, [](char c) { return c != '0'; });
    name.rest += '*';
    name.numbers.push_back({ std::string(at, last) });
    at = last;
  }
  return name;
}

std::map<std::string, Family> families_of(const std::vector<FileIndex>& files)
{
  std::map<std::string, Family> families;
  for (std::uint32_t i = 0; i < files.size(); ++i)
  {
    NumberedName name = split_name(files[i].path);
    families[name.rest][i] = std::move(name.numbers);
  }
  return families;
}

Siblings group_by_others(const Family& family, std::size_t at)
{
  Siblings groups;
  for (const auto& [file, numbers] : family)
  {
    std::vector<NameNumber> others = numbers;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
    groups[others][numbers[at]] = file; // of equal numbers the last file
  }
  return groups;
}

void mark_pieces(std::vector<FileIndex>& files)
{
  for (FileIndex& file : files)
  {
    for (FrameEntry& frame : file.frames)
    {
      frame.shape = 1;
    }
  }
}

void name_steps(std::vector<FileIndex>& files, Notices& notices)
{
  std::size_t counted = 0;
  std::string first;
  for (const auto& [rest, family] : families_of(files))
  {
    const std::optional<std::size_t> pieces = place_of_pieces(files, family);
    const std::vector<std::size_t> places = places_of_step(family, pieces);
    for (const auto& [number, numbers] : family)
    {
      FileIndex& file = files[number];
      const std::optional<std::int64_t> step = number_at(numbers, places);
      const bool counts = file.frames.size() > 1 || !step;
      if (counts && !pieces && !file.frames.empty() && ++counted == 1)
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
