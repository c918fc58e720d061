// SPDX-License-Identifier: BSD-3-Clause
// Which columns a dump gets, and what they are made from.
#include "../support/dump_writing.h"
#include "../support/dumps.h"

#include "granular/formats/dump/write/column_plan.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace
{
using namespace granular;

using Names = std::vector<std::string>;

/// Two particles in a box from 0 to 10, and no arrays.
struct TwoParticles
{
  TwoParticles()
  {
    frame.header.box = Box::from_bounds({ 0, 0, 0 }, { 10, 10, 10 });
    frame.header.box.boundary = "pp pp pp";
    frame.rows = 2;
    frame.points = view_rows("points", ValueType::Float64, points.data(), 3);
  }

  template <class Value>
  void add(const std::string& name, ValueType type, const std::vector<Value>& values)
  {
    frame.arrays.push_back(
      view_rows(name, type, values.data(), static_cast<int>(values.size() / 2)));
  }

  std::vector<double> points = { 1, 2, 3, 4, 5, 6 };
  FrameView frame;
};

struct Text
{
  std::string body; ///< behind "ITEM: ATOMS "
  std::string said;
  std::string error;
};

Text write(const FrameView& frame, const Names& columns, DumpFormat format = {})
{
  const Folder folder;
  format.columns = columns;
  const Written written = write_dump(folder.path("a"), Frames{ frame }, format);
  const std::string mark = "ITEM: ATOMS ";
  const std::size_t at = written.bytes.find(mark);
  EXPECT_EQ(names_in(folder.path("")), written.error.empty() ? "a" : "");
  return { at == std::string::npos ? "" : written.bytes.substr(at + mark.size()), written.said,
    written.error };
}

/// The values of a binary dump, row by row.
std::vector<double> write_binary(
  const FrameView& frame, const Names& columns, std::string* error = nullptr)
{
  const Folder folder;
  DumpFormat format;
  format.binary = true;
  format.columns = columns;
  const Written written = write_dump(folder.path("a"), Frames{ frame }, format);
  EXPECT_EQ(error ? "" : written.error, "");
  if (error)
  {
    *error = written.error;
  }
  std::vector<double> values(static_cast<std::size_t>(frame.rows) * columns.size());
  const std::size_t bytes = values.size() * sizeof(double);
  if (written.bytes.size() > bytes)
  {
    std::copy_n(written.bytes.end() - static_cast<std::ptrdiff_t>(bytes), bytes,
      reinterpret_cast<char*>(values.data()));
  }
  return values;
}

const std::vector<std::int64_t> ids = { 7, 3 };
const std::vector<std::int32_t> types = { 2, 1 };
}

TEST(WriteColumns, vectors)
{
  TwoParticles particles;
  const std::vector<double> v = { 0.5, -1, 2, 3, 4e-7, 5 };
  const std::vector<float> quat = { 1, 0, 0, 0, 0.5F, 0.5F, 0.5F, 0.5F };
  const std::vector<double> stress = { 1, 2, 3, 4, 5, 6, 11, 12, 13, 14, 15, 16 };
  particles.add("v", ValueType::Float64, v);
  particles.add("quat", ValueType::Float32, quat);
  particles.add("c_stress", ValueType::Float64, stress);
  EXPECT_EQ(write(particles.frame, { "vx", "vy", "vz" }).body, "vx vy vz\n0.5 -1 2\n3 4e-07 5\n");
  EXPECT_EQ(write(particles.frame, { "v" }).body, "vx vy vz\n0.5 -1 2\n3 4e-07 5\n");
  EXPECT_EQ(write(particles.frame, { "vz", "vx" }).body, "vz vx\n2 0.5\n5 3\n");
  EXPECT_EQ(write(particles.frame, { "quat4", "quat1" }).body, "quat4 quat1\n0 1\n0.5 0.5\n");
  EXPECT_EQ(write(particles.frame, { "c_stress[6]", "c_stress[1]" }).body,
    "c_stress[6] c_stress[1]\n6 1\n16 11\n");
  EXPECT_EQ(write(particles.frame, { "c_stress" }).body,
    "c_stress[1] c_stress[2] c_stress[3] c_stress[4] c_stress[5] c_stress[6]\n1 2 3 4 5 6\n"
    "11 12 13 14 15 16\n");
  EXPECT_EQ(write(particles.frame, { "v[2]" }).body, "v[2]\n-1\n4e-07\n");
  for (const char* const name : { "c_stress[7]", "c_stress[0]", "c_stress[-1]", "c_stress[]",
         "c_stress[1", "c_stress[1]x", "c_stress[x]", "vw", "c_stress[99999999999]" })
  {
    EXPECT_EQ(write(particles.frame, { name }).error,
      std::string("column '") + name +
        "': expected an array to make it from, got none: there are v, quat, c_stress");
  }
}

TEST(WriteColumns, frameWithoutParticles)
{
  TwoParticles particles;
  particles.frame.rows = 0;
  const Text any =
    write(particles.frame, { "id", "type", "x", "v", "radius", "speed", "c_stress" });
  EXPECT_EQ(any.body, "id type x vx vy vz radius speed c_stress\n");
  EXPECT_EQ(any.said + any.error, "");
  const std::vector<double> speeds = { 1, 2 };
  particles.add("speed", ValueType::Float64, speeds);
  EXPECT_EQ(write(particles.frame, { "id", "radius" }).error,
    "column 'radius': expected an array to make it from, got none: there are speed");
}

TEST(WriteColumns, missing)
{
  TwoParticles particles;
  const Text made = write(particles.frame, { "type", "id", "x" });
  EXPECT_EQ(made.body, "type id x\n1 1 1\n1 2 4\n");
  EXPECT_EQ(made.said,
    "no array 'type': the type of all is 1\nno array 'id': ids are the numbers of the rows, from "
    "1\n");
  EXPECT_EQ(write(particles.frame, { "radius" }).error,
    "column 'radius': expected an array to make it from, got none: there are no arrays");
  particles.frame.points.reset();
  EXPECT_EQ(write(particles.frame, { "id", "x" }).error,
    "column 'x': expected an array to make it from, got none: there are no arrays");
  EXPECT_EQ(write(particles.frame, { "id" }).body, "id\n1\n2\n");
  EXPECT_EQ(write(particles.frame, { "ix" }).body, "ix\n0\n0\n");
  particles.frame.coordinates = Coordinates::Unwrapped;
  EXPECT_EQ(write(particles.frame, { "ix" }).body, "ix\n0\n0\n");
}

TEST(WriteColumns, names)
{
  TwoParticles particles;
  const std::vector<double> heat = { 1.5, 2.5 };
  const std::vector<double> two = { 1, 2, 3, 4 };
  particles.add("heat flux", ValueType::Float64, heat);
  particles.add("my\tpair of numbers", ValueType::Float64, two);
  EXPECT_EQ(write(particles.frame, { "heat_flux" }).body, "heat_flux\n1.5\n2.5\n");
  EXPECT_EQ(write(particles.frame, { "my_pair_of_numbers" }).body,
    "my_pair_of_numbers[1] my_pair_of_numbers[2]\n1 2\n3 4\n");
  EXPECT_EQ(write(particles.frame, {}).body,
    "id type x y z heat_flux my_pair_of_numbers[1] my_pair_of_numbers[2]\n1 1 1 2 3 1.5 1 2\n"
    "2 1 4 5 6 2.5 3 4\n");
  for (const auto& [name, shown] : { std::pair("heat flux", "heat flux"), std::pair("", ""),
         std::pair(" id", " id"), std::pair("id\n", "id\\n") })
  {
    EXPECT_EQ(write(particles.frame, { "id", name }).error,
      std::string("expected the name of a column as one word, got '") + shown + "'");
  }
}

TEST(WriteColumns, every_type)
{
  TwoParticles particles;
  const auto check = [&]<class Value>(ValueType type, Value low, Value high)
  {
    TwoParticles own;
    const std::vector<Value> values = { low, high };
    own.add("a", type, values);
    own.add("type", type, values);
    const std::string rows = std::to_string(low) + " " + std::to_string(low) + "\n" +
      std::to_string(high) + " " + std::to_string(high) + "\n";
    EXPECT_EQ(write(own.frame, { "a", "type" }).body, "a type\n" + rows);
    DumpFormat sorted;
    sorted.sort_by_id = true;
    own.add("id", ValueType::Int64, ids);
    EXPECT_EQ(write(own.frame, { "type" }, sorted).body,
      "type\n" + std::to_string(high) + "\n" + std::to_string(low) + "\n");
  };
  const auto of_limits = [&]<class Value>(ValueType type, Value)
  { check(type, std::numeric_limits<Value>::min(), std::numeric_limits<Value>::max()); };
  of_limits(ValueType::Int8, std::int8_t{});
  of_limits(ValueType::UInt8, std::uint8_t{});
  of_limits(ValueType::Int16, std::int16_t{});
  of_limits(ValueType::UInt16, std::uint16_t{});
  of_limits(ValueType::Int32, std::int32_t{});
  of_limits(ValueType::UInt32, std::uint32_t{});
  of_limits(ValueType::Int64, std::int64_t{});
  check(ValueType::UInt64, std::uint64_t{ 0 }, std::uint64_t{ (1ULL << 63) - 1 });

  const std::vector<std::uint64_t> huge = { 1, 1ULL << 63 };
  particles.add("a", ValueType::UInt64, huge);
  EXPECT_EQ(write(particles.frame, { "a" }).error,
    "column 'a': expected integers below 2^63, got 9223372036854775808");
}

/// Arrays of one value a row that lie in another array, as of VTK's arrays by component.
TEST(WriteColumns, steps)
{
  TwoParticles particles;
  const std::vector<std::int16_t> mixed = { 1, 2, 3, 4, 5, 6, 7, 8 };
  ArrayView view = view_rows("a", ValueType::Int16, mixed.data() + 1, 2);
  view.step = 4;
  std::swap(view.components[0], view.components[1]);
  particles.frame.arrays.push_back(view);
  EXPECT_EQ(write(particles.frame, { "a" }).body, "a[1] a[2]\n3 2\n7 6\n");
}

TEST(WriteColumns, big_ids)
{
  TwoParticles particles;
  const std::vector<std::int64_t> big = { (std::int64_t{ 1 } << 31) + 5,
    (std::int64_t{ 1 } << 53) + 1 };
  particles.add("id", ValueType::Int64, big);
  particles.add("mol", ValueType::Int64, big);
  EXPECT_EQ(write(particles.frame, { "id", "mol" }).body,
    "id mol\n2147483653 2147483653\n9007199254740993 9007199254740993\n");
  std::string error;
  write_binary(particles.frame, { "type", "mol" }, &error);
  EXPECT_EQ(error,
    "column 'mol': expected integers that a double can hold, as all up to 2^53, for a binary dump, "
    "got 9007199254740993");
  const std::vector<std::int64_t> exact = { -(std::int64_t{ 1 } << 53), std::int64_t{ 1 } << 60 };
  const std::vector<std::int64_t> last = { 1, std::numeric_limits<std::int64_t>::max() };
  particles.frame.arrays = {};
  particles.add("id", ValueType::Int64, exact);
  particles.add("mol", ValueType::Int64, last);
  EXPECT_EQ(write_binary(particles.frame, { "id" }), (std::vector<double>{ -0x1p53, 0x1p60 }));
  write_binary(particles.frame, { "mol" }, &error);
  EXPECT_NE(error.find("got 9223372036854775807"), error.npos);
}

/// Tools that know no integers hold ids as real numbers: they are whole numbers all the same.
TEST(WriteColumns, whole_numbers_in_real_arrays)
{
  TwoParticles particles;
  const std::vector<double> real_ids = { 12345678, -0.0 };
  const std::vector<float> real_types = { 16777216, 2 };
  const std::vector<double> odd = { 1.5, 1e300 };
  const std::vector<double> none = { std::numeric_limits<double>::quiet_NaN(),
    -std::numeric_limits<double>::infinity() };
  particles.add("id", ValueType::Float64, real_ids);
  particles.add("type", ValueType::Float32, real_types);
  particles.add("mol", ValueType::Float64, odd);
  particles.add("proc", ValueType::Float64, none);
  particles.add("mass", ValueType::Float64, real_ids);
  EXPECT_EQ(write(particles.frame, { "id", "type", "mol", "proc", "mass" }).body,
    "id type mol proc mass\n12345678 16777216 1.5 nan 1.23457e+07\n0 2 1e+300 -inf -0\n");
  DumpFormat sorted;
  sorted.sort_by_id = true;
  const Text text = write(particles.frame, { "id" }, sorted);
  EXPECT_EQ(text.body, "id\n12345678\n0\n");
  EXPECT_EQ(text.said, "no integer array 'id': the rows are not sorted\n");
}

TEST(WriteColumns, radius_and_diameter)
{
  TwoParticles particles;
  const std::vector<float> radius = { 0.25F, 0.1F };
  particles.add("radius", ValueType::Float32, radius);
  EXPECT_EQ(
    write(particles.frame, { "diameter", "radius" }).body, "diameter radius\n0.5 0.25\n0.2 0.1\n");
  EXPECT_EQ(write_binary(particles.frame, { "diameter" }),
    (std::vector<double>{ 0.5, 2 * static_cast<double>(0.1F) }));
  const std::vector<std::int32_t> diameter = { 3, 4 };
  particles.frame.arrays = {};
  particles.add("diameter", ValueType::Int32, diameter);
  EXPECT_EQ(write(particles.frame, { "radius" }).body, "radius\n1.5\n2\n");
  DumpFormat sorted;
  sorted.sort_by_id = true;
  particles.add("id", ValueType::Int64, ids);
  EXPECT_EQ(write(particles.frame, { "radius" }, sorted).body, "radius\n2\n1.5\n");

  // a file with diameters is read as radii, and gets its diameters back, and no radii
  const std::string text = one_frame("id diameter x y z", "1 0.3 0 0 0\n2 1e-05 1 1 1\n");
  const ReadFrameView read(Dump(text).read().frame);
  EXPECT_EQ(write(read.view, {}).body, "id diameter x y z\n1 0.3 0 0 0\n2 1e-05 1 1 1\n");
}

TEST(WriteColumns, images)
{
  TwoParticles particles;
  const std::vector<std::int32_t> image = { 1, -2, 0, 1048576, 0, -1048576 };
  particles.add("image", ValueType::Int32, image);
  EXPECT_EQ(write(particles.frame, { "ix", "iy", "iz", "xu" }).body,
    "ix iy iz xu\n1 -2 0 11\n1048576 0 -1048576 1.04858e+07\n");
  EXPECT_EQ(write(particles.frame, { "image" }).body, "ix iy iz\n1 -2 0\n1048576 0 -1048576\n");
  const std::vector<std::int64_t> one = { 5, 6 };
  particles.frame.arrays = {};
  particles.add("iy", ValueType::Int64, one);
  const Text text = write(particles.frame, { "ix", "iy", "iz" });
  EXPECT_EQ(text.body, "ix iy iz\n0 5 0\n0 6 0\n");
  EXPECT_EQ(text.said, "");
}

TEST(WriteColumns, elements)
{
  TwoParticles particles;
  const std::vector<std::string> elements = { "Fe", "C" };
  particles.add("element", ValueType::Text, elements);
  EXPECT_EQ(write(particles.frame, { "element" }).body, "element\nFe\nC\n");
  EXPECT_EQ(write_binary(particles.frame, { "element" }), (std::vector<double>{ 1, 1 }));
  particles.add("type", ValueType::Int32, types);
  EXPECT_EQ(write_binary(particles.frame, { "element" }), (std::vector<double>{ 2, 1 }));
  const std::vector<std::string> words = { "a", "b" };
  particles.add("state", ValueType::Text, words);
  std::string error;
  write_binary(particles.frame, { "state" }, &error);
  EXPECT_EQ(error, "column 'state': expected numbers for a binary dump, got texts");
  for (const auto& [bad, shown] : { std::pair("two words", "two words"), std::pair("", ""),
         std::pair(" x", " x"), std::pair("line\n", "line\\n"), std::pair("tab\t", "tab\\t") })
  {
    const std::vector<std::string> texts = { "good", bad };
    particles.frame.arrays = {};
    particles.add("state", ValueType::Text, texts);
    EXPECT_EQ(write(particles.frame, { "state" }).error,
      std::string("column 'state': expected a word, got '") + shown + "'");
  }
}

/// Lines of more numbers than are printed at a time, between words that are longer than any number.
TEST(WriteColumns, many_columns_and_long_words)
{
  constexpr std::size_t rows = 300;
  std::vector<std::string> words;
  for (std::size_t row = 0; row < rows; ++row)
  {
    words.emplace_back(1 + row % 90, static_cast<char>('a' + row % 26));
  }
  for (const std::size_t count : { 1U, 63U, 254U, 255U, 256U, 257U, 700U })
  {
    std::vector<double> reals;
    std::vector<std::int32_t> integers;
    for (std::size_t i = 0; i < rows * count; ++i)
    {
      reals.push_back((static_cast<double>(i % 977) - 400) * 0.37);
      integers.push_back(static_cast<std::int32_t>(i * 2654435761U));
    }
    FrameView frame;
    frame.header.box = Box::from_bounds({ 0, 0, 0 }, { 1, 1, 1 });
    frame.rows = rows;
    frame.arrays = { view_rows("word", ValueType::Text, words.data()),
      view_rows("a", ValueType::Float64, reals.data(), static_cast<int>(count)),
      view_rows("n", ValueType::Int32, integers.data()) };
    Names columns = { "word" };
    std::string expected;
    for (std::size_t i = 0; i < count; ++i)
    {
      columns.push_back(count == 1 ? "a" : "a[" + std::to_string(i + 1) + "]");
    }
    columns.insert(columns.end(), { "n", "word" });
    for (const std::string& name : columns)
    {
      expected += (expected.empty() ? "" : " ") + name;
    }
    expected += "\n";
    for (std::size_t row = 0; row < rows; ++row)
    {
      expected += words[row];
      for (std::size_t i = 0; i < count; ++i)
      {
        char word[32];
        std::snprintf(word, sizeof word, " %g", reals[row * count + i]);
        expected += word;
      }
      expected += " " + std::to_string(integers[row]) + " " + words[row] + "\n";
    }
    const Text text = write(frame, columns);
    EXPECT_EQ(text.error, "");
    EXPECT_EQ(difference(text.body, expected), "") << count << " columns";

    // LIGGGHTS has a blank at the end of each line
    DumpFormat liggghts;
    liggghts.dialect = Dialect::Liggghts;
    std::string blanks;
    for (const char c : expected)
    {
      blanks += c == '\n' ? " \n" : std::string(1, c);
    }
    EXPECT_EQ(difference(write(frame, columns, liggghts).body, blanks), "") << count << " columns";
  }
}

/// Rows that other ranks write, more of them than are looked at a time, before the first of our own.
TEST(WriteColumns, image_counts_behind_duplicates)
{
  constexpr std::size_t rows = 700;
  constexpr std::size_t duplicates = 600;
  std::vector<unsigned char> ghosts(rows, 0);
  std::fill_n(ghosts.begin(), duplicates, FrameView::duplicate_row);
  std::vector<double> points(3 * rows, 0.5);
  std::vector<std::int64_t> numbers;
  std::string expected = "id ix iy iz\n";
  for (std::size_t row = 0; row < rows; ++row)
  {
    numbers.push_back(static_cast<std::int64_t>(row));
    expected += row < duplicates ? "" : std::to_string(row) + " 0 0 0\n";
  }
  FrameView frame;
  frame.header.box = Box::from_bounds({ 0, 0, 0 }, { 1, 1, 1 });
  frame.rows = rows;
  frame.ghosts = ghosts.data();
  frame.points = view_rows("points", ValueType::Float64, points.data(), 3);
  frame.arrays = { view_rows("id", ValueType::Int64, numbers.data()) };
  EXPECT_EQ(write(frame, { "id", "ix", "iy", "iz" }).body, expected);
  EXPECT_EQ(write_binary(frame, { "id", "ix", "iy", "iz" }).size(), 4 * rows);
}

/// A column that is there twice, with other values each time, as LIGGGHTS writes it where it is asked for twice.
TEST(WriteColumns, duplicates)
{
  const std::string rows = "1 0.5 0.5 2 2.5 0.5\n2 0.25 0.25 3 3.5 0.25\n";
  const std::string text = one_frame("id c_a x c_b c_b x", rows);
  for (const Request& request : { Request(), everything() })
  {
    const ReadFrameView read(Dump(text).read(request).frame);
    EXPECT_EQ(write(read.view, {}).body, "id c_a x c_b c_b x\n" + rows);
  }
  const std::string thrice = "id c_b[1] x c_b[1] c_b[2] c_b[1]\n1 2 3 2 4 2\n2 12 3 12 14 12\n";
  const ReadFrameView read(
    Dump(one_frame("id c_b[1] x c_b[1] c_b[2] c_b[1]", "1 2 3 2 4 2\n2 12 3 12 14 12\n"))
      .read()
      .frame);
  EXPECT_EQ(write(read.view, {}).body, thrice);
}

/// The columns of the input stay as they are; what is new comes behind them; what is gone is said.
TEST(WriteColumns, default_columns)
{
  const std::string text = one_frame("vx id xs ys zs vy vz q", "1 1 0.5 0.5 0.5 2 3 9\n");
  ReadFrameView read(Dump(text).read().frame);
  EXPECT_EQ(write(read.view, {}).body, "vx id xs ys zs vy vz q\n1 1 0.5 0.5 0.5 2 3 9\n");
  const std::vector<double> speed = { 3.75 };
  const std::vector<double> force = { 7, 8, 9 };
  read.view.arrays.push_back(view_rows("speed", ValueType::Float64, speed.data()));
  read.view.arrays.push_back(view_rows("f", ValueType::Float64, force.data(), 3));
  EXPECT_EQ(write(read.view, {}).body,
    "vx id xs ys zs vy vz q speed fx fy fz\n1 1 0.5 0.5 0.5 2 3 9 3.75 7 8 9\n");
  std::erase_if(read.view.arrays, [](const ArrayView& array) { return array.name == "q"; });
  const Text less = write(read.view, {});
  EXPECT_EQ(less.body, "vx id xs ys zs vy vz speed fx fy fz\n1 1 0.5 0.5 0.5 2 3 3.75 7 8 9\n");
  EXPECT_EQ(less.said, "columns of the input without an array are left out: q\n");

  TwoParticles particles;
  particles.add("type", ValueType::Int32, types);
  particles.add("id", ValueType::Int64, ids);
  EXPECT_EQ(write(particles.frame, {}).body, "id type x y z\n7 2 1 2 3\n3 1 4 5 6\n");
}

/// Arrays that say the same in their name as another column are not mixed up with it.
TEST(WriteColumns, first_of_two_arrays)
{
  TwoParticles particles;
  const std::vector<double> one = { 1, 2 };
  const std::vector<double> three = { 3, 4, 5, 6, 7, 8 };
  particles.add("v", ValueType::Float64, one);
  particles.add("v", ValueType::Float64, three);
  EXPECT_EQ(write(particles.frame, { "v", "vy" }).body, "v vy\n1 4\n2 7\n");
}

/// An array with the very name of a column comes before the one that the column is a part of, whatever other columns
/// there are.
TEST(WriteColumns, arrays_named_like_parts)
{
  TwoParticles particles;
  const std::vector<double> vx = { 70, 80 };
  const std::vector<double> v = { 3, 4, 5, 6, 7, 8 };
  particles.add("v", ValueType::Float64, v);
  particles.add("vx", ValueType::Float64, vx);
  EXPECT_EQ(write(particles.frame, { "vx" }).body, "vx\n70\n80\n");
  EXPECT_EQ(write(particles.frame, { "vx", "vy", "vz" }).body, "vx vy vz\n70 4 5\n80 7 8\n");
}

TEST(WriteColumns, two_names_that_are_one_word)
{
  TwoParticles particles;
  const std::vector<double> one = { 1, 2 };
  const std::vector<double> two = { 3, 4 };
  particles.add("id", ValueType::Int64, ids);
  particles.add("type", ValueType::Int32, types);
  particles.add("my array", ValueType::Float64, one);
  particles.add("my_array", ValueType::Float64, two);
  const Text text = write(particles.frame, {});
  EXPECT_EQ(text.body, "id type x y z my_array\n7 2 1 2 3 3\n3 1 4 5 6 4\n");
  EXPECT_EQ(text.said, "arrays without a column of their own are left out: my array\n");
}

/// Nobody asked for the texts: they do not keep a binary dump from being written.
TEST(WriteColumns, texts_that_nobody_asked_for)
{
  TwoParticles particles;
  const std::vector<std::string> words = { "a", "b" };
  particles.add("id", ValueType::Int64, ids);
  particles.add("type", ValueType::Int32, types);
  particles.add("word", ValueType::Text, words);
  const Folder folder;
  DumpFormat format;
  format.binary = true;
  const Written written = write_dump(folder.path("a"), Frames{ particles.frame }, format);
  EXPECT_EQ(written.error, "");
  EXPECT_EQ(written.said, "arrays without a column of their own are left out: word\n");
  format.columns = { "id", "type", "x", "y", "z" };
  EXPECT_EQ(written.bytes, write_dump(folder.path("b"), Frames{ particles.frame }, format).bytes);
}

/// Points may be of any type, also where the box is made from them.
TEST(WriteColumns, points_of_integers)
{
  const std::vector<std::int64_t> points = { 1, 2, 3, 4, 5, 6 };
  TwoParticles particles;
  particles.frame.points = view_rows("points", ValueType::Int64, points.data(), 3);
  particles.frame.has_box = false;
  EXPECT_EQ(write(particles.frame, { "x", "ys" }).body, "x ys\n1 0\n4 1\n");
  EXPECT_EQ(write_binary(particles.frame, { "x", "zs" }), (std::vector<double>{ 1, 0, 4, 1 }));
}

TEST(WriteColumns, image_counts_that_are_none)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [count, text] :
    { std::pair(nan, "nan"), std::pair(2.5, "2.500000"), std::pair(-3e9, "-3000000000.000000") })
  {
    TwoParticles particles;
    const std::vector<double> counts = { 1, count };
    particles.add("ix", ValueType::Float64, counts);
    EXPECT_EQ(write(particles.frame, { "ix" }).error,
      std::string("column 'ix': expected image counts of whole numbers below 2^31, got ") + text);
  }
}
