// SPDX-License-Identifier: BSD-3-Clause
// As many columns as a frame may have, and more.
#include "../support/binary_dumps.h"
#include "../support/dump_writing.h"
#include "../support/dumps.h"

#include "../support/counting_source.h"
#include "../support/many_columns.h"

#include "granular/formats/dump/grammar/dump_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
constexpr int many = many_columns - 4; // beside id x y z

/// id x y z, and then many.
std::string names(const char* form, int more = 0)
{
  return line_of_many("id x y z", form, many_columns + more);
}

/// A binary file that names its columns.
const binary::Form& named_form()
{
  return *std::ranges::find_if(binary::forms(), &binary::Form::named);
}

/// Two rows, of numbers or of words.
std::string rows(const char* first, const char* second)
{
  return line_of_many("1 0.5 0.5 0.5", first) + "\n" + line_of_many("2 0.25 0.25 0.25", second) +
    "\n";
}
}

TEST(ManyColumns, MoreThanThereMayBe)
{
  EXPECT_EQ(Dump(one_frame(names("a#"), rows("#", "-#"))).read().frame.arrays.size(), many + 1u);
  EXPECT_EQ(Dump(one_frame(names("a#", 1), rows("#", "-#"))).said(),
    "memory:9: expected at most 5000 columns, got 5001; the frame is left out\n");
}

TEST(ManyColumns, OfOneName)
{
  const Dump dump(one_frame(names("a"), rows("#", "-#")));
  const Decoded frame = dump.read();
  ASSERT_EQ(frame.frame.arrays.size(), many + 1u);
  EXPECT_EQ(frame.values("a"), std::vector<double>({ 1, -1 }));
  EXPECT_EQ(frame.values("a_4996"), std::vector<double>({ 4996, -4996 }));
}

TEST(ManyColumns, OfFarComponents)
{
  const Dump dump(one_frame(names("c_#[4999]"), rows("#", "-#")));
  EXPECT_EQ(dump.read().values("c_7[4999]"), std::vector<double>({ 7, -7 }));
}

TEST(ManyColumns, OfOneVector)
{
  const Dump dump(one_frame(names("c_a[#]"), rows("#", "-#")));
  const std::vector<double> values = dump.read().values("c_a");
  ASSERT_EQ(values.size(), 2u * many);
  EXPECT_EQ(values[4995], 4996);
  EXPECT_EQ(values[9991], -4996);
}

TEST(ManyColumns, OfTexts)
{
  const Dump dump(one_frame(names("word#"), rows("a#", "b#")));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.texts("word1"), std::vector<std::string>({ "a1", "b1" }));
  EXPECT_EQ(frame.texts("word4996"), std::vector<std::string>({ "a4996", "b4996" }));
}

// The frame is read again once for the row, not for each of its words.
TEST(ManyColumns, OfTextsFromTheSecondRowOn)
{
  const Dump dump(one_frame(names("word#"), rows("#", "b#")));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.texts("word1"), std::vector<std::string>({ "1", "b1" }));
  EXPECT_EQ(frame.texts("word4996"), std::vector<std::string>({ "4996", "b4996" }));
  ASSERT_EQ(frame.notices.size(), static_cast<std::size_t>(many));
  EXPECT_EQ(granular::to_string(frame.notices[0]),
    "memory:11: column 'word1': expected a number, got 'b1'; the column is kept as texts");
  EXPECT_EQ(granular::to_string(frame.notices[4995]),
    "memory:11: column 'word4996': expected a number, got 'b4996'; the column is kept as "
    "texts");
}

TEST(ManyColumns, OfIntegersThatAreNone)
{
  const Dump dump(one_frame(names("i_#"), rows("#", "0.#")));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.values("i_25"), std::vector<double>({ 25, 0.25 }));
  EXPECT_EQ(frame.values("i_4996"), std::vector<double>({ 4996, 0.4996 }));
  EXPECT_EQ(frame.notices.size(), static_cast<std::size_t>(many));
}

TEST(ManyColumns, OfABinaryFile)
{
  constexpr std::int32_t most = many_columns;
  binary::Frame frame;
  frame.size_one = most;
  std::vector<double> row;
  for (int i = 0; i < most; ++i)
  {
    frame.columns += (i == 0 ? "id" : i < 4 ? std::string(" ") + "xyz"[i - 1] : " i_a");
    row.push_back(i < 4 ? 1 : i + 0.5);
  }
  frame.chunks = { row };
  const Dump dump(binary::write(named_form(), { frame }).bytes);
  const Decoded read = dump.read();
  EXPECT_EQ(read.values("i_a"), std::vector<double>({ 4.5 }));
  EXPECT_EQ(read.values("i_a_4996"), std::vector<double>({ 4999.5 }));
  EXPECT_EQ(read.notices.size(), 4996u);
}

/// As many bytes as are read of a frame to decode it, times the bytes that it has.
double times_read(const std::string& bytes, const std::string& notice)
{
  const CountingSource source(bytes);
  granular::FileIndex index;
  granular::Progress progress;
  granular::index_dump(source, index, progress);
  const std::int64_t before = source.bytes_read();
  granular::Notices notices;
  granular::read_dump(source, index.frames.at(0), {}, notices, progress);
  EXPECT_EQ(granular::to_string(notices.back()), notice);
  return static_cast<double>(source.bytes_read() - before) / static_cast<double>(bytes.size());
}

// Each row makes one more column what it was not taken for: these are met by the chunk, not one by one.
TEST(ManyColumns, OfWhichARowEachDoesNotFit)
{
  std::string columns = "id x y z";
  std::string text;
  binary::Frame frame;
  frame.columns = columns;
  frame.size_one = 304;
  frame.chunks = { {} };
  for (int row = 0; row < 300; ++row)
  {
    columns += " word" + std::to_string(row);
    frame.columns += " i_" + std::to_string(row);
    text += "1 0 0 0";
    frame.chunks[0].insert(frame.chunks[0].end(), { 1, 0, 0, 0 });
    for (int column = 0; column < 300; ++column)
    {
      text += column == row ? " a" : " 0";
      frame.chunks[0].push_back(column == row ? 0.5 : 0);
    }
    text += "\n";
  }
  const std::string packed = binary::write(named_form(), { frame }).bytes;
  EXPECT_LT(
    times_read(one_frame(columns, text),
      "memory:309: column 'word299': expected a number, got 'a'; the column is kept as texts"),
    4);
  EXPECT_LT(times_read(packed,
              "memory@" + std::to_string(packed.size() - 8) +
                ": column 'i_299': expected an integer, got '0.5'; the column is kept as doubles"),
    5);
}

// Nor are columns looked for in lines that have none.
TEST(ManyColumns, AndRowsOfFewWords)
{
  const std::string rows = line_of_many("1 1 0 0 0", "#") + "\n0.5\n";
  const std::string blank(1'000'000, '\n');
  const std::string text = one_frame(line_of_many("type id x y z", "a#"), rows) + blank;
  EXPECT_EQ(Dump(text).error(), "memory:11: expected 5000 words in a row, got 1");
}

// Texts and numbers, of particles and of other rows, by default and by name: any two of these together.
TEST(ManyColumns, AreWritten)
{
  const Folder folder;
  bool by_name = false;
  for (const char* const form : { "word#", "a#", "c_a[#]", "c_#[2]" })
  {
    by_name = !by_name; // for the first of the styles
    const std::string text = rows("#", *form == 'w' ? "b#" : "-#");
    const ReadFrameView read(Dump(one_frame(names(form), text)).read(everything()).frame);
    for (const granular::DumpStyle style :
      { granular::DumpStyle::Custom, granular::DumpStyle::Local })
    {
      granular::DumpFormat format;
      format.style = style;
      const std::string expected =
        style == granular::DumpStyle::Custom ? text : replaced(text, "\n", " \n");
      const bool named = by_name == (style == granular::DumpStyle::Custom);
      format.columns = named ? read.view.columns : std::vector<std::string>{};
      const Written written = write_dump(folder.path("a"), Frames{ read.view }, format);
      EXPECT_EQ(written.error, "") << form;
      const std::size_t other = written.bytes.size() - expected.size();
      EXPECT_EQ(difference(written.bytes.substr(other), expected), "") << form;
    }
  }
}
