// SPDX-License-Identifier: BSD-3-Clause
// The files of tests/data/good are read and written again: the bytes are those that LIGGGHTS and LAMMPS wrote.
#include "../support/byte_source_packing.h"
#include "../support/dump_writing.h"
#include "../support/dumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
using namespace granular;

/// A file with its frames as they are read.
struct Loaded
{
  std::string bytes; ///< not compressed
  std::vector<ReadFrameView> frames;

  Frames views() const
  {
    Frames views;
    for (const ReadFrameView& frame : frames)
    {
      views.push_back(frame.view);
    }
    return views;
  }
};

Loaded load(const std::string& file, const Request& request, const std::string& columns = "")
{
  Loaded loaded;
  loaded.bytes = data_file("good/" + file);
  if (file.ends_with(".gz"))
  {
    loaded.bytes = packing::read_all(*packing::open(loaded.bytes));
  }
  const Dump dump(loaded.bytes, columns);
  for (std::size_t i = 0; i < dump.frames(); ++i)
  {
    loaded.frames.emplace_back(dump.read(request, i).frame);
    loaded.frames.back().view.point_origin = request.point_origin;
  }
  EXPECT_FALSE(loaded.frames.empty());
  return loaded;
}

/// Writes what was read in a format, and looks for the first byte that is another.
std::string change(const std::string& file, const Request& request, DumpFormat format,
  const std::string& columns = "")
{
  const Loaded loaded = load(file, request, columns);
  const Folder folder;
  const Written written = write_dump(folder.path("again"), loaded.views(), format);
  EXPECT_EQ(written.error, "");
  return difference(written.bytes, loaded.bytes);
}

DumpFormat text_of(Dialect dialect, int digits = 6, bool units_and_time = false)
{
  DumpFormat format;
  format.dialect = dialect;
  format.numbers.digits = digits;
  format.units = units_and_time;
  format.time = units_and_time;
  return format;
}

/// With the digits and the dialect of the file.
DumpFormat as_it_was(bool units_and_time = false)
{
  DumpFormat format = text_of(Dialect::Liggghts, 3, units_and_time);
  format.dialect.reset();
  format.numbers = automatic_numbers;
  return format;
}

DumpFormat binary_of(Dialect dialect)
{
  DumpFormat format;
  format.dialect = dialect;
  format.binary = true;
  return format;
}

Request points_as(Coordinates coordinates)
{
  Request request;
  request.coordinates = coordinates;
  return request;
}

/// All that a reader can make of the points, the numbers of the file beside them.
std::vector<Request> requests()
{
  std::vector<Request> requests;
  for (const Coordinates coordinates :
    { Coordinates::Absolute, Coordinates::Unwrapped, Coordinates::Scaled })
  {
    requests.push_back(everything());
    requests.back().coordinates = coordinates;
    requests.push_back(requests.back());
    requests.back().single_precision = true;
    requests.push_back(requests.back());
    requests.back().point_origin = { 1.25, -3, 0.001953125 };
  }
  return requests;
}

const std::vector<std::string> liggghts_texts = { "grains.dump", "grains_0.dump",
  "grains_1000.dump", "grains_2000.dump", "grains_label.dump", "plain.dump", "pieces_0.0.dump",
  "pieces_0.1.dump", "pieces_0.2.dump", "pieces_0.3.dump", "pieces_1000.0.dump",
  "pieces_1000.1.dump", "pieces_1000.2.dump", "pieces_1000.3.dump", "pieces_2000.0.dump",
  "pieces_2000.1.dump", "pieces_2000.2.dump", "pieces_2000.3.dump" };
const std::vector<std::string> lammps_texts = { "chain.dump", "ortho_image.dump",
  "ortho_plain.dump", "ortho_scaled.dump", "ortho_scaled_image.dump", "tri_image.dump",
  "tri_plain.dump", "tri_scaled.dump", "tri_scaled_image.dump", "ortho_000000.dump.gz",
  "ortho_000050.dump.gz", "ortho_000100.dump.gz", "tri_000000.dump.gz", "tri_000050.dump.gz",
  "tri_000100.dump.gz" };

constexpr const char* plain_columns = "id type x y z ix iy iz vx vy vz radius element";
}

/// As whoever opens a file and saves it: absolute points, all arrays but the forms of positions.
TEST(WriteRealFiles, texts)
{
  for (const std::string& file : liggghts_texts)
  {
    EXPECT_EQ(change(file, {}, text_of(Dialect::Liggghts)), "") << file;
    EXPECT_EQ(change(file, {}, as_it_was()), "") << file;
  }
  for (const std::string& file : lammps_texts)
  {
    EXPECT_EQ(change(file, {}, text_of(Dialect::Lammps)), "") << file;
    EXPECT_EQ(change(file, {}, as_it_was()), "") << file;
  }
}

/// What a simulation prints it did not compute as we do: xsu, for one, has lost digits to the count of
/// images. The arrays of these columns bring the very numbers back, whatever the points were made to be.
TEST(WriteRealFiles, forms_of_points)
{
  const std::vector<Request> all = requests();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    for (const std::string& file : liggghts_texts)
    {
      EXPECT_EQ(change(file, all[i], text_of(Dialect::Liggghts)), "") << file << " " << i;
      EXPECT_EQ(change(file, all[i], as_it_was()), "") << file << " " << i;
    }
    for (const std::string& file : lammps_texts)
    {
      EXPECT_EQ(change(file, all[i], text_of(Dialect::Lammps)), "") << file << " " << i;
      EXPECT_EQ(change(file, all[i], as_it_was()), "") << file << " " << i;
    }
    for (const char* const file : { "ortho_unwrapped.dump", "tri_unwrapped.dump" })
    {
      EXPECT_EQ(change(file, all[i], text_of(Dialect::Lammps, 17, true)), "") << file << " " << i;
      EXPECT_EQ(change(file, all[i], as_it_was(true)), "") << file << " " << i;
    }
  }
}

/// Six digits are made from points of any form.
TEST(WriteRealFiles, forms_of_points_alone)
{
  for (const Coordinates coordinates :
    { Coordinates::Absolute, Coordinates::Unwrapped, Coordinates::Scaled })
  {
    const Request request = points_as(coordinates);
    for (const char* const file : { "grains.dump", "grains_2000.dump", "plain.dump" })
    {
      EXPECT_EQ(change(file, request, text_of(Dialect::Liggghts)), "") << file;
      EXPECT_EQ(change(file, request, as_it_was()), "") << file;
    }
    for (const char* const file :
      { "chain.dump", "ortho_image.dump", "ortho_scaled_image.dump", "tri_scaled_image.dump" })
    {
      EXPECT_EQ(change(file, request, text_of(Dialect::Lammps)), "") << file;
      EXPECT_EQ(change(file, request, as_it_was()), "") << file;
    }
  }
}

/// Values that are no longer those of the file, and arrays that are new, read back as they are.
TEST(WriteRealFiles, changed_values_lose_nothing)
{
  Loaded loaded = load("grains.dump", {});
  loaded.frames.erase(loaded.frames.begin(), loaded.frames.end() - 1);
  ReadFrameView& read = loaded.frames.front();
  auto* points = reinterpret_cast<double*>(read.frame.points.data());
  const auto moved = static_cast<std::size_t>(read.view.rows) * 3 / 2;
  std::vector<double> speeds(static_cast<std::size_t>(read.view.rows));
  for (std::size_t i = 0; i < moved; ++i)
  {
    points[i] *= 1.0 / 3;
    speeds[i / 3] = points[i] * 7;
  }
  read.view.arrays.push_back(view_rows("speed", ValueType::Float64, speeds.data()));
  const Folder folder;
  const Written written = write_dump(folder.path("again"), loaded.views(), as_it_was());
  const Dump again(written.bytes);
  const Decoded found = again.read();
  ASSERT_EQ(found.rows(), read.view.rows);
  EXPECT_EQ(found.points(), std::vector<double>(points, points + 3 * speeds.size()));
  EXPECT_EQ(found.values("speed"), speeds);
  // the box has its six digits
  const std::size_t box = loaded.bytes.rfind("ITEM: BOX");
  const std::string text = loaded.bytes.substr(box, loaded.bytes.rfind("ITEM: ATOMS") - box);
  EXPECT_NE(written.bytes.find(text), std::string::npos);
  EXPECT_EQ(written.said, "");
}

/// Without a name in the file a binary one is written with names, unless it was a binary one without.
TEST(WriteRealFiles, dialect_of_binary)
{
  const auto names = [](const std::string& file, const std::string& columns)
  {
    DumpFormat format = as_it_was();
    format.binary = true;
    const Folder folder;
    const Loaded loaded = load(file, {}, columns);
    const Written written = write_dump(folder.path("a.bin"), loaded.views(), format);
    return written.bytes.find("radius") != std::string::npos;
  };
  EXPECT_TRUE(names("plain.dump", ""));
  EXPECT_FALSE(names("plain.bin", plain_columns));
}

/// Scaled coordinates have all their bits in a binary file: they come back where they are kept as they are.
TEST(WriteRealFiles, scaled_binary)
{
  for (const std::string box : { "ortho", "tri" })
  {
    const Form scaled{ { true, false }, box == "tri", true };
    const DumpFormat format = atom_format(scaled, Dialect::Lammps);
    EXPECT_EQ(change(box + "_scaled.bin", points_as(Coordinates::Scaled), format), "") << box;
    EXPECT_EQ(change(box + "_scaled.bin", everything(), format), "") << box;
  }
}

TEST(WriteRealFiles, binary_without_names)
{
  EXPECT_EQ(change("plain.bin", {}, binary_of(Dialect::Liggghts), plain_columns), "");
}

/// The text is the binary file of the same run, and the elements become the types that they are of.
TEST(WriteRealFiles, text_to_binary)
{
  const Loaded text = load("plain.dump", everything());
  const Folder folder;
  const Written written =
    write_dump(folder.path("plain.bin"), text.views(), binary_of(Dialect::Liggghts));
  const std::string expected = data_file("good/plain.bin");
  ASSERT_EQ(written.bytes.size(), expected.size());
  const Dump again(written.bytes, plain_columns);
  const Dump first(expected, plain_columns);
  ASSERT_EQ(again.frames(), first.frames());
  for (std::size_t i = 0; i < again.frames(); ++i)
  {
    const Decoded one = again.read({}, i);
    const Decoded other = first.read({}, i);
    EXPECT_EQ(one.integers("id"), other.integers("id"));
    EXPECT_EQ(one.integers("image"), other.integers("image"));
    EXPECT_EQ(one.values("element"), other.values("element"));
  }
}

/// What cannot come back, and why.
TEST(WriteRealFiles, what_changes)
{
  // a run on several processes writes a chunk for each of them; ours has as few as there can be
  const Loaded chunks = load("grains.bin", {}, "id type x y z ix iy iz vx vy vz radius");
  const Folder folder;
  const Written one_chunk =
    write_dump(folder.path("one"), chunks.views(), binary_of(Dialect::Liggghts));
  constexpr std::size_t frames = 3;
  constexpr std::size_t length = 4;
  EXPECT_EQ(one_chunk.bytes.size(), chunks.bytes.size() - frames * 3 * length);

  // a 0 that is the sum of terms, none of which is, is as far off as these were rounded
  const std::string changed =
    change("tri_image.dump", points_as(Coordinates::Scaled), text_of(Dialect::Lammps));
  EXPECT_NE(changed.find("-3.99125e-18 0.839798 2.51939"), changed.npos) << changed;
  EXPECT_NE(changed.find("\n102 1 0 0.839798 2.51939"), changed.npos) << changed;

  // two forms in six digits each: the points are made from one, and give the other but for its last digit
  const Dump dump(
    one_frame("x y z xs", "1.03679 2 3 0.123456\n", " pp pp pp\n0 8.39798\n0 9\n0 9\n"));
  const ReadFrameView both(dump.read(everything()).frame);
  EXPECT_NE(write_dump(folder.path("two"), Frames{ both.view }, {})
              .bytes.find("x y z xs\n1.03679 2 3 0.123457\n"),
    std::string::npos);

  // a bound of -0 is 0 in the box
  const Dump minus(one_frame("x y z", "1 2 3\n", " pp pp pp\n-0 9\n0 9\n0 9\n"));
  const ReadFrameView zero(minus.read().frame);
  EXPECT_NE(write_dump(folder.path("zero"), Frames{ zero.view }, text_of(Dialect::Liggghts))
              .bytes.find("pp pp pp\n0 9\n"),
    std::string::npos);

  // xsu with 17 digits, made anew
  EXPECT_NE(change("ortho_unwrapped.dump", {}, text_of(Dialect::Lammps, 17, true)), "");

  // scaled coordinates made from absolute ones differ in their last bits
  const Form scaled{ { true, false }, true, true };
  EXPECT_NE(change("tri_scaled.bin", {}, atom_format(scaled, Dialect::Lammps)), "");
}
