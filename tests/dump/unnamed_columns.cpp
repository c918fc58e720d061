// SPDX-License-Identifier: BSD-3-Clause
// Plain binaries of dump atom, put together byte by byte: the box tells x y z from xs ys zs.
#include "../support/binary_dumps.h"
#include "../support/dumps.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
using Doubles = std::vector<double>;

/// A frame of dump atom: positions of particles in a cube from lo to hi, and the id of the first one.
binary::Frame frame_of(
  double lo, double hi, const Doubles& positions, std::int64_t step = 0, double id = 1)
{
  binary::Frame frame;
  frame.timestep = step;
  frame.size_one = 5;
  frame.box = { lo, hi, lo, hi, lo, hi };
  for (std::size_t i = 0; i < positions.size(); i += 3)
  {
    frame.chunks.push_back(
      { id + static_cast<double>(i / 3), 1, positions[i], positions[i + 1], positions[i + 2] });
  }
  return frame;
}

std::string bytes_of(const std::vector<binary::Frame>& frames)
{
  return binary::write(binary::form("plain, little-endian"), frames).bytes;
}

/// A run of files with names of their own.
Series series(
  const Folder& folder, const std::string& name, const std::vector<std::string>& contents)
{
  Files files;
  for (const std::string& content : contents)
  {
    files.push_back(folder.write(name + "." + std::to_string(files.size()) + ".bin", content));
  }
  Series run;
  run.update(files);
  return run;
}

std::string columns(const Series& run, std::size_t frame)
{
  return run.entry(frame).kind->schema.text();
}

const std::string absolute = "id type x y z";
const std::string scaled = "id type xs ys zs";
const Doubles corners = { 1, 1, 1, 99, 99, 99, 50, 2, 98 };
}

TEST(UnnamedColumns, TheBoxTells)
{
  struct Case
  {
    double lo, hi;
    Doubles positions;
    std::string names;
  };
  for (const auto& [lo, hi, positions, names] : std::vector<Case>{
         { 0, 100, corners, absolute }, { -50, 50, { -49, 3, 2, 49, 4, 5 }, absolute },
         { -0.05, 0.05, { 0.01, 0.99, 0.5, 0.5, 0.25, 0.75 }, scaled },
         { -0.05, 0.05, { -0.01, -0.04, 0.04, 0.02, -0.03, -0.04 }, absolute },
         { 1000, 1001, { 1000.1, 1000.2, 1000.3 }, absolute },
         { 1000, 1001, { 0.1, 0.2, 0.3 }, scaled },
         { 1000, 1001, { -0.015, 1.015, 0.3 }, scaled }, // on its way through a face
         { 1000, 1001, { 999.985, 1001.015, 1000 }, absolute },
         { 0, 1, { 0.1, 0.2, 0.3 }, scaled }, // the same in both
       })
  {
    const Dump dump(bytes_of({ frame_of(lo, hi, positions) }));
    EXPECT_EQ(dump.entry().kind->schema.text(), names) << lo;
    const Doubles points = dump.read().points();
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      EXPECT_NEAR(points[i], names == scaled ? lo + positions[i] * (hi - lo) : positions[i], 1e-12);
    }
  }
}

/// One particle in five may be lost, here at 1e6.
TEST(UnnamedColumns, AFewRowsMayBeAnywhere)
{
  Doubles positions;
  for (int i = 0; i < 20; ++i)
  {
    positions.insert(positions.end(), 3, i % 5 == 3 ? 1e6 : 5.0 * i);
  }
  EXPECT_EQ(Dump(bytes_of({ frame_of(0, 100, positions) })).entry().kind->schema.text(), absolute);
  positions[0] = 1e6;
  EXPECT_FALSE(Dump(bytes_of({ frame_of(0, 100, positions) })).entry().kind->named);
}

TEST(UnnamedColumns, BothOrNeitherIsAnErrorThatNamesColumnNames)
{
  const std::string expected =
    "expected 5 names in ColumnNames, because the file does not name its "
    "columns, got none; its first row is 1 1 ";
  EXPECT_EQ(Dump(bytes_of({ frame_of(0, 10, { 0.5, 0.25, 0.75 }) })).error(),
    "memory@0: " + expected +
      "0.5 0.25 0.75; its rows lie in the box both as id type x y z and as id type xs ys zs");
  EXPECT_EQ(Dump(bytes_of({ frame_of(0, 10, { 20, 3, 3 }) })).error(),
    "memory@0: " + expected +
      "20 3 3; its rows lie in the box neither as id type x y z nor as id type xs ys zs");
  binary::Frame flat = frame_of(5, 6, { 0.5, 0.5, 0.5 });
  flat.box[3] = flat.box[2]; // scales nothing
  EXPECT_NE(Dump(bytes_of({ flat })).error().find("neither as"), std::string::npos);
}

/// A frame that does not tell, or has no rows, is as the others of its run.
TEST(UnnamedColumns, OtherFramesOfTheRunTell)
{
  const binary::Frame few = frame_of(0, 100, { 0.5, 0.25, 0.75 }, 1);
  const Folder folder;
  const Series file = series(
    folder, "file", { bytes_of({ frame_of(0, 100, {}), few, frame_of(0, 100, corners, 2) }) });
  const Series files = series(folder, "files",
    { bytes_of({ frame_of(0, 100, {}) }), bytes_of({ few }),
      bytes_of({ frame_of(0, 100, corners, 2) }) });
  for (const Series* run : { &file, &files })
  {
    for (std::size_t frame = 0; frame < 3; ++frame)
    {
      EXPECT_EQ(columns(*run, frame), absolute);
    }
    EXPECT_EQ(run->read(0).rows(), 0);
    EXPECT_EQ(run->read(1).points(), (Doubles{ 0.5, 0.25, 0.75 }));
  }
  // one file a rank, of which the first has no particles
  const Series pieces = series(folder, "pieces",
    { bytes_of({ frame_of(0, 100, {}) }), bytes_of({ frame_of(0, 100, corners) }),
      bytes_of({ frame_of(0, 100, { 0.5, 0.25, 0.75 }, 0, 4) }) });
  ASSERT_EQ(pieces.index.pieces(0).size(), 3u);
  EXPECT_EQ(pieces.read(0).points(), (Doubles{ 1, 1, 1, 99, 99, 99, 50, 2, 98, 0.5, 0.25, 0.75 }));
  // frames that tell differently tell nothing of others
  const Series mixed = series(folder, "mixed",
    { bytes_of({ few, frame_of(0, 100, corners, 2), frame_of(200, 300, { 0.5, 0.5, 0.5 }, 3) }) });
  EXPECT_NE(error_of([&] { mixed.read(0); }).find("ColumnNames"), std::string::npos);
  EXPECT_EQ(columns(mixed, 1), absolute);
  EXPECT_EQ(columns(mixed, 2), scaled);
}
