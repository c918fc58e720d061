// SPDX-License-Identifier: BSD-3-Clause
// Series, files and lines much longer than usual, of all kinds: what comes out is right, and memory stays below a stated bound.
// Quick here; with GRANULAR_LOAD=full a million files, a million frames, a line of 1 GiB and files above 100 GiB.
#include "load.h"

#include "../c/handles.h"
#include "../support/binary_dumps.h"
#include "../support/dumps.h"
#include "../support/many_columns.h"
#include "../support/own_folder.h"
#include "../support/series.h"
#include "../support/sparse_file.h"

#include "granular.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace
{
/// A run that was opened, or why not.
struct Opened
{
  RunHandle run = { nullptr, granular_close };
  std::string error;
  std::string notices;
};

Opened open_kind(const std::string& path, granular_kind kind, const char* column_names = nullptr)
{
  Opened opened;
  granular_open_options options;
  granular_open_options_init(&options);
  options.kind = kind;
  options.column_names = column_names;
  options.user = &opened.notices;
  options.notice = [](const granular_error* remark, void* user)
  { *static_cast<std::string*>(user) += std::string(remark->message) + "\n"; };
  granular_run* run = nullptr;
  const char* const name = path.c_str();
  opened.error = granular_open(&name, 1, &options, &run) == GRANULAR_OK ? "" : message();
  opened.run.reset(run);
  return opened;
}

std::int64_t frames_of(const RunHandle& run)
{
  granular_run_facts facts = {};
  EXPECT_EQ(granular_run_info(run.get(), &facts), GRANULAR_OK) << message();
  return facts.frames;
}

/// Expects a frame of one particle whose x is the timestep.
void expect_frame(const RunHandle& run, std::int64_t frame, std::int64_t step)
{
  granular_frame_facts facts = {};
  ASSERT_EQ(granular_frame_info(run.get(), frame, &facts), GRANULAR_OK) << message();
  EXPECT_EQ(facts.timestep, step);
  EXPECT_EQ(doubles(read_frame(run, frame), "points").at(0), static_cast<double>(step));
}

void expect_frames(const RunHandle& run, std::int64_t count)
{
  ASSERT_EQ(frames_of(run), count);
  for (const std::int64_t frame : { std::int64_t{ 0 }, count / 3, count - 1 })
  {
    expect_frame(run, frame, frame);
  }
}

std::string particle(std::int64_t step)
{
  return header(step, 1) + "1 " + std::to_string(step) + " 0 0\n";
}

/// A folder of the test, deleted at the end: it may take 4 GiB.
class LoadFiles : public OwnFolder
{
protected:
  void TearDown() override { std::filesystem::remove_all(this->folder()); }
};

/// Returns the frames of a file, or -1 after an error of opening or of the last frame, in memory that does not depend on its size.
std::int64_t frames_in(const std::string& what, const std::string& path, granular_kind kind)
{
  Load load(what);
  std::int64_t frames = -1;
  if (const Opened opened = open_kind(path, kind); opened.error.empty())
  {
    granular_frame* frame = nullptr;
    frames = frames_of(opened.run);
    const granular_status status = granular_read(opened.run.get(), frames - 1, nullptr, &frame);
    frames = status == GRANULAR_OK ? frames : -1;
    granular_release(frame);
  }
  load.expect_closed();
  load.end(32 * mebibyte);
  return frames;
}
}

// ---- many files --------------------------------------------------------------------------------
TEST_F(LoadFiles, SeriesOfDumps)
{
  const std::int64_t count = size_of_load(10'000, 1'000'000);
  for (std::int64_t i = 0; i < count; ++i)
  {
    this->write("run_" + std::to_string(i) + ".dump", particle(i));
  }
  const std::string pattern = this->path("run_*.dump");
  Load load("dumps in one folder");
  {
    const Opened opened = open_kind(pattern, GRANULAR_KIND_AUTOMATIC);
    ASSERT_EQ(opened.error + opened.notices, "");
    expect_frames(opened.run, count);
    load.expect_closed();
  }
  load.end(16 * mebibyte + count * 1024 * 3 / 2);
}

// ---- many frames in a file ---------------------------------------------------------------------
namespace
{
/// Writes a file of that many frames, and appends one when it was opened.
void expect_file(const std::string& path, const char* what,
  const std::function<std::string(std::int64_t)>& frame, const char* column_names = nullptr)
{
  const std::int64_t count = size_of_load(10'000, 1'000'000);
  std::ofstream file(path, std::ios::binary);
  for (std::int64_t i = 0; i < count; ++i)
  {
    file << frame(i);
  }
  file.flush();
  Load load(what);
  {
    const Opened opened = open_kind(path, GRANULAR_KIND_AUTOMATIC, column_names);
    ASSERT_EQ(opened.error + opened.notices, "");
    expect_frames(opened.run, count);
    file << frame(count);
    file.flush();
    ASSERT_EQ(granular_refresh(opened.run.get(), nullptr, nullptr, nullptr), GRANULAR_OK);
    expect_frames(opened.run, count + 1);
    load.expect_closed();
  }
  load.end(24 * mebibyte + count * 400);
}
}

TEST_F(LoadFiles, FramesOfATextDump)
{
  expect_file(this->path("a.dump"), "frames of a text dump", particle);
}

TEST_F(LoadFiles, FramesOfABinaryDump)
{
  const binary::Form& form = binary::form("plain, little-endian");
  const auto frame = [&form](std::int64_t step)
  {
    binary::Frame one;
    one.timestep = step;
    one.size_one = 4;
    one.chunks = { { 1, static_cast<double>(step), 0, 0 } };
    return binary::write(form, { one }).bytes;
  };
  expect_file(this->path("a.bin"), "frames of a binary dump", frame, "id x y z");
}

// ---- many columns: more in tests/dump/many_columns.cpp -----------------------------------------
TEST_F(LoadFiles, ManyColumns)
{
  const std::string path = this->write(
    "a.dump", one_frame(line_of_many("id x y z", "a#"), line_of_many("1 0.5 0.5 0.5", "#") + "\n"));
  Load load("columns, of which two are read");
  {
    const Opened opened = open_kind(path, GRANULAR_KIND_AUTOMATIC);
    ASSERT_EQ(opened.error + opened.notices, "");
    const char* const names[] = { "a3", "a4996" };
    granular_request request;
    granular_request_init(&request);
    request.arrays = names;
    request.array_count = 2;
    const FrameHandle frame = read_frame(opened.run, 0, &request);
    EXPECT_EQ(doubles(frame, "a3"), std::vector<double>{ 3 });
    EXPECT_EQ(doubles(frame, "a4996"), std::vector<double>{ 4996 });
  }
  load.end(many_columns * 2048);
}

// ---- a long line -------------------------------------------------------------------------------
namespace
{
/// Writes a text, a piece that is repeated up to so many bytes, and more text.
void write_long(
  const std::string& path, const std::string& head, std::string piece, const std::string& tail)
{
  const std::int64_t bytes = size_of_load(std::int64_t{ 1 } << 26, std::int64_t{ 1 } << 30);
  while (piece.size() < (1 << 20))
  {
    piece += piece;
  }
  std::ofstream file(path, std::ios::binary);
  file << head;
  for (std::int64_t done = 0; done < bytes; done += static_cast<std::int64_t>(piece.size()))
  {
    file << piece;
  }
  file << tail;
}
}

TEST_F(LoadFiles, ALongLine)
{
  const std::string path = this->path("a");
  write_long(path, header(0, 2) + "1 0.5 0.5 0.5", " 17", "\n2 0.5 0.5 0.5\n");
  EXPECT_EQ(frames_in("a row", path, GRANULAR_KIND_DUMP), -1);
  write_long(path, particle(7) + header(8, 2) + "1 0.5 0.5 ", "3", "");
  EXPECT_EQ(frames_in("a last row without an end", path, GRANULAR_KIND_DUMP), 1);
  write_long(path, "", "a", "");
  for (int kind = GRANULAR_KIND_AUTOMATIC; kind <= GRANULAR_KIND_DECOMPOSITION; ++kind)
  {
    EXPECT_EQ(
      frames_in("a file without an end of a line", path, static_cast<granular_kind>(kind)), -1)
      << kind;
  }
}

// ---- sparse files ------------------------------------------------------------------------------
namespace
{
/// A good file, and its frames with a hole behind it and with one in its middle; -1: an error.
struct Holed
{
  granular_kind kind;
  const char* name;
  std::int64_t behind;
  std::int64_t inside;
};

constexpr Holed holed_files[] = {
  { GRANULAR_KIND_DUMP, "grains_1000.dump", 1, -1 },
  { GRANULAR_KIND_LOCAL, "local/contacts.dump", 5, -1 },
  { GRANULAR_KIND_RESTART, "restart/fibres.restart", -1, -1 },
  { GRANULAR_KIND_DATA_FILE, "data_file/granular.data", -1, -1 },
  { GRANULAR_KIND_EULER, "euler_1000.vtk", 1, -1 },
  { GRANULAR_KIND_DECOMPOSITION, "decomposition_1000.vtk", 1, -1 },
};
}

TEST_F(LoadFiles, ZerosBehindAFileAndInIt)
{
  for (const Holed& holed : holed_files)
  {
    const std::string bytes = content(good(holed.name));
    for (const bool inside : { false, true })
    {
      const std::size_t at = inside ? bytes.size() / 2 : bytes.size();
      SparseFile file(this->path("zeros"));
      file.append(bytes.substr(0, at));
      file.append_hole(size_of_load(std::int64_t{ 1 } << 26, std::int64_t{ 120 } << 30));
      file.append(bytes.substr(at));
      if (!file.good())
      {
        GTEST_SKIP() << "the file system has no sparse files of this size";
      }
      EXPECT_EQ(frames_in(std::string(inside ? "zeros in " : "zeros behind ") + holed.name,
                  file.path(), holed.kind),
        inside ? holed.inside : holed.behind);
    }
  }
}
