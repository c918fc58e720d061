// SPDX-License-Identifier: BSD-3-Clause
// Index files that somebody made up, with a hash that fits: what a user sees is what the files hold, or an error; never fewer
// frames, never other times, in silence.
#include "../support/byte_source_packing.h"
#include "../support/frame_content.h"
#include "../support/index_damage.h"
#include "../support/own_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace
{
using granular::FileIndex;
using granular::FrameEntry;
using Forge = std::function<void(FileIndex& file)>;
using ForgedIndex = OwnFolder;

constexpr std::size_t frames = 6;
constexpr std::size_t rows = 12'000; // so many that compressed files have seek points

/// The seek points of a compressed file; none of others.
std::span<granular::SeekPoints::Point> points_of(FileIndex& file)
{
  return file.points ? std::span(file.points->points) : std::span<granular::SeekPoints::Point>();
}

/// What somebody may want of an index. The file has six frames.
const std::vector<std::pair<const char*, Forge>> forgeries = {
  { "the first frame hidden", [](FileIndex& file) { file.frames.erase(file.frames.begin()); } },
  { "a frame hidden", [](FileIndex& file) { file.frames.erase(file.frames.begin() + 2); } },
  { "two frames hidden",
    [](FileIndex& file) { file.frames.erase(file.frames.begin() + 2, file.frames.begin() + 4); } },
  { "the last frame hidden", [](FileIndex& file) { file.frames.pop_back(); } },
  { "all but the first hidden", [](FileIndex& file) { file.frames.resize(1); } },
  { "all but the first hidden, as if the file had no seek points",
    [](FileIndex& file)
    {
      file.frames.resize(1);
      file.points.reset();
    } },
  { "a frame hidden in the one before",
    [](FileIndex& file)
    {
      file.frames[1].end = file.frames[2].end;
      file.frames.erase(file.frames.begin() + 2);
    } },
  { "a frame hidden in the one behind",
    [](FileIndex& file)
    {
      file.frames[3].offset = file.frames[2].offset;
      file.frames.erase(file.frames.begin() + 2);
    } },
  { "the last frame hidden in the one before",
    [](FileIndex& file)
    {
      file.frames[frames - 2].end = file.frames[frames - 1].end;
      file.frames.pop_back();
    } },
  { "two timesteps swapped",
    [](FileIndex& file) { std::swap(file.frames[2].timestep, file.frames[3].timestep); } },
  { "a timestep of another frame",
    [](FileIndex& file) { file.frames[2].timestep = file.frames[3].timestep; } },
  { "fewer rows", [](FileIndex& file) { --file.frames[2].rows; } },
  { "a time", [](FileIndex& file) { file.frames[2].time = 1; } },
  { "a line", [](FileIndex& file) { file.frames[2].line += 1; } },
  { "another box or columns", [](FileIndex& file) { ++file.frames[2].shape; } },
  { "packed or not", [](FileIndex& file) { file.compressed = !file.compressed; } },
  { "units", [](FileIndex& file) { file.units = "real"; } },
  { "seek points elsewhere",
    [](FileIndex& file)
    {
      for (granular::SeekPoints::Point& point : points_of(file))
      {
        point.packed += 7;
      }
    } },
  { "other windows",
    [](FileIndex& file)
    {
      for (granular::SeekPoints::Point& point : points_of(file))
      {
        std::ranges::fill(point.window, '1');
      }
    } },
  { "files beside it",
    [](FileIndex& file) {
      file.beside = { { "../../../../etc/passwd", {} }, { "/dev/zero", {} } };
    } },
  { "renamed columns",
    [](FileIndex& file)
    {
      for (FrameEntry& frame : file.frames)
      {
        granular::FrameKind kind = *frame.kind;
        std::vector<std::string> names;
        for (const granular::ColumnInfo& column : kind.schema.columns())
        {
          names.push_back(column.name);
        }
        std::swap(names.front(), names.back());
        kind.schema = granular::ColumnSchema(names);
        frame.kind = std::make_shared<const granular::FrameKind>(kind);
      }
    } },
};

std::string text_run()
{
  std::string text;
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    text += "ITEM: TIMESTEP\n" + std::to_string(100 * frame) + "\nITEM: NUMBER OF ATOMS\n" +
      std::to_string(rows) + "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z q\n";
    for (std::size_t row = 0; row < rows; ++row)
    {
      text += std::to_string(row + 1) + " 0." + std::to_string(row * 7919 % 9973) + " 0." +
        std::to_string((row + frame) * 104729 % 9973) + " 0.5 " + std::to_string(frame) + "\n";
    }
  }
  return text;
}

std::string shown(const granular::RunIndex& index, std::size_t frame)
{
  granular::Notices notices;
  granular::Progress progress;
  const FrameContent all =
    content_of(granular::read_dump(index.pieces(frame), {}, notices, progress));
  std::string seen = all.head + std::to_string(all.rows) + "\n";
  for (const std::string& values : all.values)
  {
    seen += values;
  }
  return seen;
}

/// Takes away the frame before the first seek point, and moves all that follows to its place.
void hide_before_point(FileIndex& file)
{
  const std::span points = points_of(file);
  ASSERT_FALSE(points.empty());
  const auto hidden = std::ranges::find(file.frames, points.front().offset, &FrameEntry::end);
  ASSERT_NE(hidden, file.frames.end());
  const std::int64_t bytes = hidden->end - hidden->offset;
  for (auto later = hidden + 1; later != file.frames.end(); ++later)
  {
    later->offset -= bytes;
    later->end -= bytes;
  }
  for (granular::SeekPoints::Point& point : points)
  {
    point.offset -= bytes;
  }
  file.resume_offset -= bytes;
  file.frames.erase(hidden);
}

/// What of the forgeries is seen otherwise than without them, one a line. Expects that all but `without` change the index.
std::string silent(const std::string& path, const std::string& without)
{
  index_damage::Run run;
  run.files = { path };
  run.show = shown;
  granular::Notices notices;
  const std::string right = index_damage::open_and_show(run, notices);
  const std::string good = index_damage::content(run.kept());
  index_damage::Outcomes outcomes;
  std::string unchanged;
  for (const auto& [what, forge] : forgeries)
  {
    std::vector<FileIndex> files =
      granular::decode_index(good, path, std::make_shared<granular::FrameKinds>());
    EXPECT_EQ(files.size(), 1u);
    EXPECT_EQ(files.front().frames.size(), frames);
    EXPECT_EQ(granular::encode_index(files), good); // what differs below is forged
    forge(files.front());
    const std::string bytes = granular::encode_index(files);
    if (bytes == good)
    {
      unchanged += std::string(what) + "\n";
      continue;
    }
    index_damage::judge(run, bytes, right, what, outcomes);
  }
  EXPECT_EQ(unchanged, without);
  return outcomes.silent;
}
}

TEST_F(ForgedIndex, Text)
{
  EXPECT_EQ(
    silent(this->write("a.dump", text_run()), "seek points elsewhere\nother windows\n"), "");
}

TEST_F(ForgedIndex, Gzip)
{
  EXPECT_EQ(silent(this->write("a.dump.gz", packing::gzip(text_run())), ""), "");
}

TEST_F(ForgedIndex, Zstandard)
{
  EXPECT_EQ(
    silent(this->write("a.dump.zst", packing::zstd_frames(text_run(), 100'000)), "other windows\n"),
    "");
}

// The known limit that docs/developers/index_file.md tells of: nothing before the start of a Zstandard frame can be compared.
TEST_F(ForgedIndex, AFrameBeforeAZstandardFrameCanBeHidden)
{
  const std::string text = text_run();
  std::string packed;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end)
  {
    end = std::min(text.find("ITEM: TIMESTEP", begin + 1), text.size());
    packed += packing::zstd(text.substr(begin, end - begin));
  }
  index_damage::Run run;
  run.files = { this->write("a.dump.zst", packed) };
  run.show = shown;
  granular::Notices notices;
  const std::string right = index_damage::open_and_show(run, notices);
  std::vector<FileIndex> files = granular::decode_index(
    index_damage::content(run.kept()), run.files.front(), std::make_shared<granular::FrameKinds>());
  hide_before_point(files.front());
  index_damage::Outcomes outcomes;
  index_damage::judge(run, granular::encode_index(files), right, "hidden", outcomes);
  EXPECT_EQ(outcomes.silent, "hidden\n");
}

// A run that was killed and goes on has half a frame in its middle, which a warning tells of each time.
TEST_F(ForgedIndex, AFrameThatWasLeftOutIsNoForgery)
{
  std::string text = text_run();
  const std::size_t third = text.find("ITEM: TIMESTEP\n200");
  text.erase(third - 3000, 3000);
  for (const bool packed : { false, true })
  {
    const std::string path =
      packed ? this->write("a.dump.gz", packing::gzip(text)) : this->write("a.dump", text);
    granular::IndexOptions options{ .format = &granular::dump_format(),
      .keep_index = granular::KeepIndex::Beside };
    std::string bytes;
    for (int opening = 0; opening < 3; ++opening)
    {
      granular::RunIndex run;
      granular::Notices notices;
      granular::Progress progress;
      run.update({ path }, options, notices, progress);
      EXPECT_EQ(run.size(), frames - 1);
      EXPECT_EQ(notices.size(), 1u);
      const std::string kept = path + ".granular.idx";
      if (opening == 1)
      {
        bytes = std::to_string(std::filesystem::file_size(kept)) + " " +
          std::to_string(std::filesystem::last_write_time(kept).time_since_epoch().count());
      }
      if (opening == 2)
      {
        EXPECT_EQ(bytes,
          std::to_string(std::filesystem::file_size(kept)) + " " +
            std::to_string(std::filesystem::last_write_time(kept).time_since_epoch().count()))
          << "the index was made anew";
      }
    }
  }
}

TEST_F(ForgedIndex, TheCacheIsTheUsersOwn)
{
  const std::string path = this->write("a.dump", text_run());
  ::setenv("XDG_CACHE_HOME", this->path("cache").c_str(), 1);
  granular::IndexOptions options{ .format = &granular::dump_format(),
    .keep_index = granular::KeepIndex::Cache };
  granular::RunIndex run;
  granular::Notices notices;
  granular::Progress progress;
  run.update({ path }, options, notices, progress);
  EXPECT_EQ(notices.size(), 0u);
  EXPECT_EQ(std::filesystem::status(this->path("cache/granular")).permissions(),
    std::filesystem::perms::owner_all);
  EXPECT_FALSE(std::filesystem::is_empty(this->path("cache/granular")));
}
