// SPDX-License-Identifier: BSD-3-Clause
// Binary dumps of every layout and byte order, put together byte by byte.
#include "granular/formats/dump/grammar/binary_dump.h"
#include "granular/formats/dump/grammar/dump_files.h"

#include "granular/formats/dump/grammar/binary_header.h"

#include "../support/binary_dumps.h"
#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/quad.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace
{
using binary::Bytes;
using binary::Form;
using binary::forms;
using binary::Frame;
using granular::ArrayInfo;
using granular::Coordinates;
using granular::Request;
using granular::ValueType;
using Doubles = std::vector<double>;
using Integers = std::vector<std::int64_t>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Dump dump_of(const Form& form, const std::vector<Frame>& frames)
{
  return Dump(binary::write(form, frames).bytes, binary::names_for(form));
}

/// A frame of any columns in one chunk.
Frame frame_of(
  const Form& form, const std::string& columns, std::int32_t count, const Doubles& values)
{
  Frame frame;
  frame.size_one = count;
  frame.columns = form.named() ? columns : "";
  frame.chunks = { values };
  return frame;
}

/// A dump of one frame of named columns, whatever names them.
Dump one_frame_of(
  const Form& form, const std::string& columns, std::int32_t count, const Doubles& values)
{
  return Dump(binary::write(form, { frame_of(form, columns, count, values) }).bytes,
    form.named() ? "" : columns);
}

/// The same, and where the first value is.
std::size_t first_value(
  const Form& form, const std::string& columns, std::int32_t count, const Doubles& values)
{
  return binary::write(form, { frame_of(form, columns, count, values) }).first_value;
}

Doubles interleaved(const Frame& frame, std::size_t column)
{
  Doubles all;
  const Doubles x = frame.values(column);
  const Doubles y = frame.values(column + 1);
  const Doubles z = frame.values(column + 2);
  for (std::size_t row = 0; row < x.size(); ++row)
  {
    all.insert(all.end(), { x[row], y[row], z[row] });
  }
  return all;
}

Integers integers(const Doubles& values)
{
  Integers all;
  std::transform(values.begin(), values.end(), std::back_inserter(all),
    [](double value) { return static_cast<std::int64_t>(value); });
  return all;
}

/// A corner of the box of a frame, of what the file holds.
granular::Vector3 corner_of(const Frame& frame, int i, int j, int k)
{
  const auto q = [&](std::size_t at) { return static_cast<Quad>(frame.box[at]); };
  std::array<std::array<Quad, 3>, 3> vectors = {};
  std::array<Quad, 3> origin = {};
  if (frame.triclinic == 2)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      vectors[axis] = { q(3 * axis), q(3 * axis + 1), q(3 * axis + 2) };
    }
    origin = { q(9), q(10), q(11) };
  }
  else
  {
    const bool tilted = frame.triclinic == 1;
    const Quad xy = tilted ? q(6) : 0;
    const Quad xz = tilted ? q(7) : 0;
    const Quad yz = tilted ? q(8) : 0;
    const std::array<Quad, 4> x = { 0, xy, xz, xy + xz };
    const std::array<Quad, 2> y = { 0, yz };
    origin = { q(0) - *std::min_element(x.begin(), x.end()),
      q(2) - *std::min_element(y.begin(), y.end()), q(4) };
    vectors[0] = { q(1) - *std::max_element(x.begin(), x.end()) - origin[0], 0, 0 };
    vectors[1] = { xy, q(3) - *std::max_element(y.begin(), y.end()) - origin[1], 0 };
    vectors[2] = { xz, yz, q(5) - q(4) };
  }
  granular::Vector3 corner = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    corner[axis] = static_cast<double>(origin[axis] + static_cast<Quad>(i) * vectors[0][axis] +
      static_cast<Quad>(j) * vectors[1][axis] + static_cast<Quad>(k) * vectors[2][axis]);
  }
  return corner;
}

void expect_header(const Dump& dump, std::size_t index, const Form& form, const Frame& frame)
{
  const granular::FrameHeader header = dump.header(index);
  EXPECT_EQ(header.timestep, frame.timestep);
  EXPECT_EQ(header.rows, frame.rows());
  EXPECT_EQ(header.time, frame.time);
  EXPECT_EQ(header.units, frame.units);
  std::string boundary;
  for (std::size_t face = 0; form.boundary && face < 6; ++face)
  {
    boundary += face == 2 || face == 4 ? " " : "";
    boundary += "pfsm"[frame.boundary[face]];
  }
  EXPECT_EQ(header.box.boundary, boundary);
  EXPECT_EQ(header.box.tilted, frame.triclinic > 0);
  EXPECT_EQ(header.box.general, frame.triclinic == 2);
  for (int corner = 0; corner < 8; ++corner)
  {
    const int i = corner & 1;
    const int j = corner >> 1 & 1;
    const int k = corner >> 2;
    EXPECT_EQ(header.box.corner(i, j, k), corner_of(frame, i, j, k)) << corner;
  }
  EXPECT_EQ(dump.entry(index).timestep, frame.timestep);
  EXPECT_EQ(dump.entry(index).rows, frame.rows());
  EXPECT_EQ(std::isnan(dump.entry(index).time), !frame.time);
}

/// Returns true if a frame of binary::particles is read as it was written.
void expect_particles(const Dump& dump, std::size_t index, const Frame& frame)
{
  const Decoded got = dump.read({}, index);
  EXPECT_EQ(got.said(), "");
  EXPECT_EQ(got.rows(), frame.rows());
  ASSERT_EQ(got.names(), "id type image v radius");
  EXPECT_EQ(got.type("id"), ValueType::Int64);
  EXPECT_EQ(got.type("type"), ValueType::Int32);
  EXPECT_EQ(got.type("image"), ValueType::Int32);
  EXPECT_EQ(got.type("v"), ValueType::Float64);
  EXPECT_EQ(got.integers("id"), integers(frame.values(0)));
  EXPECT_EQ(got.integers("type"), integers(frame.values(1)));
  EXPECT_EQ(got.points(), interleaved(frame, 2));
  EXPECT_EQ(got.integers("image"), integers(interleaved(frame, 5)));
  EXPECT_EQ(got.values("v"), interleaved(frame, 8));
  EXPECT_EQ(got.values("radius"), frame.values(11));
}

/// The layout that a dump was taken for is the one it was written in.
void expect_layout(const Dump& dump, const Form& form)
{
  const auto number = static_cast<std::size_t>(dump.entry().kind->layout);
  ASSERT_LT(number, granular::binary_layouts().size());
  const granular::BinaryLayout& layout = granular::binary_layouts()[number];
  EXPECT_EQ(layout.magic, !form.magic.empty());
  EXPECT_EQ(layout.wide, form.wide);
  EXPECT_EQ(layout.triclinic, form.triclinic);
  EXPECT_EQ(layout.boundary, form.boundary);
  EXPECT_EQ(layout.swapped, form.big);
}

std::string hex(const std::string& bytes)
{
  std::string text;
  for (const char byte : bytes)
  {
    text += "0123456789abcdef"[static_cast<unsigned char>(byte) >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

std::string bytes_of(const std::string& hex)
{
  std::string bytes;
  std::string digits;
  std::copy_if(hex.begin(), hex.end(), std::back_inserter(digits), [](char c) { return c > ' '; });
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
  {
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  }
  return bytes;
}
}

// ---- layouts -----------------------------------------------------------------------------------

// Digit by digit, so that what the other tests write is what the programs write.
TEST(BinaryDump, ByHand)
{
  // dump atom, step 258, 1 atom, pp ff sm, box -1 1 -1 1 -2 2, id 3 type 2 at 0.5 0.25 -0.5
  const std::string box_little =
    "000000000000f0bf 000000000000f03f 000000000000f0bf 000000000000f03f"
    "00000000000000c0 0000000000000040";
  const std::string row_little =
    "0000000000000840 0000000000000040 000000000000e03f 000000000000d03f"
    "000000000000e0bf";
  const std::string plain_little = "0201000000000000 0100000000000000 00000000"
                                   "00000000 00000000 01000000 01000000 02000000 03000000" +
    box_little + "05000000 02000000 00000000 05000000" + row_little;
  const std::string old_big = "00000102 00000001"
                              "bff0000000000000 3ff0000000000000 bff0000000000000 3ff0000000000000"
                              "c000000000000000 4000000000000000 00000005 00000001 00000005"
                              "4008000000000000 4000000000000000 3fe0000000000000 3fd0000000000000"
                              "bfe0000000000000";
  const std::string magic_little = "f8ffffffffffffff 44554d5041544f4d 01000000 02000000"
                                   "0201000000000000 0100000000000000 00000000"
                                   "00000000 00000000 01000000 01000000 02000000 03000000" +
    box_little + "05000000 02000000 6c6a 01 000000000000e03f" +
    "10000000 6964 20 74797065 20 7873 20 7973 20 7a73 01000000 05000000" + row_little;
  Frame frame;
  frame.timestep = 258;
  frame.boundary = { 0, 0, 1, 1, 2, 3 };
  frame.box = { -1, 1, -1, 1, -2, 2 };
  frame.size_one = 5;
  const Doubles row = { 3, 2, 0.5, 0.25, -0.5 };
  frame.chunks = { {}, row };
  EXPECT_EQ(hex(binary::write(binary::form("plain, little-endian"), { frame }).bytes),
    hex(bytes_of(plain_little)));
  frame.chunks = { row };
  EXPECT_EQ(hex(binary::write(binary::form("before 2011, big-endian"), { frame }).bytes),
    hex(bytes_of(old_big)));
  frame.units = "lj";
  frame.time = 0.5;
  frame.columns = "id type xs ys zs";
  EXPECT_EQ(hex(binary::write(binary::form("DUMPATOM revision 2, little-endian"), { frame }).bytes),
    hex(bytes_of(magic_little)));

  for (const std::string& text : { plain_little, old_big, magic_little })
  {
    const Dump dump(bytes_of(text), "id type xs ys zs");
    ASSERT_EQ(dump.steps(), Integers{ 258 }) << text;
    const Decoded got = dump.read();
    EXPECT_EQ(got.said(), "");
    EXPECT_EQ(got.integers("id"), Integers{ 3 });
    EXPECT_EQ(got.integers("type"), Integers{ 2 });
    EXPECT_EQ(got.points(), (Doubles{ 0, -0.5, -4 }));
    EXPECT_EQ(got.frame.header.box.boundary, text == old_big ? "" : "pp ff sm");
  }
}

TEST(BinaryDump, EveryLayoutAndByteOrder)
{
  for (const Form& form : forms())
  {
    for (int triclinic = 0; triclinic <= form.most_triclinic(); ++triclinic)
    {
      SCOPED_TRACE(form.name + ", triclinic " + std::to_string(triclinic));
      // also with a first frame without atoms, as of a run that has yet to insert some
      const std::vector<Frame> frames = { binary::particles(form, 0, 0, triclinic),
        binary::particles(form, 1, 5, triclinic), binary::particles(form, 70000, 1, triclinic) };
      const Dump dump = dump_of(form, frames);
      EXPECT_EQ(dump.said(), "");
      ASSERT_EQ(dump.steps(), (Integers{ 0, 1, 70000 }));
      expect_layout(dump, form);
      for (std::size_t i = 0; i < frames.size(); ++i)
      {
        expect_header(dump, i, form, frames[i]);
        expect_particles(dump, i, frames[i]);
        const Dump alone = dump_of(form, { frames[i] });
        ASSERT_EQ(alone.frames(), 1u);
        expect_layout(alone, form);
        expect_particles(alone, 0, frames[i]);
      }
      EXPECT_EQ(dump.index().resume_offset, dump.entry(2).end);
      EXPECT_EQ(dump.entry(1).offset, dump.entry(0).end);
    }
  }
}

// Small and round numbers look alike in all layouts: zeros above all.
TEST(BinaryDump, LayoutsAreToldFromEachOther)
{
  std::minstd_rand random(11);
  const auto pick = [&](const Doubles& from) { return from[random() % from.size()]; };
  const Doubles low = { 0, 0, -1, -0.5, -1024, 1, -1e-3 };
  const Doubles lengths = { 1, 0.5, 1024, 0.1, 1e9, 2, 0 };
  const Doubles tilts = { 0, 0, 0.25, -0.25 };
  for (int round = 0; round < 8'000; ++round)
  {
    const Form& form = forms()[random() % forms().size()];
    const auto triclinic =
      static_cast<std::int32_t>(random() % static_cast<unsigned>(form.most_triclinic() + 1));
    Frame frame;
    frame.timestep = static_cast<std::int64_t>(random() % 4);
    frame.triclinic = triclinic;
    const std::int32_t flag = static_cast<std::int32_t>(random() % 4);
    frame.boundary = { 0, 0, 0, flag, 0, flag };
    frame.box.clear();
    for (int axis = 0; axis < 3; ++axis)
    {
      // one axis may be flat, not all
      frame.box.push_back(pick(low));
      frame.box.push_back(
        frame.box.back() + (axis == 0 ? 2 : 1.5) * (axis == 0 ? 1 : pick(lengths)));
    }
    if (triclinic == 1)
    {
      frame.box[3] += 1;
      frame.box.insert(frame.box.end(), { pick(tilts), pick(tilts), pick(tilts) });
    }
    if (triclinic == 2)
    {
      frame.box = { pick(lengths), 0, 0, 0, pick(lengths), 0, 0, 0, pick(lengths), pick(low), 0,
        0 };
    }
    frame.size_one = random() % 2 == 0 ? 5 : 8;
    const std::size_t rows = random() % 4;
    Doubles row(static_cast<std::size_t>(frame.size_one));
    frame.chunks.assign(1 + random() % 4, {});
    for (std::size_t i = 0; i < rows; ++i)
    {
      std::generate(row.begin(), row.end(), [&] { return pick({ 0, 1, 2, 0.5 }); });
      Doubles& chunk = frame.chunks[random() % frame.chunks.size()];
      chunk.insert(chunk.end(), row.begin(), row.end());
    }
    const Dump dump(binary::write(form, { frame }).bytes);
    ASSERT_EQ(dump.steps(), Integers{ frame.timestep }) << form.name << " " << round;
    ASSERT_EQ(dump.entry().rows, static_cast<std::int64_t>(rows)) << form.name << " " << round;
    ASSERT_NO_FATAL_FAILURE(expect_layout(dump, form)) << form.name;
    ASSERT_FALSE(HasFailure()) << form.name << " " << round;
  }
}

TEST(BinaryDump, BoxesOfSimulationsThatFailed)
{
  for (const Form& form : forms())
  {
    for (const double odd : { not_a_number, infinity, -infinity, -1e300 })
    {
      Frame frame = binary::particles(form, 3, 2);
      frame.box[1] = odd;
      // bounds the wrong way round are those of another file, unless a magic word says otherwise
      const bool inverted = odd < 0 && form.magic.empty();
      EXPECT_EQ(dump_of(form, { frame }).frames(), inverted ? 0u : 1u) << form.name << " " << odd;
      // behind a frame that can be told by its box, any box will do
      const Dump later = dump_of(form, { binary::particles(form, 0, 2), frame });
      ASSERT_EQ(later.frames(), 2u) << form.name << " " << odd;
      EXPECT_EQ(later.read({}, 1).points(), interleaved(frame, 2));
    }
    Frame flat = binary::particles(form, 3, 2);
    flat.box = { 0, 1, 0, 0, -0.5, -0.5 };
    EXPECT_EQ(dump_of(form, { flat }).frames(), 1u) << form.name;
  }
}

TEST(BinaryDump, LargestAndSmallestHeaderNumbers)
{
  for (const Form& form : forms())
  {
    const std::int64_t largest = form.wide ? std::numeric_limits<std::int64_t>::max() : 2147483647;
    Frame frame = binary::particles(form, 3, 2);
    frame.timestep = largest;
    EXPECT_EQ(dump_of(form, { frame }).steps(), Integers{ largest }) << form.name;
    frame.timestep = form.wide ? 4294967296 : 65536;
    EXPECT_EQ(dump_of(form, { frame }).steps(), Integers{ frame.timestep }) << form.name;
  }
}

TEST(BinaryDump, TheStepsAreInTheUnitsAndTimesOfTheFile)
{
  // as LAMMPS writes them: units once a file, time in every frame
  const Form& form = binary::form("DUMPCUSTOM revision 2, little-endian");
  std::vector<Frame> frames = { binary::particles(form, 0, 1), binary::particles(form, 10, 1),
    binary::particles(form, 20, 1) };
  frames[1].units = frames[2].units = "";
  frames[1].time = 0.125;
  frames[2].time = 0.375;
  const Dump dump = dump_of(form, frames);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(dump.header(i).units, "si");
    EXPECT_EQ(dump.read({}, i).frame.header.units, "si");
    EXPECT_EQ(dump.entry(i).time, *frames[i].time);
  }
  const Folder folder;
  Series run;
  run.update({ folder.write("a.bin", binary::write(form, frames).bytes) });
  EXPECT_EQ(run.index.times(1), (Doubles{ 0, 0.125, 0.375 }));
  EXPECT_EQ(run.said, "");
}

// ---- chunks ------------------------------------------------------------------------------------

TEST(BinaryDump, FramesWithoutRows)
{
  for (const Form& form : forms())
  {
    for (const std::size_t chunks : { 1u, 4u, 5000u })
    {
      SCOPED_TRACE(form.name + ", chunks " + std::to_string(chunks));
      Frame empty = binary::particles(form, 0, 0);
      empty.chunks.assign(chunks, {});
      const Dump dump = dump_of(form, { empty, binary::particles(form, 2, 3), empty });
      EXPECT_EQ(dump.said(), "");
      ASSERT_EQ(dump.frames(), 3u);
      expect_layout(dump, form);
      for (const std::size_t frame : { 0u, 2u })
      {
        Request request;
        for (const bool sort : { false, true })
        {
          request.sort_by_id = sort;
          request.stride = sort ? 2 : 1;
          const Decoded got = dump.read(request, frame);
          EXPECT_EQ(got.rows(), 0);
          EXPECT_EQ(got.names(), "id type image v radius");
          EXPECT_EQ(got.points(), Doubles{});
          EXPECT_EQ(got.said(), "");
        }
      }
      EXPECT_EQ(dump_of(form, { empty }).frames(), 1u);
    }
  }
}

TEST(BinaryDump, AnyChunks)
{
  constexpr std::size_t rows = 5000;
  for (const char* const name :
    { "plain, little-endian", "plain, big-endian", "DUMPCUSTOM revision 2, big-endian" })
  {
    const Form& form = binary::form(name);
    const Frame whole = binary::particles(form, 4, rows);
    Doubles all;
    for (const Doubles& chunk : whole.chunks)
    {
      all.insert(all.end(), chunk.begin(), chunk.end());
    }
    std::minstd_rand random(5);
    // of one row each; of all; across the batches and the buffer of the reader; of any size
    for (const std::size_t most :
      { std::size_t{ 1 }, rows, std::size_t{ 2047 }, std::size_t{ 2731 }, std::size_t{ 300 } })
    {
      Frame frame = whole;
      frame.chunks.clear();
      for (std::size_t row = 0; row < rows;)
      {
        const std::size_t count = std::min(rows - row, most == 300 ? random() % 300 : most);
        frame.chunks.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(12 * row),
          all.begin() + static_cast<std::ptrdiff_t>(12 * (row + count)));
        row += count;
      }
      SCOPED_TRACE(form.name + ", chunks " + std::to_string(frame.chunks.size()));
      const Dump dump = dump_of(form, { frame, frame });
      ASSERT_EQ(dump.frames(), 2u);
      expect_particles(dump, 0, frame);
      expect_particles(dump, 1, frame);
    }
  }
}

TEST(BinaryDump, FramesOfOtherColumns)
{
  for (const Form& form : forms())
  {
    SCOPED_TRACE(form.name);
    const Frame five = frame_of(form, "id type xs ys zs", 5, { 1, 2, 0.5, 0.25, 0.75 });
    const Frame eight =
      frame_of(form, "id type xs ys zs ix iy iz", 8, { 7, 2, 0.5, 0.25, 0.75, 1, 2, -3 });
    const Dump dump(binary::write(form, { five, eight, five }).bytes);
    EXPECT_EQ(dump.said(), "");
    ASSERT_EQ(dump.frames(), 3u);
    EXPECT_EQ(dump.index().unnamed, !form.named());
    EXPECT_EQ(dump.entry(0).kind->schema.text(), "id type xs ys zs");
    EXPECT_EQ(dump.read({}, 0).names(), "id type");
    EXPECT_EQ(dump.read({}, 1).names(), "id type image");
    EXPECT_EQ(dump.read({}, 1).integers("image"), (Integers{ 1, 2, -3 }));
    EXPECT_EQ(dump.read({}, 2).points(), (Doubles{ 0.5, 0.25, 0.75 }));
    EXPECT_EQ(dump.entry(0).kind, dump.entry(2).kind) << "what is the same is kept once";
    EXPECT_NE(dump.entry(0).shape, dump.entry(1).shape);
  }
}

// Also chunks so long that they are decompressed in several steps.
TEST(BinaryDump, CompressedFiles)
{
  for (const char* const name : { "plain, little-endian", "DUMPCUSTOM revision 2, big-endian" })
  {
    const Form& form = binary::form(name);
    const Frame small = binary::particles(form, 1, 1000);
    Frame wide;
    wide.timestep = 2;
    wide.size_one = 5000;
    std::string names = "id x y z";
    for (int i = 5; i <= 5000; ++i)
    {
      names += " c" + std::to_string(i);
    }
    wide.columns = form.named() ? names : "";
    wide.chunks = { Doubles(std::size_t{ 5000 } * 460, 2), {}, Doubles(5000, 4) };
    wide.chunks[0][0] = 7;
    wide.chunks[2][0] = 8;
    const std::vector<Frame> frames =
      form.named() ? std::vector<Frame>{ small, wide, small } : std::vector<Frame>{ wide, wide };
    const Bytes bytes = binary::write(form, frames);
    const bool gzip = !form.named();
    SCOPED_TRACE(std::string(name) + (gzip ? ", gzip" : ", Zstandard"));
    const std::string packed = gzip ? packing::gzip(bytes.bytes) : packing::zstd(bytes.bytes);
    const Dump dump(packed, form.named() ? "" : names);
    EXPECT_EQ(dump.said(), "");
    ASSERT_EQ(dump.frames(), frames.size());
    for (std::size_t i = dump.frames(); i-- > 0;)
    {
      EXPECT_EQ(dump.entry(i).end, static_cast<std::int64_t>(bytes.ends[i]));
      if (frames[i].size_one == 12)
      {
        expect_particles(dump, i, frames[i]);
        continue;
      }
      const Decoded got = dump.read({}, i);
      EXPECT_EQ(got.rows(), 461);
      EXPECT_EQ(got.integers("id")[0], 7);
      EXPECT_EQ(got.integers("id")[460], 8);
      EXPECT_EQ(got.values("c5000")[460], 4);
    }
    const Folder folder;
    EXPECT_TRUE(granular::is_dump_file(folder.write("a.bin", packed)));
    // the end is not there yet
    const Dump cut(packed.substr(0, packed.size() / 2), form.named() ? "" : names);
    EXPECT_LT(cut.frames(), frames.size());
    EXPECT_EQ(cut.said(), "");
  }
}

// ---- names of columns --------------------------------------------------------------------------

TEST(BinaryDump, NamesOfTheFileComeFirst)
{
  const Form& form = binary::form("DUMPATOM revision 2, big-endian");
  const std::string bytes =
    binary::write(form, { frame_of(form, " id  q x y z ", 5, { 1, 2, 3, 4, 5 }) }).bytes;
  const Dump dump(bytes, "id type xs ys zs");
  EXPECT_EQ(dump.entry().kind->schema.text(), "id q x y z");
  EXPECT_FALSE(dump.index().unnamed);
  EXPECT_EQ(dump.read().points(), (Doubles{ 3, 4, 5 }));
  EXPECT_EQ(dump.read().values("q"), Doubles{ 2 });
  const Dump text(one_frame("id x y z", "1 2 3 4\n"), "these are not used");
  EXPECT_EQ(text.entry().kind->schema.text(), "id x y z");
}

TEST(BinaryDump, NamesOfTheUser)
{
  for (const Form& form : forms())
  {
    if (!form.named())
    {
      const std::string bytes =
        binary::write(form, { frame_of(form, "", 5, { 1, 2, 3, 4, 5 }) }).bytes;
      const Dump dump(bytes, "radius z y x f_heat");
      EXPECT_TRUE(dump.index().unnamed);
      EXPECT_EQ(dump.read().points(), (Doubles{ 4, 3, 2 })) << form.name;
      EXPECT_EQ(dump.read().values("radius"), Doubles{ 1 });
      EXPECT_EQ(dump.read().values("f_heat"), Doubles{ 5 });
    }
  }
}

// Nobody has named them: the frames are listed, and the error comes with the first that is read.
TEST(BinaryDump, MissingNamesAreSaidWithTheFirstRow)
{
  for (const Form& form : forms())
  {
    if (form.named())
    {
      continue;
    }
    SCOPED_TRACE(form.name);
    Frame frame =
      frame_of(form, "", 6, { 1, -0.5, 1e-300, 0.1, not_a_number, 2e9, 7, 8, 9, 10, 11, 12 });
    frame.timestep = 3;
    frame.chunks.insert(frame.chunks.begin(), 3, {});
    const Bytes bytes = binary::write(form, { frame, frame });
    const Dump dump(bytes.bytes);
    EXPECT_EQ(dump.said(), "");
    EXPECT_EQ(dump.steps(), (Integers{ 3, 3 }));
    EXPECT_TRUE(dump.index().unnamed);
    EXPECT_FALSE(dump.entry().kind->named);
    for (const std::size_t number : { 0u, 1u })
    {
      EXPECT_EQ(dump.error({}, number),
        "memory@" + std::to_string(number == 0 ? 0 : bytes.ends[0]) +
          ": expected 6 names in ColumnNames, because the file does not name its columns, got "
          "none; "
          "its first row is 1 -0.5 1e-300 0.1 nan 2e+09");
    }
    const Dump many(binary::write(form, { frame_of(form, "", 17, Doubles(17)) }).bytes);
    EXPECT_TRUE(many.error().ends_with("its first row is 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 ..."));
    const Dump sixteen(binary::write(form, { frame_of(form, "", 16, Doubles(16)) }).bytes);
    EXPECT_TRUE(sixteen.error().ends_with("its first row is 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"));
  }
}

TEST(BinaryDump, AWrongNumberOfNamesIsSaidWithTheFirstRow)
{
  for (const Form& form : forms())
  {
    if (form.named())
    {
      continue;
    }
    SCOPED_TRACE(form.name);
    const auto said = [&](const Frame& frame, const std::string& names)
    {
      const Bytes bytes = binary::write(form, { frame });
      const Dump dump(bytes.bytes, names);
      EXPECT_EQ(dump.frames(), 0u);
      EXPECT_TRUE(dump.index().unnamed);
      EXPECT_EQ(dump.said(), "");
      const std::string text = to_string(dump.index().defect.value_or(granular::Notice{}));
      const std::string place = "memory@" + std::to_string(bytes.field("size_one").offset) + ": ";
      EXPECT_TRUE(text.starts_with(place)) << text << " instead of " << place;
      return text.substr(std::min(text.size(), place.size()));
    };
    Frame frame = frame_of(form, "", 6, { 1, -0.5, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 });
    frame.chunks.insert(frame.chunks.begin(), 3, {});
    EXPECT_EQ(said(frame, "id x y z radius"),
      "expected 6 names in ColumnNames, got 5; its first row is 1 -0.5 3 4 5 6");
    frame.chunks = { {} };
    EXPECT_EQ(said(frame, "id x y z radius q mol"), "expected 6 names in ColumnNames, got 7");
    // also where the names of dump atom would do
    EXPECT_EQ(said(frame_of(form, "", 5, { 1, 2, 3, 4, 5 }), "id x y z"),
      "expected 5 names in ColumnNames, got 4; its first row is 1 2 3 4 5");
  }
}

// The first frame may have no rows; whatever comes behind it, the names are what is missing.
TEST(BinaryDump, TheFirstRowMayBeInALaterFrame)
{
  const Form& form = binary::form("plain, big-endian");
  Frame empty = frame_of(form, "", 6, {});
  empty.chunks = { {}, {} };
  const Frame full = frame_of(form, "", 6, { 1, -0.5, 3, 4, 5, 6 });
  const auto said = [](const std::string& bytes) { return Dump(bytes).error(); };
  const std::string no_row = "memory@0: expected 6 names in ColumnNames, because the file does not "
                             "name its columns, got none";
  EXPECT_EQ(said(binary::write(form, { empty, empty, full }).bytes),
    no_row + "; its first row is 1 -0.5 3 4 5 6");
  EXPECT_EQ(said(binary::write(form, { empty, empty }).bytes), no_row);
  // a row of other columns
  EXPECT_EQ(
    said(binary::write(form, { empty, frame_of(form, "", 5, { 1, 2, 3, 4, 5 }) }).bytes), no_row);
  // one that is damaged: the flag triclinic, the number of values
  const Bytes two = binary::write(form, { empty, full });
  for (const std::size_t offset : { two.ends[0] + 16, two.ends[0] + 100 })
  {
    std::string damaged = two.bytes;
    damaged.replace(offset, 4, std::string(4, '\x7f'));
    EXPECT_EQ(said(damaged), no_row) << offset;
  }
  // one that is not there yet, or only in part
  for (std::size_t size = two.ends[0]; size < two.ends[1]; ++size)
  {
    ASSERT_EQ(said(two.bytes.substr(0, size)), no_row) << size;
  }
}

TEST(BinaryDump, TheFileNamesTooFewOrTooMany)
{
  for (const char* const name :
    { "DUMPATOM revision 2, little-endian", "DUMPCUSTOM revision 2, big-endian" })
  {
    const Form& form = binary::form(name);
    for (const std::string columns : { "id type xs ys", "id type xs ys zs q" })
    {
      const Bytes bytes = binary::write(form, { frame_of(form, columns, 5, { 1, 2, 3, 4, 5 }) });
      const Dump dump(bytes.bytes, "id type xs ys zs");
      EXPECT_EQ(dump.frames(), 0u);
      const auto count = std::count(columns.begin(), columns.end(), ' ') + 1;
      EXPECT_EQ(to_string(dump.index().defect.value_or(granular::Notice{})),
        "memory@" + std::to_string(bytes.field("size_one").offset) +
          ": expected 5 column names, got " + std::to_string(count));
    }
    // none at all is as in revision 1
    for (const std::string columns : { "", "   " })
    {
      const Dump none(binary::write(form, { frame_of(form, columns, 5, { 1, 2, 3, 4, 5 }) }).bytes);
      EXPECT_EQ(none.frames(), 1u);
      EXPECT_TRUE(none.index().unnamed);
    }
  }
}

TEST(BinaryDump, AFrameThatTheNamesDoNotFitEndsTheFile)
{
  const Form& form = binary::form("plain, little-endian");
  const Frame good = frame_of(form, "", 6, { 1, 0, 0, 0, 0, 0 });
  const Bytes bytes = binary::write(form, { good, frame_of(form, "", 5, { 1, 2, 3, 4, 5 }), good });
  const Dump dump(bytes.bytes, "id x y z radius q");
  EXPECT_EQ(dump.frames(), 1u);
  EXPECT_EQ(dump.index().resume_offset, static_cast<std::int64_t>(bytes.ends[0]));
  EXPECT_EQ(dump.said(),
    "memory@" + std::to_string(bytes.ends[0] + 92) +
      ": expected 5 names in ColumnNames, got 6; its first row is 1 2 3 4 5; the frame and all "
      "that "
      "follow are left out\n");
}

// ---- pieces ------------------------------------------------------------------------------------

TEST(BinaryDump, ANumberThatDoesNotFitInALaterPiece)
{
  const Form& form = binary::form("DUMPATOM revision 2, big-endian");
  const Folder folder;
  const char* const columns = "id type x y z";
  folder.write("a.0.bin",
    binary::write(form, { frame_of(form, columns, 5, { 4, 1, 0, 0, 0, 3, 1, 0, 0, 0 }) }).bytes);
  const Bytes second =
    binary::write(form, { frame_of(form, columns, 5, { 2, 1, 0, 0, 0, 1, 2.5, 0, 0, 0 }) });
  folder.write("a.1.bin", second.bytes);
  Series run;
  run.update({ folder.path("a.0.bin"), folder.path("a.1.bin") });
  Request request;
  request.sort_by_id = true;
  const Decoded got = run.read(0, request);
  EXPECT_EQ(got.integers("id"), (Integers{ 1, 2, 3, 4 }));
  EXPECT_EQ(got.values("type"), (Doubles{ 2.5, 1, 1, 1 }));
  EXPECT_EQ(got.said(),
    folder.path("a.1.bin") + "@" + std::to_string(second.first_value + 48) +
      ": column 'type': expected an integer, got '2.5'; the column is kept as doubles\n");
}

TEST(BinaryDump, ColumnsThatAreNotThoseOfDumpAtom)
{
  // eight columns that nobody named, of which the last three are no image counts
  const Form& form = binary::form("plain, little-endian");
  const Dump dump(
    binary::write(form, { frame_of(form, "", 8, { 1, 2, 0.1, 0.2, 0.3, 1.5, -2, 0 }) }).bytes);
  EXPECT_EQ(dump.error(),
    "memory@144: column 'ix': expected an integer, got '1.5'; the columns, which the file does not "
    "name, are not those of dump atom: set ColumnNames");
}

TEST(BinaryDump, NamesThatChange)
{
  const Form& form = binary::form("plain, little-endian");
  const Folder folder;
  const std::string path = folder.write(
    "a.bin", binary::write(form, { frame_of(form, "", 5, { 1, 2, 0.5, 0.25, 0.75 }) }).bytes);
  Series run;
  const auto columns = [&] { return run.entry(0).kind->schema.text(); };
  run.update({ path });
  EXPECT_EQ(run.said,
    path +
      ": set ColumnNames if the columns, which the file does not name, are others than id type xs "
      "ys "
      "zs; its first row is 1 2 0.5 0.25 0.75\n");
  EXPECT_EQ(columns(), "id type xs ys zs");
  run.options.column_names = { "id", "type", "x", "y" };
  EXPECT_EQ(error_of([&] { run.update({ path }); }),
    path + "@92: expected 5 names in ColumnNames, got 4; its first row is 1 2 0.5 0.25 0.75");
  EXPECT_EQ(run.index.size(), 0u);
  run.options.column_names.emplace_back("z");
  run.update({ path });
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(columns(), "id type x y z");
  run.options.column_names.clear();
  run.update({ path });
  EXPECT_EQ(columns(), "id type xs ys zs");
}

// ---- types -------------------------------------------------------------------------------------

TEST(BinaryDump, IntegersUpToTheirLimits)
{
  for (const Form& form : forms())
  {
    SCOPED_TRACE(form.name);
    // the largest double below 2^63 and the integers that a double can tell apart
    const Dump dump = one_frame_of(form, "id type x y z mol", 6,
      { 9007199254740992, 2147483647, 0, 0, 0, 0x1p63 - 1024, 9007199254740991, -2147483648.0, 0, 0,
        0, -0x1p63, -9007199254740991, -0.0, 0, 0, 0, -0.0 });
    const Decoded got = dump.read();
    EXPECT_EQ(got.said(), "");
    EXPECT_EQ(
      got.integers("id"), (Integers{ 9007199254740992, 9007199254740991, -9007199254740991 }));
    EXPECT_EQ(got.integers("type"), (Integers{ 2147483647, -2147483648, 0 }));
    EXPECT_EQ(got.integers("mol"),
      (Integers{ 9223372036854774784, std::numeric_limits<std::int64_t>::min(), 0 }));
  }
}

TEST(BinaryDump, OtherNumbersInIntegerColumnsAreKeptInWiderTypes)
{
  struct Case
  {
    std::size_t column;
    const char* name;
    double value;
    const char* text;
  };
  const Case cases[] = {
    { 0, "id", 1.5, "1.5" },
    { 0, "id", not_a_number, "nan" },
    { 0, "id", -not_a_number, "-nan" },
    { 0, "id", 0x1p63, "9223372036854775808" },
    { 0, "id", -0x1.0000000000001p63, "-9223372036854777856" },
    { 0, "id", infinity, "inf" },
    { 0, "id", 5e-324, "5e-324" },
    { 1, "type", 2147483648.0, "2147483648" },
    { 1, "type", -2147483649.0, "-2147483649" },
    { 1, "type", -infinity, "-inf" },
    { 1, "type", 0.1, "0.1" },
  };
  const char* const columns = "id type x y z";
  for (const Form& form : forms())
  {
    for (const Case& one : cases)
    {
      // also behind the first batch, and behind what the reader holds at a time
      const bool far = one.value == 1.5 || one.value == 2147483648.0;
      for (const std::size_t row :
        far ? std::vector<std::size_t>{ 0, 3000, 9999 } : std::vector<std::size_t>{ 2 })
      {
        SCOPED_TRACE(form.name + " " + one.text + " " + std::to_string(row));
        Doubles values;
        for (std::size_t i = 0; i <= row + 1; ++i)
        {
          values.insert(values.end(), { static_cast<double>(10000 - i), 1, 0, 0, 0 });
        }
        values[5 * row + one.column] = one.value;
        const Dump dump = one_frame_of(form, columns, 5, values);
        const std::size_t at = first_value(form, columns, 5, values) + 8 * (5 * row + one.column);
        const Decoded got = dump.read();
        const bool whole =
          one.column == 1 && std::trunc(one.value) == one.value && std::abs(one.value) < 1e10;
        EXPECT_EQ(got.said(),
          whole ? ""
                : "memory@" + std::to_string(at) + ": column '" + one.name +
              "': expected an integer, got '" + one.text + "'; the column is kept as doubles\n");
        ASSERT_EQ(got.type(one.name), whole ? ValueType::Int64 : ValueType::Float64);
        Doubles expected;
        for (std::size_t i = 0; i <= row + 1; ++i)
        {
          expected.push_back(values[5 * i + one.column]);
        }
        Doubles read = whole ? Doubles() : got.values(one.name);
        for (const std::int64_t value : whole ? got.integers(one.name) : Integers())
        {
          read.push_back(static_cast<double>(value));
        }
        ASSERT_EQ(read.size(), expected.size());
        EXPECT_EQ(std::memcmp(read.data(), expected.data(), 8 * expected.size()), 0);
        EXPECT_EQ(got.type(one.column == 0 ? "type" : "id"),
          one.column == 0 ? ValueType::Int32 : ValueType::Int64);
        EXPECT_EQ(dump.entry().kind->schema.columns()[one.column].type,
          one.column == 0 ? ValueType::Int64 : ValueType::Int32)
          << "the index stays as it was";
      }
    }
  }
}

TEST(BinaryDump, ImagesThatAreNoIntegersMoveThePointsAllTheSame)
{
  const Form& form = binary::form("plain, little-endian");
  const Dump dump = one_frame_of(
    form, "id type x y z ix iy iz", 8, { 1, 1, 0.25, 0.5, 0.75, 1, 0.5, 4294967296.0 });
  Request request;
  request.coordinates = Coordinates::Unwrapped;
  const Decoded got = dump.read(request);
  EXPECT_EQ(got.points(), (Doubles{ 1.25, 1, 4294967296.75 }));
  EXPECT_EQ(got.type("image"), ValueType::Float64);
  EXPECT_EQ(got.values("image"), (Doubles{ 1, 0.5, 4294967296.0 }));
  EXPECT_EQ(got.said(),
    "memory@" + std::to_string(100 + 4 + 6 * 8) +
      ": column 'iy': expected an integer, got '0.5'; the column is kept as doubles\n");
}

TEST(BinaryDump, ElementsAreTheNumbersOfTheirTypes)
{
  for (const Form& form : forms())
  {
    const Dump dump =
      one_frame_of(form, "element typelabel x y z", 5, { 2, 1, 0, 0, 0, 1, 7, 0, 0, 0 });
    const Decoded got = dump.read();
    EXPECT_EQ(got.said(), "");
    EXPECT_EQ(got.type("element"), ValueType::Int32) << form.name;
    EXPECT_EQ(got.integers("element"), (Integers{ 2, 1 }));
    EXPECT_EQ(got.integers("typelabel"), (Integers{ 1, 7 }));
    const Dump odd = one_frame_of(form, "element x y z q", 5, { 0.5, 0, 0, 0, 0 });
    EXPECT_EQ(odd.read().values("element"), Doubles{ 0.5 });
  }
}

TEST(BinaryDump, IdsThatAreNoIntegersAreNotSortedBy)
{
  for (const Form& form : forms())
  {
    SCOPED_TRACE(form.name);
    const char* const columns = "id type x y z";
    const Doubles values = { 3, 1, 30, 0, 0, 1.5, 1, 15, 0, 0, 1, 1, 10, 0, 0, 2, 1, 20, 0, 0 };
    const Bytes bytes = binary::write(form, { frame_of(form, columns, 5, values) });
    const Dump dump(bytes.bytes, form.named() ? "" : columns);
    const std::string said = "memory@" + std::to_string(bytes.first_value + 40) +
      ": column 'id': expected an integer, got '1.5'; the column is kept as doubles\n";
    const std::string no_sort =
      "memory@0: expected a column id to sort by, got none; the order is the file's\n";
    Request request;
    request.sort_by_id = true;
    const Decoded got = dump.read(request);
    EXPECT_EQ(got.values("id"), (Doubles{ 3, 1.5, 1, 2 }));
    EXPECT_EQ(got.points(), (Doubles{ 30, 0, 0, 15, 0, 0, 10, 0, 0, 20, 0, 0 }));
    EXPECT_EQ(got.said(), said + no_sort);
    // the same where the ids are no array
    request.wanted = [](std::string_view name, bool) { return name == "type"; };
    const Decoded none = dump.read(request);
    EXPECT_EQ(none.points(), got.points());
    EXPECT_EQ(none.said(), said + no_sort);
    // every n-th row, where there are no ids to go by
    request.sort_by_id = false;
    request.stride = 3;
    EXPECT_EQ(dump.read(request).points(), (Doubles{ 30, 0, 0, 20, 0, 0 }));
    EXPECT_EQ(dump.read(request).said(), said);
  }
}

TEST(BinaryDump, ColumnsThatNobodyWantsMayHoldAnything)
{
  const Form& form = binary::form("plain, big-endian");
  const Dump dump = one_frame_of(form, "id type x y z", 5, { not_a_number, 0.5, 1, 2, 3 });
  Request request;
  request.wanted = [](std::string_view, bool) { return false; };
  const Decoded got = dump.read(request);
  EXPECT_EQ(got.said(), "");
  EXPECT_EQ(got.points(), (Doubles{ 1, 2, 3 }));
}

TEST(BinaryDump, RowsChosenAndSorted)
{
  constexpr std::int64_t rows = 7000;
  for (const char* const name : { "plain, little-endian", "before 2011, tilts, big-endian" })
  {
    const Form& form = binary::form(name);
    Frame frame;
    frame.size_one = 5;
    frame.box = { 0, 10000, 0, 1, 0, 1 };
    frame.chunks = { {}, {} };
    for (std::int64_t row = 0; row < rows; ++row)
    {
      const auto id = static_cast<double>(row * 7919 % 10007);
      Doubles& chunk = frame.chunks[row < 2500 ? 0 : 1];
      chunk.insert(chunk.end(), { id, 1, static_cast<double>(row), 0.5, id });
    }
    const Dump dump(binary::write(form, { frame }).bytes, "id type x y z");
    Request request;
    request.stride = 3;
    request.sort_by_id = true;
    request.region = { 1000, 6000, 1, -1, 1, -1 };
    request.single_precision = true;
    const Decoded got = dump.read(request);
    std::vector<std::pair<std::int64_t, std::int64_t>> expected;
    for (std::int64_t row = 1000; row <= 6000; ++row)
    {
      if (row * 7919 % 10007 % 3 == 0)
      {
        expected.emplace_back(row * 7919 % 10007, row);
      }
    }
    std::sort(expected.begin(), expected.end());
    const std::vector<float> points = got.single_points();
    const Integers ids = got.integers("id");
    ASSERT_EQ(ids.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      ASSERT_EQ(ids[i], expected[i].first);
      ASSERT_EQ(points[3 * i], static_cast<float>(expected[i].second));
      ASSERT_EQ(points[3 * i + 2], static_cast<float>(expected[i].first));
    }
  }
}

// ---- what is a binary dump -----------------------------------------------------------------------

// The magic word says it, also where the names alone are longer than what is given.
TEST(BinaryDump, KnownByItsFirst200Bytes)
{
  std::string names = "id type x y z";
  for (int i = 1; i <= 40; ++i)
  {
    names += " c_stress[" + std::to_string(i) + "]";
  }
  std::string unknown;
  for (const Form& form : forms())
  {
    for (int triclinic = 0; triclinic <= form.most_triclinic(); ++triclinic)
    {
      for (const std::int64_t rows : { 0, 1, 5, 40 })
      {
        const std::string bytes =
          binary::write(form, { binary::particles(form, 0, rows, triclinic) }).bytes;
        unknown += granular::is_binary_dump(std::string_view(bytes).substr(0, 200))
          ? ""
          : form.name + ", triclinic " + std::to_string(triclinic) + "\n";
      }
    }
    const std::string bytes = binary::write(form, { frame_of(form, names, 45, Doubles(45)) }).bytes;
    EXPECT_TRUE(granular::is_binary_dump(bytes)) << form.name;
    unknown += granular::is_binary_dump(std::string_view(bytes).substr(0, 200))
      ? ""
      : form.name + ", 45 columns\n";
  }
  EXPECT_EQ(unknown, "");
}

TEST(BinaryDump, OtherFilesAreNone)
{
  const std::string elf =
    bytes_of("7f454c46 02010100 0000000000000000 03003e00 01000000 d061000000000000"
             "4000000000000000 7047020000000000 00000000 4000 3800 0d00 4000 1f00 1e00"
             "06000000 04000000 4000000000000000 4000000000000000 4000000000000000"
             "d802000000000000 d802000000000000 0800000000000000 03000000 04000000");
  const std::string png = bytes_of(
    "89504e470d0a1a0a 0000000d 49484452 00000280 000001e0 08 06 000000 35d1dce4"
    "00000006 624b4744 00ff00ff00ff a0bda793 00000009 70485973 00000b13 00000b13 01 009a9c18"
    "00002000 49444154 789c ecdd");
  const std::string gzip = bytes_of("1f8b0800 00000000 0003 4bcb cf07 0021 6573 8c03 000000");
  // a restart file of LIGGGHTS: the flag 0, the length of the version, the version, flags and sizes
  const std::string version =
    "Version LIGGGHTS-PUBLIC 3.8.0, compiled 2022-01-26-19:42:32 by buildd, "
    "git commit unknown";
  const std::string restart = bytes_of("00000000 5a000000") + version +
    bytes_of("00 01000000 04000000 02000000 04000000 03000000 08000000 04000000 03000000 736900"
             "05000000 a00f000000000000 06000000 03000000 07000000 04000000 08000000 02000000");
  // a mesh: 80 bytes of comment, the number of triangles, floats
  const std::string stl =
    std::string(80, '\0') + bytes_of("02000000 00000000 00000000 0000803f") + std::string(88, '\0');
  const std::string numpy = bytes_of("93") + "NUMPY" + bytes_of("0100 7600") +
    "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }";
  const std::string hdf5 =
    bytes_of("894844460d0a1a0a 00000000 00080800 0400 1000 00000000 0000000000000000"
             "ffffffffffffffff 8008000000000000 ffffffffffffffff 0000000000000000"
             "6000000000000000 0100000000000000 8800000000000000 a802000000000000");
  const std::string netcdf =
    bytes_of("43444601 00000000 0000000a 00000005") + "frame" + std::string(100, '\0');
  const std::string counting = []
  {
    std::string text;
    for (int i = 0; i < 1000; ++i)
    {
      text += { static_cast<char>(i), static_cast<char>(i >> 8), '\0', '\0' };
    }
    return text;
  }();
  const std::vector<std::pair<const char*, std::string>> others = {
    { "nothing", "" },
    { "a byte", std::string(1, '\0') },
    { "ELF", elf },
    { "PNG", png },
    { "gzip", gzip },
    { "restart", restart },
    { "STL", stl },
    { "numpy", numpy },
    { "HDF5", hdf5 },
    { "netCDF", netcdf },
    { "integers", counting },
    { "a small number",
      bytes_of("c0ffffffffffffff 5b5c5d5e5f606162 0102030405060708 090a0b0c0d0e") },
    { "VTK",
      "# vtk DataFile Version 2.0\nLIGGGHTS mesh/gran/VTK export\nASCII\nDATASET "
      "RECTILINEAR_GRID\n" },
    { "binary VTK",
      "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET POLYDATA\nPOINTS 1 double\n" +
        std::string(24, '\0') },
    { "words", "Step Atoms KinEng Volume\n0 1200 0.5 1\n" },
  };
  for (const auto& [what, bytes] : others)
  {
    EXPECT_FALSE(granular::is_binary_dump(bytes)) << what;
    EXPECT_FALSE(granular::is_dump(bytes)) << what;
  }
  for (const char byte : { '\x00', '\x01', '\x02', '\x07', '\x20', '\x7f', '\x80', '\xff' })
  {
    for (const std::size_t size : { 8u, 64u, 100u, 200u, 4096u, 65536u })
    {
      EXPECT_FALSE(granular::is_binary_dump(std::string(size, byte))) << int(byte) << " " << size;
    }
  }
}

TEST(BinaryDump, TextDumpsAreNone)
{
  for (const char* const folder : { "good", "bad" })
  {
    for (const auto& entry :
      std::filesystem::directory_iterator(std::string(GRANULAR_DATA) + "/" + folder))
    {
      if (entry.path().extension() == ".dump")
      {
        const std::string text = data_file(folder + ("/" + entry.path().filename().string()));
        EXPECT_FALSE(granular::is_binary_dump(text)) << entry.path();
        EXPECT_FALSE(granular::is_binary_dump(text.substr(0, 200))) << entry.path();
      }
    }
  }
}

TEST(BinaryDump, RandomBytesAreNone)
{
  std::string bytes(200, '\0');
  std::vector<std::uint64_t> taken;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed)
  {
    std::uint64_t state = seed << 32;
    const auto random = [&state]
    {
      // SplitMix64
      std::uint64_t word = state += 0x9e3779b97f4a7c15;
      word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9;
      word = (word ^ (word >> 27)) * 0x94d049bb133111eb;
      return word ^ (word >> 31);
    };
    // also small integers, which files of all kinds are full of
    const unsigned kind = seed % 4;
    for (std::size_t i = 0; i < bytes.size(); i += 4)
    {
      const std::uint64_t word = random() >> 32;
      const std::uint64_t number = kind == 0 ? word
        : kind == 1                          ? word >> 29
        : kind == 2                          ? word >> 20
                                             : word & (word >> 8) & (word >> 16);
      for (std::size_t byte = 0; byte < 4; ++byte)
      {
        bytes[i + byte] = static_cast<char>(number >> (8 * byte) & 0xff);
      }
    }
    if (granular::is_binary_dump(bytes))
    {
      taken.push_back(seed);
    }
  }
  EXPECT_EQ(taken.size(), 0u) << "the first is " << (taken.empty() ? 0 : taken[0]);
}
