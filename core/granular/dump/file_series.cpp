// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/file_series.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
using Place = FileSeries::Place;

/// A number in a name: without leading zeros, so that 007 is 7.
struct Digits
{
  std::string text;

  bool operator==(const Digits&) const = default;
  bool operator<(const Digits& other) const
  {
    return std::pair(text.size(), text) < std::pair(other.text.size(), other.text);
  }
};

/// A name, its numbers taken out.
struct NumberedName
{
  std::string rest; ///< with folder, without what compression adds
  std::vector<Digits> numbers;
};

constexpr bool is_digit(char c) noexcept
{
  return c >= '0' && c <= '9';
}

NumberedName split_name(std::string_view path)
{
  for (const std::string_view suffix : { ".gz", ".zst" })
  {
    path = path.ends_with(suffix) ? path.substr(0, path.size() - suffix.size()) : path;
  }
  const std::size_t slash = path.rfind('/');
  const std::size_t start = slash == path.npos ? 0 : slash + 1;
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

/// Files that hold pieces of the same frames.
struct PieceSet
{
  std::vector<std::uint32_t> files; ///< in the order of the pieces
  std::size_t expected = 0;         ///< how many pieces a frame has
  std::string missing;              ///< the numbers that no file of the set has
};

/// Whether files list the same frames, but for a last one that may still be missing in some.
bool list_same_frames(const std::vector<FileIndex>& files, const std::vector<std::uint32_t>& some)
{
  const auto count = [&](std::uint32_t file) { return files[file].frames.size(); };
  const std::vector<FrameEntry>& all = files[*std::ranges::max_element(some, {}, count)].frames;
  std::size_t holders = 0; // files that have frames at all
  for (const std::uint32_t file : some)
  {
    const std::vector<FrameEntry>& frames = files[file].frames;
    const bool same = std::equal(frames.begin(), frames.end(), all.begin(),
      [](const FrameEntry& a, const FrameEntry& b)
      { return a.timestep == b.timestep && a.shape == b.shape; });
    if (!same || frames.size() + 1 < all.size())
    {
      return false;
    }
    holders += frames.empty() ? 0U : 1U;
  }
  return holders > 1;
}

/// The files of a family - names that differ in numbers only - by what one of the numbers is for given
/// others.
using Siblings = std::map<std::vector<Digits>, std::map<Digits, std::uint32_t>>;

Siblings group_by_others(const std::map<std::uint32_t, std::vector<Digits>>& family, std::size_t at)
{
  Siblings groups;
  for (const auto& [file, numbers] : family)
  {
    std::vector<Digits> others = numbers;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
    groups[others][numbers[at]] = file; // of equal numbers the last file
  }
  return groups;
}

/// The sets if the number at that place of the names counts pieces; else none.
std::vector<PieceSet> sets_of(const std::vector<FileIndex>& files, const Siblings& groups)
{
  std::set<Digits> values;
  for (const auto& [others, group] : groups)
  {
    for (const auto& [value, file] : group)
    {
      values.insert(value);
    }
  }
  std::vector<PieceSet> sets;
  std::size_t full = 0;
  for (const auto& [others, group] : groups)
  {
    PieceSet set;
    set.expected = values.size();
    for (const Digits& value : values)
    {
      const auto found = group.find(value);
      if (found == group.end())
      {
        set.missing += " " + value.text;
      }
      else
      {
        set.files.push_back(found->second);
      }
    }
    const bool same =
      values.size() > 1 && (set.files.size() == 1 || list_same_frames(files, set.files));
    full += same && set.files.size() == values.size() ? 1U : 0U;
    if (same)
    {
      sets.push_back(std::move(set));
    }
  }
  return 2 * full > groups.size() ? sets : std::vector<PieceSet>();
}

std::vector<PieceSet> find_piece_sets(const std::vector<FileIndex>& files)
{
  std::map<std::string, std::map<std::uint32_t, std::vector<Digits>>> families;
  for (std::uint32_t i = 0; i < files.size(); ++i)
  {
    NumberedName name = split_name(files[i].path);
    families[name.rest][i] = std::move(name.numbers);
  }
  std::vector<PieceSet> all;
  for (const auto& [rest, family] : families)
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

/// Puts the frames of all files into their order.
class Collector
{
public:
  Collector(const std::vector<FileIndex>& files, RepeatedSteps repeated, Notices& notices);

  void run();

  std::vector<Place> places; ///< as in FileSeries
  std::vector<std::uint32_t> starts;

private:
  static constexpr std::uint32_t alone = std::numeric_limits<std::uint32_t>::max();

  std::int64_t step(const Place& place) const
  {
    return files_[place.file].frames[place.frame].timestep;
  }
  void list_frames();
  void expect_most_pieces(std::span<const Place> sorted);
  void take(std::span<const Place> repeated, bool last);
  bool complete(const std::vector<Place>& pieces, const PieceSet& set, bool last);
  void note_hidden_files();

  const std::vector<FileIndex>& files_;
  RepeatedSteps repeated_;
  Notices& notices_;
  std::vector<PieceSet> sets_;
  std::vector<std::uint32_t> set_of_; ///< of each file: index into sets_, or alone
  std::vector<std::uint32_t> order_;  ///< of each file in its set
  std::vector<bool> shown_; ///< of each file: whether a frame of it is, or why not was said
};

Collector::Collector(const std::vector<FileIndex>& files, RepeatedSteps repeated, Notices& notices)
  : files_(files)
  , repeated_(repeated)
  , notices_(notices)
  , set_of_(files.size(), alone)
  , order_(files.size(), 0)
  , shown_(files.size(), false)
{
  if (repeated == RepeatedSteps::Auto)
  {
    sets_ = find_piece_sets(files);
  }
  if (repeated == RepeatedSteps::Merge)
  {
    sets_.resize(1);
    sets_[0].files.resize(files.size());
    std::iota(sets_[0].files.begin(), sets_[0].files.end(), 0U);
  }
  for (std::uint32_t set = 0; set < sets_.size(); ++set)
  {
    for (std::uint32_t i = 0; i < sets_[set].files.size(); ++i)
    {
      set_of_[sets_[set].files[i]] = set;
      order_[sets_[set].files[i]] = i;
    }
  }
}

void Collector::run()
{
  this->list_frames();
  std::vector<Place> sorted = std::move(places);
  places.clear();
  if (repeated_ == RepeatedSteps::Merge)
  {
    this->expect_most_pieces(sorted);
  }
  for (auto first = sorted.begin(); first != sorted.end();)
  {
    const auto end = std::find_if(first, sorted.end(),
      [&](const Place& place) { return this->step(place) != this->step(*first); });
    this->take({ first, end }, end == sorted.end());
    first = end;
  }
  this->note_hidden_files();
  starts.push_back(static_cast<std::uint32_t>(places.size()));
  if (starts.size() == places.size() + 1)
  {
    starts = {};
  }
  places.shrink_to_fit();
  starts.shrink_to_fit();
}

/// All frames by timestep; of the same timestep in the order of the files.
void Collector::list_frames()
{
  std::size_t count = 0;
  for (const FileIndex& file : files_)
  {
    count += file.frames.size();
  }
  if (count >= alone)
  {
    throw LimitError("expected at most 4294967294 frames, got " + std::to_string(count));
  }
  places.reserve(count);
  for (std::uint32_t file = 0; file < files_.size(); ++file)
  {
    for (std::uint32_t frame = 0; frame < files_[file].frames.size(); ++frame)
    {
      places.push_back({ file, frame });
    }
  }
  std::ranges::stable_sort(places, {}, [this](const Place& place) { return this->step(place); });
}

/// Without names to tell, a frame has as many pieces as the one with the most.
void Collector::expect_most_pieces(std::span<const Place> sorted)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    const bool same_step = i > 0 && this->step(sorted[i]) == this->step(sorted[i - 1]);
    const bool same_file = same_step && sorted[i].file == sorted[i - 1].file;
    count = same_step ? count + (same_file ? 0 : 1) : 1;
    sets_[0].expected = std::max(sets_[0].expected, count);
  }
}

/// Takes what counts of the frames of one timestep: the last, or the pieces that the last belongs to.
void Collector::take(std::span<const Place> repeated, bool last)
{
  const std::uint32_t set = set_of_[repeated.back().file];
  std::vector<Place> pieces;
  for (const Place& place : repeated)
  {
    const bool wanted = set != alone ? set_of_[place.file] == set : &place == &repeated.back();
    if (wanted && !pieces.empty() && pieces.back().file == place.file)
    {
      pieces.back() = place; // repeated within a file
    }
    else if (wanted)
    {
      pieces.push_back(place);
    }
  }
  for (const Place& piece : pieces)
  {
    shown_[piece.file] = true;
  }
  if (set != alone && !this->complete(pieces, sets_[set], last))
  {
    return;
  }
  std::ranges::sort(pieces, {}, [this](const Place& place) { return order_[place.file]; });
  starts.push_back(static_cast<std::uint32_t>(places.size()));
  places.insert(places.end(), pieces.begin(), pieces.end());
}

bool Collector::complete(const std::vector<Place>& pieces, const PieceSet& set, bool last)
{
  if (pieces.size() == set.expected)
  {
    return true;
  }
  if (!last || !set.missing.empty() || repeated_ == RepeatedSteps::Merge)
  {
    const FileIndex& file = files_[pieces.front().file];
    notices_.push_back({ { file.path, file.frames[pieces.front().frame].line },
      "expected " + std::to_string(set.expected) + " pieces of timestep " +
        std::to_string(this->step(pieces.front())) + ", got " + std::to_string(pieces.size()) +
        (set.missing.empty() ? "" : " (none for" + set.missing + ")") +
        "; the frame is left out" });
  }
  return false;
}

/// Says so if all frames of a file are hidden by those of later ones: a restart repeats a step or
/// two, but this is another run, or one file a process that does not look like it.
void Collector::note_hidden_files()
{
  std::vector<const FileIndex*> hidden;
  for (std::size_t i = 0; i < files_.size(); ++i)
  {
    if (!shown_[i] && !files_[i].frames.empty())
    {
      hidden.push_back(&files_[i]);
    }
  }
  if (!hidden.empty())
  {
    const std::size_t others = hidden.size() - 1;
    notices_.push_back({ { hidden.front()->path },
      "no frame of this file" +
        (others > 0 ? ", and of " + std::to_string(others) + " more," : std::string()) +
        " is shown: later files have the same timesteps; if they are pieces of one run, set "
        "RepeatedSteps to Merge" });
  }
}
}

FileSeries::FileSeries(
  const std::vector<FileIndex>& files, RepeatedSteps repeated, Notices& notices)
{
  Collector collector(files, repeated, notices);
  collector.run();
  places_ = std::move(collector.places);
  starts_ = std::move(collector.starts);
}

std::span<const FileSeries::Place> FileSeries::pieces(std::size_t frame) const noexcept
{
  return starts_.empty()
    ? std::span(places_).subspan(frame, 1)
    : std::span(places_).subspan(starts_[frame], starts_[frame + 1] - starts_[frame]);
}
}
