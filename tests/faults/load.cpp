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

#include <cerrno>
#include <cstring>
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
  options.notice = [](const char* text, void* user)
  { *static_cast<std::string*>(user) += std::string(text) + "\n"; };
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

/// Expects a frame of one particle, contact or cell whose number is the timestep.
void expect_frame(const RunHandle& run, std::int64_t frame, std::int64_t step, const char* name)
{
  granular_frame_facts facts = {};
  ASSERT_EQ(granular_frame_info(run.get(), frame, &facts), GRANULAR_OK) << message();
  EXPECT_EQ(facts.timestep, step);
  EXPECT_EQ(doubles(read_frame(run, frame), name).at(0), static_cast<double>(step));
}

void expect_frames(const RunHandle& run, std::int64_t count, const char* name)
{
  ASSERT_EQ(frames_of(run), count);
  for (const std::int64_t frame : { std::int64_t{ 0 }, count / 3, count - 1 })
  {
    expect_frame(run, frame, frame, name);
  }
}

std::string particle(std::int64_t step)
{
  return header(step, 1) + "1 " + std::to_string(step) + " 0 0\n";
}

std::string contact(std::int64_t step)
{
  const std::string text = header(step, 1, "x1 y1 z1 x2 y2 z2 c_f");
  return replaced(
           replaced(text, "ITEM: ATOMS", "ITEM: ENTRIES"), "NUMBER OF ATOMS", "NUMBER OF ENTRIES") +
    "0 0 0 1 1 1 " + std::to_string(step) + "\n";
}

std::string cell(std::int64_t step)
{
  std::string text =
    "# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\nDATASET POLYDATA\n"
    "POINTS 1 float\n0.5 0.5 0.5\nVERTICES 1 2\n1 0\nPOINT_DATA 1\nVECTORS v_avg float\n1 2 3\n";
  for (const char* const name : { "volumefraction", "radius", "pressure" })
  {
    text += std::string("SCALARS ") + name + " float 1\nLOOKUP_TABLE default\n" +
      std::to_string(step) + "\n";
  }
  return text;
}

/// A folder of the test, deleted at the end: it may take 4 GiB.
class LoadFiles : public OwnFolder
{
protected:
  void TearDown() override { std::filesystem::remove_all(this->folder()); }

  /// Writes run_0, run_1, ... with so many in a folder each, and returns their pattern.
  std::string write_series(std::int64_t count, std::int64_t per_folder, const std::string& end,
    const std::function<std::string(std::int64_t)>& content) const
  {
    const bool one = per_folder >= count;
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::string part = one ? "" : "part_" + std::to_string(i / per_folder) + "/";
      if (!one && i % per_folder == 0)
      {
        std::filesystem::create_directory(this->path(part));
      }
      this->write(part + "run_" + std::to_string(i) + end, content(i));
    }
    return this->path((one ? "run_*" : "part_*/run_*") + end);
  }

  void expect_series(const std::string& what, std::int64_t count, std::int64_t per_folder,
    const std::string& end, const std::function<std::string(std::int64_t)>& content,
    const char* name) const
  {
    const std::string pattern = this->write_series(count, per_folder, end, content);
    Load load(what);
    {
      const Opened opened = open_kind(pattern, GRANULAR_KIND_AUTOMATIC);
      ASSERT_EQ(opened.error + opened.notices, "");
      expect_frames(opened.run, count, name);
      load.expect_closed();
    }
    load.end(16 * mebibyte + count * 1024 * 3 / 2);
  }
};

using LoadSeries = LoadFiles;
using LoadFrames = LoadFiles;
using LoadLine = LoadFiles;
using LoadSparse = LoadFiles;

/// What comes of a file: an error, or how many frames it has and what comes of the last; without the path.
std::string outcome(const std::string& path, granular_kind kind)
{
  const Opened opened = open_kind(path, kind);
  if (!opened.error.empty())
  {
    return replaced(opened.error, path, "");
  }
  const std::int64_t frames = frames_of(opened.run);
  granular_frame* frame = nullptr;
  const bool good = granular_read(opened.run.get(), frames - 1, nullptr, &frame) == GRANULAR_OK;
  granular_release(frame);
  return std::to_string(frames) + " frames, " +
    (good ? "the last is read" : replaced(message(), path, ""));
}

/// Expects that of a file of any size, in memory that does not depend on its size.
void expect_outcome(
  const std::string& what, const std::string& path, granular_kind kind, const std::string& expected)
{
  Load load(what);
  EXPECT_EQ(outcome(path, kind), expected) << what;
  load.expect_closed();
  load.end(32 * mebibyte);
}
}

// ---- many files --------------------------------------------------------------------------------
TEST_F(LoadSeries, OfDumps)
{
  this->expect_series(
    "dumps in one folder", size_of_load(10'000, 1'000'000), 1 << 30, ".dump", particle, "points");
}

TEST_F(LoadSeries, OfDumpsInFolders)
{
  this->expect_series(
    "dumps in folders of 1000", size_of_load(2'000, 100'000), 1000, ".dump", particle, "points");
}

TEST_F(LoadSeries, OfCells)
{
  this->expect_series(
    "Euler files in one folder", size_of_load(2'000, 1'000'000), 1 << 30, ".vtk", cell, "pressure");
}

// ---- many frames in a file ---------------------------------------------------------------------
namespace
{
/// Writes a file of that many frames, and appends one when it was opened.
void expect_file(const std::string& path, const char* what,
  const std::function<std::string(std::int64_t)>& frame, const char* name,
  const char* column_names = nullptr)
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
    expect_frames(opened.run, count, name);
    file << frame(count);
    file.flush();
    ASSERT_EQ(granular_refresh(opened.run.get(), nullptr, nullptr, nullptr), GRANULAR_OK);
    expect_frames(opened.run, count + 1, name);
    load.expect_closed();
  }
  load.end(24 * mebibyte + count * 400);
}
}

TEST_F(LoadFrames, OfATextDump)
{
  expect_file(this->path("a.dump"), "frames of a text dump", particle, "points");
}

TEST_F(LoadFrames, OfContacts)
{
  expect_file(this->path("a.dump"), "frames of contacts", contact, "c_f");
}

TEST_F(LoadFrames, OfABinaryDump)
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
  expect_file(this->path("a.bin"), "frames of a binary dump", frame, "points", "id x y z");
}

// ---- many columns: more in tests/dump/many_columns.cpp -----------------------------------------
TEST_F(LoadFrames, OfManyColumns)
{
  const std::string path = this->write(
    "a.dump", one_frame(line_of_many("id x y z", "a#"), line_of_many("1 0.5 0.5 0.5", "#") + "\n"));
  Load load("columns, of which two are read");
  {
    const Opened opened = open_kind(path, GRANULAR_KIND_AUTOMATIC);
    ASSERT_EQ(opened.error + opened.notices, "");
    const char* const names[] = { "a3", "a100000" };
    granular_request request;
    granular_request_init(&request);
    request.arrays = names;
    request.array_count = 2;
    const FrameHandle frame = read_frame(opened.run, 0, &request);
    EXPECT_EQ(doubles(frame, "a3"), std::vector<double>{ 3 });
    EXPECT_EQ(doubles(frame, "a100000"), std::vector<double>{ 100'000 });
  }
  load.end(many_columns * 2048);
}

// ---- a long line -------------------------------------------------------------------------------
namespace
{
/// Writes a text, a piece that is repeated up to so many bytes, and more text.
std::string write_long(
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
  return path;
}
}

TEST_F(LoadLine, OfAHeader)
{
  const std::string text = header(0, 1);
  expect_outcome("a header line",
    write_long(this->path("a"), text.substr(0, text.size() - 1), " word", "\n1 0.5 0.5 0.5\n"),
    GRANULAR_KIND_DUMP, ":9: expected a line of at most 4194304 bytes, got a longer one");
}

TEST_F(LoadLine, OfARow)
{
  for (const char* const end : { " 17", "25" })
  {
    expect_outcome("a row",
      write_long(this->path("a"), header(0, 2) + "1 0.5 0.5 0.5", end, "\n2 0.5 0.5 0.5\n"),
      GRANULAR_KIND_DUMP, ":10: expected a line of at most 4194304 bytes, got a longer one");
  }
}

TEST_F(LoadLine, WithoutAnEnd)
{
  constexpr const char* long_line =
    ":1: expected a line of at most 4194304 bytes, got a longer one";
  constexpr const char* long_vtk = ":1: expected a line of at most 65536 bytes, got a longer one";
  const std::vector<std::pair<granular_kind, const char*>> errors = {
    { GRANULAR_KIND_AUTOMATIC, long_line },
    { GRANULAR_KIND_DUMP, long_line },
    { GRANULAR_KIND_LOCAL, long_line },
    { GRANULAR_KIND_RESTART,
      "@0: expected the header of a restart file, which begins with the version of the program, "
      "got "
      "other bytes" },
    { GRANULAR_KIND_DATA_FILE, long_line },
    { GRANULAR_KIND_EULER, long_vtk },
    { GRANULAR_KIND_DECOMPOSITION, long_vtk },
  };
  const std::string path = write_long(this->path("a"), "", "a", "");
  for (const auto& [kind, error] : errors)
  {
    expect_outcome("a file without an end of a line", path, kind, error);
  }
  expect_outcome("a last row without an end",
    write_long(path, particle(7) + header(8, 2) + "1 0.5 0.5 ", "3", ""), GRANULAR_KIND_DUMP,
    "1 frames, the last is read");
}

// ---- sparse files ------------------------------------------------------------------------------
TEST_F(LoadSparse, ABinaryFrameBehind100GiB)
{
  const binary::Form& form = binary::form("plain, little-endian");
  SparseFile file(this->path("large.bin"));
  constexpr std::int64_t chunk = 2147483647 / 12;
  append_large(file, form, binary::grains(form, 0, 1), std::vector<std::int64_t>(7, chunk));
  ASSERT_GT(file.size(), std::int64_t{ 100 } << 30);
  const binary::Frame last = binary::grains(form, 1, 4);
  file.append(binary::write(form, { last }).bytes);
  if (!file.good())
  {
    GTEST_SKIP() << "the file system has no sparse files of this size: " << std::strerror(errno);
  }
  Load load("a binary frame behind 100 GiB");
  {
    const Opened opened = open_kind(file.path(), GRANULAR_KIND_DUMP, binary::grain_columns);
    ASSERT_EQ(opened.error + opened.notices, "");
    ASSERT_EQ(frames_of(opened.run), 2);
    EXPECT_EQ(doubles(read_frame(opened.run, 1), "radius"), last.values(11));
    load.expect_closed();
  }
  load.end(16 * mebibyte);
}

namespace
{
/// A good file with a hole behind it and in its middle, and what comes of it.
struct Holed
{
  granular_kind kind;
  const char* name;
  const char* behind;
  const char* inside;
};

constexpr Holed holed_files[] = {
  { GRANULAR_KIND_DUMP, "grains_1000.dump", "1 frames, the last is read",
    "1 frames, :610: expected a row of at most 4194304 bytes, got a longer one" },
  { GRANULAR_KIND_LOCAL, "local/contacts.dump", "5 frames, the last is read",
    "5 frames, :244: expected a row of at most 4194304 bytes, got a longer one" },
  { GRANULAR_KIND_RESTART, "restart/fibres.restart",
    "@669: expected 31 particles of 3 processes up to the end of the file, found none behind byte "
    "669; understood: header, groups, masses",
    "@669: expected 31 particles of 3 processes up to the end of the file, found none behind byte "
    "669; understood: header, groups, masses; found 7 particles where these should be" },
  { GRANULAR_KIND_DATA_FILE, "data_file/granular.data",
    ":27: expected a line of at most 4194304 bytes, got a longer one",
    ":17: expected a line of at most 4194304 bytes, got a longer one" },
  { GRANULAR_KIND_EULER, "euler_1000.vtk", "1 frames, the last is read",
    ":344: expected a section of Euler cells, got '-0.696102'" },
  { GRANULAR_KIND_DECOMPOSITION, "decomposition_1000.vtk", "1 frames, the last is read",
    ":6: expected a line of at most 65536 bytes, got a longer one" },
};
}

TEST_F(LoadSparse, ZerosBehindAFileAndInIt)
{
  for (const Holed& holed : holed_files)
  {
    for (const bool inside : { false, true })
    {
      SparseFile file(this->path("zeros"));
      const std::string bytes = content(good(holed.name));
      const std::size_t at = inside ? bytes.size() / 2 : bytes.size();
      file.append(bytes.substr(0, at));
      file.append_hole(size_of_load(std::int64_t{ 1 } << 26, std::int64_t{ 120 } << 30));
      file.append(bytes.substr(at));
      if (!file.good())
      {
        GTEST_SKIP() << "the file system has no sparse files of this size: "
                     << std::strerror(errno);
      }
      expect_outcome(std::string(inside ? "zeros in " : "zeros behind ") + holed.name, file.path(),
        holed.kind, inside ? holed.inside : holed.behind);
    }
  }
}
