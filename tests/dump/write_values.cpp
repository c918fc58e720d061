// SPDX-License-Identifier: BSD-3-Clause
// Headers: boxes of all kinds, and frames that lack something.
#include "../support/dump_writing.h"
#include "../support/dumps.h"

#include "granular/formats/dump/write/encode_header.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace granular;

std::string seventeen(double value)
{
  char word[64];
  std::snprintf(word, sizeof word, "%-1.16e", value);
  return word;
}

FrameView frame_in(const Box& box)
{
  FrameView frame;
  frame.header.box = box;
  return frame;
}

/// Three lines of a box from random numbers of one magnitude.
struct RandomBox
{
  RandomBox(std::mt19937_64& random, bool tilted)
  {
    std::uniform_real_distribution<double> unit(-1, 1);
    std::uniform_int_distribution<int> exponent(-20, 20);
    const double size = std::ldexp(1, exponent(random));
    for (std::size_t k = 0; k < 3; ++k)
    {
      n[3 * k] = unit(random) * size;
      n[3 * k + 1] = n[3 * k] + (3 + unit(random)) * size;
      n[3 * k + 2] = tilted ? unit(random) * size * 0.5 : 0;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      for (std::size_t i = 0; i < (tilted ? 3U : 2U); ++i)
      {
        text += (i == 0 ? "" : " ") + seventeen(n[3 * k + i]);
      }
      text += "\n";
    }
  }

  double n[9] = {};
  std::string text;
};
}

/// Numbers of 17 digits come back as they were, through the box and its 106 bits.
TEST(WriteValues, boxes_come_back)
{
  std::mt19937_64 random(11);
  DumpFormat format;
  for (int i = 0; i < 100000; ++i)
  {
    const bool tilted = i % 3 != 0;
    const RandomBox numbers(random, tilted);
    const auto& n = numbers.n;
    FrameHeader header;
    header.box = tilted
      ? Box::from_tilted_bounds({ n[0], n[3], n[6] }, { n[1], n[4], n[7] }, n[2], n[5], n[8])
      : Box::from_bounds({ n[0], n[3], n[6] }, { n[1], n[4], n[7] });
    header.box.boundary = "pp pp pp";
    const std::string expected = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS " +
      std::string(tilted ? "xy xz yz " : "") + "pp pp pp\n" + numbers.text + "ITEM: ATOMS id\n";
    ASSERT_EQ(encode_header(header, { "id" }, format, {}, true), expected);
    if (i % 100 == 0)
    {
      ASSERT_EQ(encode_header(Dump(expected).header(), { "id" }, format, {}, true), expected);
    }
  }
}

TEST(WriteValues, general_box)
{
  const std::string text = "ITEM: TIMESTEP\n-5\nITEM: NUMBER OF ATOMS\n1\n"
                           "ITEM: BOX BOUNDS abc origin pp ff sm\n" +
    seventeen(1) + " " + seventeen(0.1) + " " + seventeen(0) + " " + seventeen(-7) + "\n" +
    seventeen(0.2) + " " + seventeen(1.0 / 3) + " " + seventeen(0.5) + " " + seventeen(8) + "\n" +
    seventeen(0) + " " + seventeen(-0.125) + " " + seventeen(2) + " " + seventeen(1e-3) + "\n" +
    "ITEM: ATOMS id xs ys zs\n1 0.5 0.25 0.125\n";
  const Dump dump(text);
  const ReadFrameView read(dump.read(everything()).frame);
  const Folder folder;
  EXPECT_EQ(write_dump(folder.path("a"), Frames{ read.view }, {}).bytes, text);
  DumpFormat format;
  format.binary = true;
  const Written binary = write_dump(folder.path("b"), Frames{ read.view }, format);
  EXPECT_EQ(binary.error, "");
  const Dump again(binary.bytes);
  const FrameHeader header = again.header();
  EXPECT_EQ(header.timestep, -5);
  EXPECT_TRUE(header.box.general);
  EXPECT_EQ(header.box.boundary, "pp ff sm");
  EXPECT_EQ(encode_header(header, { "id" }, {}, {}, true),
    encode_header(dump.header(), { "id" }, {}, {}, true));
  format.dialect = Dialect::Liggghts;
  format.binary = false;
  const std::string error = "expected a box with its first vector along x and its second in the xy "
                            "plane for LIGGGHTS, got a general one";
  EXPECT_EQ(write_dump(folder.path("c"), Frames{ read.view }, format).error, error);
  EXPECT_EQ(names_in(folder.path("")), "a b");
}

/// A box without a length scales nothing; absolute coordinates do not need one.
TEST(WriteValues, flat_box)
{
  const std::vector<double> points = { 1, 2, 3 };
  FrameView frame = frame_in(Box::from_bounds({ 0, 2, 0 }, { 4, 2, 4 }));
  frame.rows = 1;
  frame.points = view_rows("points", ValueType::Float64, points.data(), 3);
  const Folder folder;
  DumpFormat format;
  format.columns = { "x", "y", "z", "xu" };
  EXPECT_EQ(write_dump(folder.path("a"), Frames{ frame }, format).error, "");
  for (const char* const name : { "xs", "zsu" })
  {
    format.columns = { name };
    EXPECT_EQ(write_dump(folder.path("b"), Frames{ frame }, format).error,
      "expected a box with a length along y to scale coordinates by, got one of length 0");
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  frame.header.box = Box::from_bounds({ nan, 0, 0 }, { 1, 1, 1 });
  EXPECT_EQ(write_dump(folder.path("b"), Frames{ frame }, format).error,
    "expected a box with a length along x to scale coordinates by, got one of length nan");
  EXPECT_EQ(names_in(folder.path("")), "a");
}

/// Without a box there is one around the spheres.
TEST(WriteValues, no_box)
{
  const std::vector<double> points = { 1, 2, 3, 4, -5, 6, 1e9, 0, 0,
    std::numeric_limits<double>::infinity(), 0, 3 };
  const std::vector<std::int32_t> radius = { 1, 2, 500, 1 };
  const std::vector<double> diameter = { 2, 5, 0, 1 };
  const std::vector<unsigned char> ghosts = { 0, 0, 1, 0 };
  FrameView frame = frame_in(Box::from_bounds({ -9, -9, -9 }, { 9, 9, 9 }));
  frame.has_box = false;
  frame.rows = 4;
  frame.ghosts = ghosts.data();
  frame.points = view_rows("points", ValueType::Float64, points.data(), 3);
  frame.point_origin = { 10, 0, 0 };
  DumpFormat format;
  format.dialect = Dialect::Liggghts;
  format.columns = { "z" };
  const Folder folder;
  const auto box = [&](const std::vector<std::int64_t>& shares)
  {
    const Written written = write_dump(folder.path("a"), cut({ frame }, shares), format);
    EXPECT_EQ(written.error, "");
    EXPECT_EQ(written.said, "the input has no box: it is made from the bounds of the grains\n");
    const std::size_t at = written.bytes.find("BOUNDS ") + 7;
    return written.bytes.substr(at, written.bytes.find("ITEM: ATOMS") - at);
  };
  for (const std::vector<std::int64_t>& shares :
    { std::vector<std::int64_t>{ 4 }, { 1, 1, 2 }, { 0, 4 }, { 3, 1 } })
  {
    frame.arrays = {};
    EXPECT_EQ(box(shares), "ff ff ff\n11 14\n-5 2\n3 6\n");
    frame.arrays.push_back(view_rows("diameter", ValueType::Float64, diameter.data()));
    EXPECT_EQ(box(shares), "ff ff ff\n10 16.5\n-7.5 3\n2 8.5\n");
    frame.arrays.push_back(view_rows("radius", ValueType::Int32, radius.data()));
    EXPECT_EQ(box(shares), "ff ff ff\n10 16\n-7 3\n2 8\n");
  }
  frame.rows = 0;
  frame.points.reset();
  format.columns = { "id" };
  frame.arrays.push_back(view_rows("id", ValueType::Int32, radius.data()));
  EXPECT_EQ(box({ 1 }), "ff ff ff\n0 0\n0 0\n0 0\n");

  frame.rows = 2;
  EXPECT_EQ(write_dump(folder.path("a"), Frames{ frame }, format).error,
    "column 'x': expected an array to make it from, got none: there are diameter, radius, id");
  frame.points = view_rows("points", ValueType::Float64, points.data(), 3);
  frame.coordinates = Coordinates::Scaled;
  EXPECT_EQ(write_dump(folder.path("a"), Frames{ frame }, format).error,
    "expected a box for Scaled points, got none");
  frame.coordinates = Coordinates::Absolute;
  std::vector<Frames> ranks = cut({ frame }, { 1, 1 });
  ranks[1][0].has_box = true;
  EXPECT_EQ(write_dump(folder.path("a"), ranks, format).error,
    "expected a box on all ranks or on none, got one on some (on rank 0 of 2)");
}

/// The box of LIGGGHTS has six digits, or all where these would move particles: nothing is lost, and nothing is told.
TEST(WriteValues, digits_of_the_box)
{
  const std::vector<double> points = { 0.1, 0.1, 0.1 };
  const Folder folder;
  DumpFormat format;
  format.dialect = Dialect::Liggghts;
  const auto written = [&](const Box& box, const char* column)
  {
    FrameView frame = frame_in(box);
    frame.header.box.boundary = "pp pp pp";
    frame.rows = 1;
    frame.points = view_rows("points", ValueType::Float64, points.data(), 3);
    format.columns = { column };
    const Written made = write_dump(folder.path("a"), Frames{ frame }, format);
    EXPECT_EQ(made.said, "");
    return made.bytes.substr(made.bytes.find("BOX BOUNDS"));
  };
  const Box third = Box::from_bounds({ 0, 0, 0 }, { 1, 1, 1.0 / 3 });
  EXPECT_NE(written(third, "xs").find("\n0 0.333333\n"), std::string::npos);
  EXPECT_NE(written(third, "x").find("\n0 0.333333\n"), std::string::npos);
  const Box far = Box::from_bounds({ 1e4, 0, 0 }, { 1e4 + 1.0 / 3, 1, 1 });
  for (const char* column : { "x", "xs" })
  {
    EXPECT_NE(written(far, column).find("\n10000 10000.333333333334\n"), std::string::npos);
  }
  const Box tilted = Box::from_tilted_bounds({ 0, 0, 0 }, { 2, 2, 2 }, 0, 0, 1.0 / 3);
  EXPECT_NE(written(tilted, "ys").find("\n0 2 0.333333\n"), std::string::npos);
}

TEST(WriteValues, units_time_and_label)
{
  FrameView frame = frame_in(small_box(false));
  DumpFormat format;
  format.columns = { "id" };
  format.units = true;
  const Folder folder;
  const auto write = [&](const Frames& frames)
  { return write_dump(folder.path("a"), frames, format); };
  EXPECT_EQ(write({ frame }).error, "expected the units of the frame for ITEM: UNITS, got none");
  frame.header.units = "si";
  format.time = true;
  EXPECT_EQ(write({ frame }).error, "expected the time of the frame for ITEM: TIME, got none");
  for (const double time :
    { 0.0, 0.1, 1.0 / 3, 1e-20, 123456789012345680.0, 0.1 + 0.2, -2.5, 1e16, 5e-5 })
  {
    frame.header.time = time;
    char word[64];
    std::snprintf(word, sizeof word, "%.16g", time);
    if (std::strtod(word, nullptr) != time)
    {
      std::snprintf(word, sizeof word, "%.17g", time);
    }
    FrameView next = frame;
    ++next.header.timestep;
    const std::string bytes = write({ frame, next }).bytes;
    const std::string begin =
      "ITEM: UNITS\nsi\nITEM: TIME\n" + std::string(word) + "\nITEM: TIMESTEP\n0\n";
    EXPECT_EQ(bytes.substr(0, begin.size()), begin);
    EXPECT_EQ(bytes.find("UNITS", 10), bytes.npos) << "once a file";
    EXPECT_EQ(bytes.find("ITEM: TIME\n", 20) != bytes.npos, true) << "in each frame";
  }
  format.binary = true;
  FrameView next = frame;
  ++next.header.timestep;
  const Dump binary(write({ frame, next }).bytes);
  EXPECT_EQ(binary.frames(), 2U);
  EXPECT_EQ(binary.header(0).units, "si");
  EXPECT_EQ(binary.header(1).time, 5e-5);

  format = {};
  format.columns = { "id" };
  format.dialect = Dialect::Liggghts;
  frame.header.label = "a label of several  words ";
  EXPECT_NE(
    write({ frame }).bytes.find(
      "ITEM: TIMESTEP\n0\nITEM: LABEL\na label of several  words \nITEM: NUMBER OF ATOMS\n"),
    std::string::npos);
  frame.header.box.tilted = true; // LIGGGHTS prints none there
  EXPECT_EQ(write({ frame }).bytes.find("LABEL"), std::string::npos);
  frame.header.label = "two\nITEM: TIMESTEP";
  EXPECT_EQ(write({ frame }).error, "expected the label in one line, got a line break in it");
  frame.header.label = "";
  frame.header.box.boundary = "pp\n";
  EXPECT_EQ(write({ frame }).error,
    "expected boundaries as in 'pp pp ff' or 'p p f', of p, f, s and m, got 'pp\\n'");
}

TEST(WriteValues, unknown_boundaries)
{
  FrameView frame = frame_in(Box::from_bounds({ 0, 0, 0 }, { 1, 1, 1 }));
  DumpFormat format;
  format.columns = { "x" };
  const Folder folder;
  const Written written = write_dump(folder.path("a"), Frames{ frame }, format);
  EXPECT_EQ(
    written.said, "the boundaries of the box are not known: they are written as ff ff ff\n");
  EXPECT_NE(written.bytes.find("BOX BOUNDS ff ff ff\n"), written.bytes.npos);
}

TEST(WriteValues, timesteps)
{
  FrameView frame = frame_in(small_box(false));
  DumpFormat format;
  format.columns = { "id" };
  const Folder folder;
  const std::string path = folder.path("a");
  for (const std::int64_t step :
    { std::int64_t{ -7 }, std::int64_t{ 1 } << 40, std::numeric_limits<std::int64_t>::max() })
  {
    frame.header.timestep = step;
    EXPECT_EQ(Dump(write_dump(path, Frames{ frame }, format).bytes).header().timestep, step);
  }
  frame.header.timestep = -7;
  format.binary = true;
  EXPECT_EQ(Dump(write_dump(path, Frames{ frame }, format).bytes).header().timestep, -7);
  format.dialect = Dialect::Liggghts;
  EXPECT_EQ(write_dump(path, Frames{ frame }, format).error,
    "expected a timestep of at least 0 for a binary dump without names, got -7");
}

/// Readers would show one of them.
TEST(WriteValues, two_frames_of_one_timestep)
{
  FrameView frame = frame_in(small_box(false));
  frame.header.timestep = 5;
  DumpFormat format;
  format.columns = { "id" };
  const Folder folder;
  for (const auto& [name, file] : { std::pair("a", "a"), std::pair("a_*", "a_5") })
  {
    EXPECT_EQ(write_dump(folder.path(name), Frames{ frame, frame }, format).error,
      folder.path(file) + ": expected a timestep of its own for each frame, got timestep 5 again");
  }
  EXPECT_EQ(write_dump(folder.path("a"), Frames{ frame }, format).error, "");
  EXPECT_EQ(write_dump(folder.path("a"), Frames{ frame }, format).error, "");
}

TEST(WriteValues, nothing_comes_after_the_end)
{
  const FrameView frame = frame_in(small_box(false));
  const Folder folder;
  granular::SerialCommunicator alone;
  granular::Notices notices;
  granular::Progress progress;
  granular::DumpWriter writer(folder.path("a"), {}, {}, alone);
  writer.write(frame, notices, progress);
  writer.finish();
  writer.finish();
  EXPECT_THROW(writer.write(frame, notices, progress), std::logic_error);
}

TEST(WriteValues, boxes_that_are_none)
{
  const std::vector<double> points = { 1, 2, 3 };
  const auto error_of = [&](const Box& box, const std::string& column)
  {
    FrameView frame = frame_in(box);
    frame.header.box.boundary = "pp pp pp";
    frame.rows = 1;
    frame.points = view_rows("points", ValueType::Float64, points.data(), 3);
    DumpFormat format;
    format.columns = { column };
    const Folder folder;
    return write_dump(folder.path("a"), Frames{ frame }, format).error;
  };
  const Box flat = Box::from_vectors({ 0, 0, 0 }, { { { 1, 1, 0 }, { 2, 2, 0 }, { 0, 0, 1 } } });
  EXPECT_EQ(error_of(flat, "x"), "");
  EXPECT_EQ(
    error_of(flat, "xs"), "expected a box with a volume to scale coordinates by, got a flat one");
  EXPECT_EQ(error_of(Box::from_bounds({ 0, 1, 0 }, { 1, -1, 1 }), "x"),
    "expected a box with its upper bound above the lower one along y, got a length of -2.000000");
}

/// One letter an axis does, too.
TEST(WriteValues, short_boundaries)
{
  FrameView frame = frame_in(small_box(false));
  frame.header.box.boundary = "p p f";
  DumpFormat format;
  format.columns = { "id" };
  const Folder folder;
  EXPECT_NE(
    write_dump(folder.path("a"), Frames{ frame }, format).bytes.find("ITEM: BOX BOUNDS pp pp ff\n"),
    std::string::npos);
}

TEST(WriteValues, names_of_files)
{
  using granular::Compression;
  EXPECT_TRUE(granular::is_binary_name("a/b.bin"));
  EXPECT_TRUE(granular::is_binary_name("B.LAMMPSBIN"));
  EXPECT_TRUE(granular::is_binary_name("b.bin.gz")); // which nobody reads, and is refused
  EXPECT_FALSE(granular::is_binary_name("b.bin.dump"));
  EXPECT_FALSE(granular::is_binary_name("bin"));
  EXPECT_EQ(granular::compression_of_name("a.dump.GZ"), Compression::Gzip);
  EXPECT_EQ(granular::compression_of_name("a.zst"), Compression::Zstd);
  EXPECT_EQ(granular::compression_of_name("gz"), Compression::None);
  DumpFormat format;
  format.binary = true;
  format.compression = Compression::Gzip;
  const Folder folder;
  EXPECT_EQ(write_dump(folder.path("b.bin.gz"), Frames{ frame_in(small_box(false)) }, format).error,
    folder.path("b.bin.gz") +
      ": expected text to compress, got a binary dump: no program reads that");
}
