// SPDX-License-Identifier: BSD-3-Clause
// What the tests of runs in many files share: small frames that can be told from each other, and an
// index that is easy to look at.
#ifndef granular_tests_support_series_h
#define granular_tests_support_series_h

#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/frames/run_index.h"

#include "dumps.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

using Files = std::vector<std::string>;
using Steps = std::vector<std::int64_t>;
using Ids = std::vector<std::int64_t>;

/// Consecutive ids.
inline Ids ids_from(std::int64_t first, std::int64_t count)
{
  Ids ids;
  for (std::int64_t i = 0; i < count; ++i)
  {
    ids.push_back(first + i);
  }
  return ids;
}

/// A header of a text dump; bounds is one of the three lines of the box.
inline std::string header(std::int64_t step, std::size_t rows,
  const std::string& columns = "id x y z", const std::string& bounds = "0 1")
{
  return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ATOMS\n" +
    std::to_string(rows) + "\nITEM: BOX BOUNDS pp pp pp\n" + bounds + "\n" + bounds + "\n" +
    bounds + "\nITEM: ATOMS " + columns + "\n";
}

/// A frame of particles with these ids, whose x is the timestep.
inline std::string particles(std::int64_t step, const Ids& ids, const std::string& bounds = "0 1")
{
  std::string text = header(step, ids.size(), "id x y z", bounds);
  for (const std::int64_t id : ids)
  {
    text += std::to_string(id) + " " + std::to_string(step) + " 0.5 0.25\n";
  }
  return text;
}

/// An index, and what it said last.
struct Series
{
  granular::RunIndex index;
  granular::IndexOptions options = { .format = &granular::dump_format() };
  std::string said;

  void update(const Files& files)
  {
    granular::Notices notices;
    granular::Progress progress;
    said = "";
    index.update(files, options, notices, progress);
    said = lines_of(notices);
  }

  Steps steps() const
  {
    Steps steps;
    for (std::size_t i = 0; i < index.size(); ++i)
    {
      steps.push_back(this->entry(i).timestep);
    }
    return steps;
  }

  const granular::FrameEntry& entry(std::size_t frame) const
  {
    return index.first_piece(frame).entry;
  }

  /// The place of the file of a frame among the files.
  std::size_t file(std::size_t frame) const
  {
    return static_cast<std::size_t>(&index.first_piece(frame).file - index.files().data());
  }

  /// "file:offset" of every frame.
  std::string places() const
  {
    std::string text;
    for (std::size_t i = 0; i < index.size(); ++i)
    {
      text += (text.empty() ? "" : " ") + std::to_string(this->file(i)) + ":" +
        std::to_string(this->entry(i).offset);
    }
    return text;
  }

  /// The names of the files that a frame is made of, without their folder, blank-separated.
  std::string names(std::size_t frame) const
  {
    std::string text;
    for (const granular::FramePiece& piece : index.pieces(frame))
    {
      text +=
        (text.empty() ? "" : " ") + std::filesystem::path(piece.file.path).filename().string();
    }
    return text;
  }

  Decoded read(std::size_t frame, const granular::Request& request = {}) const
  {
    Decoded decoded;
    granular::Progress progress;
    decoded.frame = granular::read_dump(index.pieces(frame), request, decoded.notices, progress);
    return decoded;
  }

  Ids ids(std::size_t frame) const { return this->read(frame).integers("id"); }
};

/// Moves the time of last change, so that a change within the clock's tick is one.
inline void touch(const std::string& path, int seconds)
{
  std::filesystem::last_write_time(
    path, std::filesystem::last_write_time(path) + std::chrono::seconds(seconds));
}

#endif
