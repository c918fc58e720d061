// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/run_index_parts.h"

#include "granular/common/error.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>

namespace granular
{
namespace
{
using Place = FrameOrder::Place;

/// Puts the frames of all files into their order.
class Collector
{
public:
  Collector(const std::vector<FileIndex>& files, RepeatedSteps repeated, Notices& notices)
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

  FrameOrder run()
  {
    const std::vector<Place> sorted = this->list_frames();
    if (repeated_ == RepeatedSteps::Merge)
    {
      this->expect_most_pieces(sorted);
    }
    for (auto first = sorted.begin(); first != sorted.end();)
    {
      const auto end = std::find_if(first, sorted.end(),
        [&](const Place& place) { return this->step(place) != this->step(*first); });
      this->take({ first, end });
      first = end;
    }
    if (all_written_)
    {
      this->say_what_waits();
    }
    if (waiting_.size() > 1) // one is as usual while the simulation runs
    {
      notices_.push_back({ waiting_.front().where,
        "expected all pieces of this frame and of " + std::to_string(waiting_.size() - 1) +
          " more, got a part; they are left out until all are there" });
    }
    this->note_hidden_files();
    this->note_repeated();
    result_.places.shrink_to_fit();
    result_.starts.shrink_to_fit();
    return std::move(result_);
  }

private:
  static constexpr std::uint32_t alone = std::numeric_limits<std::uint32_t>::max();

  std::int64_t step(const Place& place) const
  {
    return files_[place.file].frames[place.frame].timestep;
  }

  /// All frames by timestep; of the same timestep in the order of the files.
  std::vector<Place> list_frames() const
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
    std::vector<Place> places;
    places.reserve(count);
    for (std::uint32_t file = 0; file < files_.size(); ++file)
    {
      for (std::uint32_t frame = 0; frame < files_[file].frames.size(); ++frame)
      {
        places.push_back({ file, frame });
      }
    }
    std::ranges::stable_sort(places, {}, [this](const Place& place) { return this->step(place); });
    return places;
  }

  /// Without names to tell, a frame has as many pieces as the one with the most.
  void expect_most_pieces(std::span<const Place> sorted)
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

  /// Takes what counts of the frames of one timestep: the last, or all pieces of the last set that is
  /// complete.
  void take(std::span<const Place> repeated)
  {
    for (std::size_t i = 1; i < repeated.size(); ++i)
    {
      if (repeated[i].file == repeated[i - 1].file)
      {
        ++again_.try_emplace(repeated[i].file, repeated[i], 0).first->second.second;
      }
    }
    std::set<std::uint32_t> tried;
    std::string wrong;
    for (auto last = repeated.rbegin(); last != repeated.rend(); ++last)
    {
      const std::uint32_t number = set_of_[last->file];
      if (number != alone && !tried.insert(number).second)
      {
        continue;
      }
      const std::vector<Place> pieces = this->pieces_of(repeated, *last);
      for (const Place& piece : pieces)
      {
        shown_[piece.file] = true;
      }
      const std::string text = number == alone ? "" : this->complaint(pieces, sets_[number]);
      if (text.empty())
      {
        this->say_what_waits();
        result_.places.insert(result_.places.end(), pieces.begin(), pieces.end());
        result_.starts.push_back(static_cast<std::uint32_t>(result_.places.size()));
        return;
      }
      wrong = wrong.empty() ? text : wrong;
      all_written_ = all_written_ || pieces.size() == sets_[number].expected ||
        !this->being_written(sets_[number]);
    }
    const Place& first = repeated.front();
    waiting_.push_back(
      { where_of(files_[first.file].path, files_[first.file].frames[first.frame]), wrong });
  }

  /// The frames of the set of the last one, each the last of its file, in the order of the pieces.
  std::vector<Place> pieces_of(std::span<const Place> repeated, const Place& last) const
  {
    const std::uint32_t set = set_of_[last.file];
    if (set == alone)
    {
      return { last };
    }
    std::vector<Place> pieces;
    for (const Place& place : repeated)
    {
      if (set_of_[place.file] != set)
      {
        continue;
      }
      if (!pieces.empty() && pieces.back().file == place.file)
      {
        pieces.pop_back();
      }
      pieces.push_back(place);
    }
    std::ranges::sort(pieces, {}, [this](const Place& place) { return order_[place.file]; });
    return pieces;
  }

  /// Returns the fault of a frame; empty if it is complete.
  std::string complaint(const std::vector<Place>& pieces, const PieceSet& set) const
  {
    const auto shape = [this](const Place& place)
    { return files_[place.file].frames[place.frame].shape; };
    const std::string what = " of timestep " + std::to_string(this->step(pieces.front()));
    if (pieces.size() != set.expected)
    {
      return "expected " + std::to_string(set.expected) + " pieces" + what + ", got " +
        std::to_string(pieces.size()) +
        (set.missing.empty() ? "" : " (none for" + set.missing + ")") + "; the frame is left out";
    }
    // what the user calls pieces is for the reader to refuse, who says which of them is none
    const bool same = repeated_ == RepeatedSteps::Merge ||
      std::ranges::all_of(
        pieces, [&](const Place& place) { return shape(place) == shape(pieces.front()); });
    return same ? ""
                : "expected pieces" + what +
        " with the same box and columns, got others; the frame is left out";
  }

  /// Returns true if the pieces that are missing may still come.
  bool being_written(const PieceSet& set) const
  {
    return set.missing.empty() &&
      std::ranges::none_of(
        set.files, [this](std::uint32_t file) { return files_[file].error != nullptr; });
  }

  void say_what_waits()
  {
    // a great many frames may lack the same file
    constexpr std::size_t most = 10;
    const std::size_t count = std::min(most, waiting_.size());
    notices_.insert(
      notices_.end(), waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
    if (waiting_.size() > most)
    {
      notices_.push_back({ waiting_[most].where,
        "pieces are missing of this frame, too, and of " +
          std::to_string(waiting_.size() - most - 1) + " that follow; they are left out" });
    }
    waiting_.clear();
    all_written_ = false;
  }

  /// Says so if all frames of a file are hidden by those of later ones: a restart repeats a step or
  /// two, but this is another run, or one file a process that does not look like it.
  void note_hidden_files()
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
      const std::int64_t first = hidden.front()->frames.front().timestep;
      const auto instead = std::ranges::find_if(
        result_.places, [&](const Place& place) { return this->step(place) == first; });
      notices_.push_back({ { hidden.front()->path },
        "no frame of this file" +
          (others > 0 ? ", and of " + std::to_string(others) + " more," : std::string()) +
          " is shown: later files have the same timesteps" +
          (instead == result_.places.end()
              ? ""
              : ", such as " + shown_path(files_[instead->file].path)) +
          "; leave out files of other runs, or, if these are pieces of one run, set RepeatedSteps "
          "to "
          "Merge" });
    }
  }

  /// Says which timesteps come again in a file, as of a run that was restarted.
  void note_repeated()
  {
    for (const auto& [file, first] : again_)
    {
      const auto& [place, count] = first;
      notices_.push_back({ where_of(files_[file].path, files_[file].frames[place.frame]),
        "timestep " + std::to_string(this->step(place)) + " comes again in this file" +
          (count > 1 ? ", as do " + std::to_string(count - 1) + " more" : "") +
          "; the last frame of a timestep is shown",
        "repeated" });
    }
  }

  const std::vector<FileIndex>& files_;
  RepeatedSteps repeated_;
  Notices& notices_;
  FrameOrder result_;
  std::vector<PieceSet> sets_;
  std::vector<std::uint32_t> set_of_; ///< of each file: index into sets_, or alone
  std::vector<std::uint32_t> order_;  ///< of each file in its set
  std::vector<bool> shown_; ///< of each file: whether a frame of it is, or why not was said
  std::map<std::uint32_t, std::pair<Place, std::size_t>>
    again_;         ///< of files: the first frame of a timestep that was there, and how many
  Notices waiting_; ///< of frames that are not complete, since the last that is
  bool all_written_ = false; ///< some of these never will be
};
}

FrameOrder order_frames(
  const std::vector<FileIndex>& files, RepeatedSteps repeated, Notices& notices)
{
  return Collector(files, repeated, notices).run();
}
}
