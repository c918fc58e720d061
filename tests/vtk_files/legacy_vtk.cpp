// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/vtk_files/legacy_vtk.h"

#include "../support/error_of.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <memory>

using namespace granular;

namespace
{
/// Numbers as VTK writes them into binary files: the most significant byte first.
template <class U>
std::string big_endian(U value)
{
  std::string bytes;
  for (std::size_t i = sizeof(U); i-- > 0;)
  {
    bytes += static_cast<char>(std::uint64_t{ value } >> (8 * i) & 0xff);
  }
  return bytes;
}

struct Text
{
  explicit Text(std::string all, std::int64_t end = LegacyVtk::no_end)
    : bytes(std::move(all))
    , source(open_memory(bytes))
    , file(*source, {}, end, progress)
  {
  }

  std::string bytes;
  std::unique_ptr<ByteSource> source;
  Progress progress;
  LegacyVtk file;
};

std::string header(const std::string& form, const std::string& dataset)
{
  return "# vtk DataFile Version 4.2\na title\n" + form + "\nDATASET " + dataset + "\n";
}

/// The values of an array "a" of one component in a binary file.
template <class T>
std::vector<T> binary(const std::string& type, const std::string& bytes, int count)
{
  Text text(header("BINARY", "POLYDATA") + "VALUES " + std::to_string(count) + " " + type + "\n" +
    bytes + "\n");
  text.file.read_header();
  EXPECT_TRUE(text.file.next());
  const VtkArray array = text.file.values(1);
  std::vector<T> numbers;
  text.file.read(array, numbers);
  EXPECT_FALSE(text.file.next());
  // passing over them goes as far
  Text other(text.bytes);
  other.file.read_header();
  EXPECT_TRUE(other.file.next());
  other.file.skip(array);
  EXPECT_FALSE(other.file.next());
  EXPECT_EQ(other.file.place().offset, text.file.place().offset);
  return numbers;
}
}

TEST(LegacyVtk, Header)
{
  Text text("# vtk DataFile Version 3.0\r\n\n  binary \ndataset structured_grid\n");
  const VtkHeader read = text.file.read_header();
  EXPECT_EQ(read.version, "3.0");
  EXPECT_EQ(read.title, "");
  EXPECT_TRUE(read.binary);
  EXPECT_EQ(read.dataset, "STRUCTURED_GRID");
  EXPECT_EQ(read.place.offset, 0);
  EXPECT_EQ(read.place.line, 1);
}

// The file of dump euler/vtk of LIGGGHTS, shortened.
TEST(LegacyVtk, PointsWithData)
{
  Text text("# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\nDATASET POLYDATA\n"
            "POINTS 2 float\n0.1 0.2 0.3\n-0.1 0.2 0.3\nVERTICES 2 4\n1 0\n1 1\nPOINT_DATA 2\n"
            "VECTORS v_avg float\n1.5 nan -inf\n0 0 -0\n"
            "SCALARS radius float 1\nLOOKUP_TABLE default\n0.25\n0.5\n");
  LegacyVtk& file = text.file;
  EXPECT_EQ(file.read_header().dataset, "POLYDATA");
  ASSERT_TRUE(file.next() && file.is("points"));
  std::vector<double> numbers;
  file.read(file.values(3), numbers);
  EXPECT_EQ(numbers, (std::vector<double>{ 0.1, 0.2, 0.3, -0.1, 0.2, 0.3 }));
  ASSERT_TRUE(file.next() && file.is("VERTICES"));
  const VtkCells cells = file.cells(true);
  EXPECT_EQ(cells.size, 2);
  EXPECT_EQ(cells.offsets, (std::vector<std::int64_t>{ 0, 1, 2 }));
  EXPECT_EQ(cells.connectivity, (std::vector<std::int64_t>{ 0, 1 }));
  EXPECT_EQ(file.where_of(cells, 1).line, 10);
  file.go_to(cells.place);
  file.skip(cells.values);
  ASSERT_TRUE(file.next() && file.is("POINT_DATA"));
  EXPECT_EQ(file.count(1), 2);
  std::string seen;
  std::vector<double> v;
  while (file.next())
  {
    EXPECT_TRUE(file.take_arrays(2,
      [&](const VtkArray& array)
      {
        seen += array.name + " " + std::to_string(array.components) + " ";
        const bool vectors = array.name == "v_avg";
        file.take(array, vectors, v);
        return true;
      }));
  }
  EXPECT_EQ(seen, "v_avg 3 radius 1 ");
  ASSERT_EQ(v.size(), 6u);
  EXPECT_TRUE(std::isnan(v[1]));
  EXPECT_EQ(v[2], -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::signbit(v[5]));
}

TEST(LegacyVtk, BinaryNumbersOfAllTypes)
{
  using Integers = std::vector<std::int64_t>;
  using Doubles = std::vector<double>;
  EXPECT_EQ(binary<std::int64_t>("bit", "\xa5\x80", 9), (Integers{ 1, 0, 1, 0, 0, 1, 0, 1, 1 }));
  EXPECT_EQ(binary<std::int64_t>("char", "\x80\x7f", 2), (Integers{ -128, 127 }));
  EXPECT_EQ(binary<std::int64_t>("signed_char", "\xff", 1), (Integers{ -1 }));
  EXPECT_EQ(binary<std::int64_t>("unsigned_char", "\xff", 1), (Integers{ 255 }));
  EXPECT_EQ(binary<std::int64_t>("short", "\xff\xfe", 1), (Integers{ -2 }));
  EXPECT_EQ(binary<std::int64_t>("unsigned_short", "\xff\xfe", 1), (Integers{ 65534 }));
  for (const char* type : { "int", "vtkIdType", "vtktypeint32" })
  {
    EXPECT_EQ(binary<std::int64_t>(type, big_endian(0xfffffffdu), 1), (Integers{ -3 }));
  }
  EXPECT_EQ(
    binary<std::int64_t>("unsigned_int", big_endian(0xfffffffdu), 1), (Integers{ 4294967293 }));
  const std::string wide = big_endian(~std::uint64_t{ 4 });
  for (const char* type : { "long", "vtktypeint64" })
  {
    EXPECT_EQ(binary<std::int64_t>(type, wide, 1), (Integers{ -5 }));
  }
  for (const char* type : { "unsigned_long", "vtktypeuint64" })
  {
    EXPECT_EQ(binary<double>(type, wide, 1), (Doubles{ 18446744073709551615.0 }));
  }
  const std::string floats = big_endian(std::bit_cast<std::uint32_t>(0.1f));
  EXPECT_EQ(binary<double>("float", floats, 1), (Doubles{ double{ 0.1f } }));
  const std::string doubles = big_endian(std::bit_cast<std::uint64_t>(-0.1)) +
    big_endian(std::bit_cast<std::uint64_t>(1e300));
  EXPECT_EQ(binary<double>("DOUBLE", doubles, 2), (Doubles{ -0.1, 1e300 }));
  EXPECT_EQ(binary<std::int64_t>("float", big_endian(std::bit_cast<std::uint32_t>(-8.f)), 1),
    (Integers{ -8 }));
}

TEST(LegacyVtk, NumbersThatAreNotWhole)
{
  const std::string at = "memory@" +
    std::to_string(header("BINARY", "POLYDATA").size() + std::string("VALUES 1 double\n").size());
  const std::string end = ": expected a whole number of 64 bits (1 of 1), got another";
  for (const double value : { 0.5, 9223372036854775808.0, -1e300,
         std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    EXPECT_EQ(
      error_of([&]
        { binary<std::int64_t>("double", big_endian(std::bit_cast<std::uint64_t>(value)), 1); }),
      at + end);
  }
  EXPECT_EQ(binary<std::int64_t>(
              "double", big_endian(std::bit_cast<std::uint64_t>(-9223372036854775808.0)), 1),
    (std::vector<std::int64_t>{ std::numeric_limits<std::int64_t>::min() }));
  EXPECT_NE(
    error_of([] { binary<std::int64_t>("unsigned_long", big_endian(~std::uint64_t{ 0 }), 1); }),
    "");
}

// Numbers of all lengths around the edges of what is read at a time.
TEST(LegacyVtk, ManyNumbersInAnyLines)
{
  std::string numbers;
  std::vector<double> expected;
  std::vector<std::int64_t> lines;
  std::int64_t line = 5;
  for (int i = 0; i < 120'000; ++i)
  {
    lines.push_back(line);
    const int digits = i % 17;
    const std::string word = (i % 3 == 0 ? "-" : "") + std::to_string(i) +
      (digits > 0 ? "." + std::string(static_cast<std::size_t>(digits), '0') : "");
    numbers += word + (i % 7 == 0 ? "\n" : i % 11 == 0 ? " \r\n\t" : " ");
    line += i % 7 == 0 || i % 11 == 0 ? 1 : 0;
    expected.push_back(i % 3 == 0 ? -i : i);
  }
  ASSERT_GT(numbers.size(), std::size_t{ 4 } << 18);
  const std::string before = header("ASCII", "POLYDATA");
  const std::string all = before + numbers + "\nNEXT 1\n";
  const VtkArray array = { "", ValueType::Float32, 1, 120'000 };
  Text text(all);
  text.file.read_header();
  std::vector<double> read;
  text.file.read(array, read);
  EXPECT_TRUE(read == expected);
  const std::int64_t end = text.file.place().offset;
  ASSERT_TRUE(text.file.next() && text.file.is("NEXT"));
  Text other(all);
  other.file.read_header();
  other.file.skip(array);
  EXPECT_EQ(other.file.place().offset, end);
  EXPECT_TRUE(other.file.next() && other.file.is("NEXT"));
  EXPECT_EQ(other.file.line_place().line, text.file.line_place().line);
  const VtkPlace first = { static_cast<std::int64_t>(before.size()), 5 };
  for (const std::int64_t i : { 0, 1, 7, 999, 50'000, 77'777, 119'999 })
  {
    EXPECT_EQ(other.file.where_of(first, array, i).line, lines[static_cast<std::size_t>(i)]) << i;
  }
  std::vector<std::int64_t> whole;
  text.file.go_to(first);
  text.file.read(array, whole);
  EXPECT_TRUE(std::equal(whole.begin(), whole.end(), expected.begin()));
}

TEST(LegacyVtk, WordsThatAreNoNumbers)
{
  for (const std::size_t far : { 0u, 10u, 4095u, 4096u, 100'000u, 300'000u })
  {
    std::string numbers;
    for (std::size_t i = 0; i < far; ++i)
    {
      numbers += "1 ";
    }
    for (const bool keep : { true, false })
    {
      Text text(header("ASCII", "POLYDATA") + numbers + "\nPOINTS 2\n");
      text.file.read_header();
      std::vector<double> read;
      const auto count = static_cast<std::int64_t>(far) + 1;
      EXPECT_EQ(error_of(
                  [&] {
                    text.file.take({ "", ValueType::Int32, 1, count }, keep, read);
                  }),
        "memory:6: expected a number (" + std::to_string(far + 1) + " of " + std::to_string(count) +
          "), got 'POINTS'");
      EXPECT_FALSE(text.file.ended());
    }
  }
}

TEST(LegacyVtk, ClaimsAreHeldAgainstTheBytes)
{
  for (const char* form : { "ASCII", "BINARY" })
  {
    for (const std::int64_t claim :
      { std::int64_t{ 21 }, std::int64_t{ 1 } << 40, std::numeric_limits<std::int64_t>::max() })
    {
      for (const bool keep : { true, false })
      {
        // 40 bytes: 20 numbers of one digit
        Text text(header(form, "POLYDATA") + "1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0\n");
        text.file.read_header();
        std::vector<double> read;
        const VtkArray array = { "", ValueType::Int16, 1, claim };
        EXPECT_NE(error_of([&] { text.file.take(array, keep, read); }), "");
        EXPECT_TRUE(text.file.ended());
        EXPECT_LE(read.capacity(), 64u);
      }
    }
    Text text(header(form, "POLYDATA") + "1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0\n");
    text.file.read_header();
    std::vector<double> read;
    text.file.read({ "", ValueType::Int16, 2, 10 }, read);
    EXPECT_EQ(read.size(), 20u);
  }
  EXPECT_EQ((VtkArray{ "", ValueType::Bit, 3, std::int64_t{ 1 } << 62 }).size(),
    std::numeric_limits<std::int64_t>::max());
}

TEST(LegacyVtk, MetadataIsPassedOver)
{
  Text text(header("ASCII", "POLYDATA") +
    "POINTS 1 float\n1 2 3\nMETADATA\nCOMPONENT_NAMES\nPOINTS\n\nVERTICES\n"
    "INFORMATION 1\nNAME A LOCATION B\nDATA 1 2\n\nCELLS 0 0\n"
    "FIELD f 2\nMETADATA 1 1 int\n7\nMETADATA\nINFORMATION 0\n\nNULL_ARRAY\nEND\n");
  text.file.read_header();
  ASSERT_TRUE(text.file.next());
  text.file.skip(text.file.values(3));
  ASSERT_TRUE(text.file.next());
  EXPECT_TRUE(text.file.is("CELLS"));
  EXPECT_EQ(text.file.line_place().line, 16);
  ASSERT_TRUE(text.file.next());
  std::string names;
  text.file.take_arrays(1,
    [&](const VtkArray& array)
    {
      names += array.name;
      return false;
    });
  EXPECT_EQ(names, "METADATA");
  EXPECT_TRUE(text.file.next() && text.file.is("END"));
}

TEST(LegacyVtk, Strings)
{
  const std::string long_one(100, 'x');
  const std::string longest(20'000, 'y');
  Text binary(header("BINARY", "POLYDATA") + "FIELD f 1\nwords 1 5 string\n" + '\xc3' + "a\nb" +
    '\xc0' + big_endian(std::uint16_t{ 0x8064 }) + long_one + big_endian(0x40004e20u) + longest +
    big_endian(std::uint64_t{ 2 }) + "zz\nEND\n");
  binary.file.read_header();
  ASSERT_TRUE(binary.file.next());
  EXPECT_TRUE(binary.file.take_arrays(0, nullptr));
  EXPECT_TRUE(binary.file.next() && binary.file.is("END"));
  Text text(header("ASCII", "POLYDATA") + "FIELD f 1\nwords 2 2 string\na%20b\n\nEND\nd\nEND\n");
  text.file.read_header();
  ASSERT_TRUE(text.file.next());
  EXPECT_TRUE(text.file.take_arrays(0, nullptr));
  EXPECT_TRUE(text.file.next() && text.file.is("END"));
  EXPECT_EQ(text.file.line_place().line, 11);
  std::vector<double> numbers;
  EXPECT_EQ(error_of(
              [&] {
                text.file.read({ "", ValueType::Text, 1, 1 }, numbers);
              }),
    "memory:11: expected numbers, got 'END'");
}

// What claims more lines than it has does not take those of the next dataset.
TEST(LegacyVtk, LinesEndAtAHeader)
{
  const std::string next = header("ASCII", "POLYDATA");
  Text words(next + "FIELD f 1\nwords 1 9 string\na\nb\n" + next);
  words.file.read_header();
  ASSERT_TRUE(words.file.next());
  EXPECT_EQ(error_of([&] { words.file.take_arrays(0, nullptr); }),
    "memory:9: expected a line of text (3 of 9), got '# vtk DataFile Version 4.2'");
  EXPECT_FALSE(words.file.ended());
  Text names(next + "METADATA\nINFORMATION 0\n" + next);
  EXPECT_EQ(error_of(
              [&]
              {
                names.file.read_header();
                names.file.next();
              }),
    "memory:7: expected an empty line behind METADATA, got '# vtk DataFile Version 4.2'");
  EXPECT_FALSE(names.file.ended());
}

TEST(LegacyVtk, HeadersAreFoundAnywhere)
{
  const std::string far(std::size_t{ 1 } << 19, '\n');
  Text text("x" + far + "0.5# vtk DataFil\n# vtk DataFile Version 2.0\n");
  EXPECT_TRUE(text.file.find_header({}));
  EXPECT_EQ(text.file.place().offset, static_cast<std::int64_t>(far.size() + 18));
  EXPECT_EQ(text.file.place().line, static_cast<std::int64_t>(far.size() + 2));
  VtkPlace behind = text.file.place();
  ++behind.offset;
  EXPECT_FALSE(text.file.find_header(behind));
  // and at every place of a window
  for (const std::size_t before : { 262'130u, 262'131u, 262'137u, 262'143u, 262'144u, 262'145u })
  {
    Text other(std::string(before, '#') + "# vtk DataFile Version 2.0\n");
    EXPECT_TRUE(other.file.find_header({}));
    EXPECT_EQ(other.file.place().offset, static_cast<std::int64_t>(before));
  }
}

TEST(LegacyVtk, BytesBehindTheEndAreNotThere)
{
  const std::string all = header("ASCII", "POLYDATA") + "POINTS 1 float\n1 2 3\n";
  Text text(all + "MORE\n", static_cast<std::int64_t>(all.size()));
  text.file.read_header();
  ASSERT_TRUE(text.file.next());
  text.file.skip(text.file.values(3));
  EXPECT_FALSE(text.file.next());
  EXPECT_FALSE(text.file.ended());
  Text cut(all + "MORE\n", static_cast<std::int64_t>(all.size()) - 1);
  cut.file.read_header();
  ASSERT_TRUE(cut.file.next());
  EXPECT_NE(error_of([&] { cut.file.skip(cut.file.values(3)); }), "");
  EXPECT_TRUE(cut.file.ended());
}
