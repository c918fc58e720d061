// SPDX-License-Identifier: BSD-3-Clause
// Headers of a hundred thousand columns: what takes time in proportion to the square of their number would not end here
// before the test is stopped.
#include "binary_dumps.h"
#include "series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
constexpr int many = 100'000;

/// id x y z, and then many, by their number from 1.
template <class Word>
std::string line(const std::string& first, const Word& word)
{
  std::string text = first;
  for (int i = 1; i <= many; ++i)
  {
    text += " ";
    text += word(i);
  }
  return text;
}

std::string names(const std::string& form)
{
  return line("id x y z", [&](int i) { return replaced(form, "#", std::to_string(i)); });
}

/// Two rows, of numbers or of words.
std::string rows(const std::string& first, const std::string& second)
{
  return line("1 0.5 0.5 0.5", [&](int i) { return first + std::to_string(i); }) + "\n" +
    line("2 0.25 0.25 0.25", [&](int i) { return second + std::to_string(i); }) + "\n";
}
}

TEST(ManyColumns, OfOneName)
{
  const Dump dump(one_frame(names("a"), rows("", "-")));
  const Decoded frame = dump.read();
  ASSERT_EQ(frame.frame.arrays.size(), many + 1u);
  EXPECT_EQ(frame.values("a"), std::vector<double>({ 1, -1 }));
  EXPECT_EQ(frame.values("a_100000"), std::vector<double>({ 100'000, -100'000 }));
}

TEST(ManyColumns, OfFarComponents)
{
  const Dump dump(one_frame(names("c_#[99999]"), rows("", "-")));
  EXPECT_EQ(dump.read().values("c_7[99999]"), std::vector<double>({ 7, -7 }));
}

TEST(ManyColumns, OfOneVector)
{
  const Dump dump(one_frame(names("c_a[#]"), rows("", "-")));
  const std::vector<double> values = dump.read().values("c_a");
  ASSERT_EQ(values.size(), 2u * many);
  EXPECT_EQ(values[99'999], 100'000);
  EXPECT_EQ(values[199'999], -100'000);
}

TEST(ManyColumns, OfTexts)
{
  const Dump dump(one_frame(names("word#"), rows("a", "b")));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.texts("word1"), std::vector<std::string>({ "a1", "b1" }));
  EXPECT_EQ(frame.texts("word100000"), std::vector<std::string>({ "a100000", "b100000" }));
}

// The frame is read again once for the row, not for each of its words.
TEST(ManyColumns, OfTextsFromTheSecondRowOn)
{
  const Dump dump(one_frame(names("word#"), rows("", "b")));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.texts("word1"), std::vector<std::string>({ "1", "b1" }));
  EXPECT_EQ(frame.texts("word100000"), std::vector<std::string>({ "100000", "b100000" }));
  ASSERT_EQ(frame.notices.size(), static_cast<std::size_t>(many));
  EXPECT_EQ(granular::to_string(frame.notices[0]),
    "memory:11: column 'word1': expected a number, got 'b1'; the column is kept as texts");
  EXPECT_EQ(granular::to_string(frame.notices[99'999]),
    "memory:11: column 'word100000': expected a number, got 'b100000'; the column is kept as "
    "texts");
}

TEST(ManyColumns, OfIntegersThatAreNone)
{
  const Dump dump(one_frame(names("i_#"), rows("", "0.")));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.values("i_25"), std::vector<double>({ 25, 0.25 }));
  EXPECT_EQ(frame.values("i_100000"), std::vector<double>({ 100'000, 0.1 }));
  EXPECT_EQ(frame.notices.size(), static_cast<std::size_t>(many));
}

// As many as a binary file may have.
TEST(ManyColumns, OfABinaryFile)
{
  constexpr std::int32_t most = 10'000;
  binary::Frame frame;
  frame.size_one = most;
  std::vector<double> row;
  for (int i = 0; i < most; ++i)
  {
    frame.columns += (i == 0 ? "id" : i < 4 ? std::string(" ") + "xyz"[i - 1] : " i_a");
    row.push_back(i < 4 ? 1 : i + 0.5);
  }
  frame.chunks = { row };
  const binary::Form& form =
    *std::ranges::find_if(binary::forms(), [](const binary::Form& one) { return one.named(); });
  const Dump dump(binary::write(form, { frame }).bytes);
  const Decoded read = dump.read();
  EXPECT_EQ(read.values("i_a"), std::vector<double>({ 4.5 }));
  EXPECT_EQ(read.values("i_a_9996"), std::vector<double>({ 9999.5 }));
  EXPECT_EQ(read.notices.size(), 9996u);
}

// Kept on disk, and opened again.
TEST(ManyColumns, OfAKeptIndex)
{
  const Folder folder;
  const std::string path = folder.write("a.dump", one_frame(names("word"), rows("a", "b")));
  for (int time = 0; time < 2; ++time)
  {
    Series run;
    run.options.index_file = granular::IndexFile::Beside;
    run.update({ path });
    ASSERT_EQ(run.index.size(), 1u);
    EXPECT_EQ(run.read(0).texts("word_3"), std::vector<std::string>({ "a3", "b3" }));
  }
}
