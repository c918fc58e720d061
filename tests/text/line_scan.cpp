// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/line_scan.h"

#include "granular/bytes/byte_source.h"
#include "granular/common/simd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <string_view>

namespace
{
using granular::LineState;

struct Found
{
  std::ptrdiff_t stopped_at;
  std::int64_t feeds;
  std::int64_t blank_lines;
  std::ptrdiff_t after_last_feed; ///< -1: none
  bool start;
  bool blank;

  bool operator==(const Found&) const = default;
};

std::ostream& operator<<(std::ostream& to, const Found& found)
{
  return to << "stopped at " << found.stopped_at << ", feeds " << found.feeds << ", blank lines "
            << found.blank_lines << ", last behind " << found.after_last_feed << ", start "
            << found.start << ", blank " << found.blank;
}

/// What scan_lines has to find, byte by byte.
Found naive(std::string_view text, LineState state, char mark)
{
  Found found{ static_cast<std::ptrdiff_t>(text.size()), 0, 0, -1, state.start, state.blank };
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (found.start && text[i] == mark)
    {
      found.stopped_at = static_cast<std::ptrdiff_t>(i);
      break;
    }
    found.start = text[i] == '\n';
    if (found.start)
    {
      ++found.feeds;
      found.blank_lines += found.blank ? 1 : 0;
      found.after_last_feed = static_cast<std::ptrdiff_t>(i) + 1;
    }
    found.blank = found.start || (found.blank && static_cast<unsigned char>(text[i]) <= ' ');
  }
  return found;
}

Found scan(
  std::string_view text, LineState state, granular::Simd simd, std::size_t offset, char mark = 'I')
{
  granular::PaddedBuffer buffer(offset + text.size());
  text.copy(buffer.data() + offset, text.size());
  std::memset(buffer.data() + buffer.size(), '\n', 3); // must not be counted
  std::memset(buffer.data() + buffer.size() + 3, mark, granular::PaddedBuffer::padding - 3);
  const char* const first = buffer.data() + offset;
  const granular::LineScan scan =
    granular::scan_lines(first, first + text.size(), mark, state, simd);
  return { scan.ptr - first, scan.feeds, scan.blank_lines,
    scan.after_last_feed ? scan.after_last_feed - first : -1, scan.state.start, scan.state.blank };
}

void expect_all(std::string_view text, LineState state, std::size_t offset = 0, char mark = 'I')
{
  const Found expected = naive(text, state, mark);
  for (const granular::Simd simd : granular::instruction_sets())
  {
    EXPECT_EQ(scan(text, state, simd, offset, mark), expected)
      << to_string(simd) << " of " << text.size() << " bytes:\n"
      << text;
  }
}

constexpr LineState new_line = {};
constexpr LineState in_a_word = { false, false };
constexpr LineState behind_blanks = { false, true };
}

TEST(ScanLines, HandCounted)
{
  for (const LineState state : { new_line, in_a_word, behind_blanks })
  {
    expect_all("", state);
    expect_all("I", state);
    expect_all("1 2\n3 4\nITEM: TIMESTEP\n", state);
    expect_all("1 I\nx\nII\n", state);
    expect_all("\n\n\n", state);
    expect_all(" \t\r\n\x7f\n\r\nI", state);
  }
  EXPECT_EQ(scan("1 2\n3 4\nITEM:", new_line, granular::Simd::Portable, 0),
    (Found{ 8, 2, 0, 8, true, true }));
  EXPECT_EQ(
    scan("1\n \r\n\n ", new_line, granular::best_simd(), 0), (Found{ 7, 3, 2, 6, false, true }));
  EXPECT_EQ(scan("xx", new_line, granular::best_simd(), 0), (Found{ 2, 0, 0, -1, false, false }));
  EXPECT_EQ(scan("I\n", in_a_word, granular::best_simd(), 0), (Found{ 2, 1, 0, 2, true, true }));
}

TEST(ScanLines, MarkAndFeedAtEveryPlaceOfThreeBlocks)
{
  for (std::size_t size = 1; size <= 200; ++size)
  {
    for (std::size_t feed = 0; feed < size; ++feed)
    {
      for (const char fill : { '1', ' ' })
      {
        std::string text(size, fill);
        text[feed] = '\n';
        expect_all(text, new_line);
        expect_all(text, behind_blanks);
        if (feed + 1 < size)
        {
          text[feed + 1] = 'I';
          expect_all(text, in_a_word, feed % 5);
        }
      }
    }
  }
}

TEST(ScanLines, RandomTextsAreTheSameOnAllPaths)
{
  std::mt19937_64 random(3);
  for (int i = 0; i < 20'000 && !HasFailure(); ++i)
  {
    const std::uint64_t feeds = 1 + random() % 100;
    const std::uint64_t marks = 1 + random() % 300;
    const std::uint64_t words = 1 + random() % 100;
    std::string text(random() % 700, ' ');
    for (char& c : text)
    {
      c = random() % feeds == 0 ? '\n' : random() % marks == 0 ? 'I' : c;
      c = c == ' ' && random() % words == 0 ? static_cast<char>(random() % 256) : c;
    }
    const LineState states[] = { new_line, in_a_word, behind_blanks };
    expect_all(text, states[random() % 3], random() % 64);
  }
}

/// Most lines begin with a digit, or a sign; other bytes come at the borders of what numbers begin with.
TEST(ScanLines, RowsOfNumbersWithFewOtherBytes)
{
  std::mt19937_64 random(4);
  const std::string_view rare = " \r\t\nIA@!-";
  for (int i = 0; i < 20'000 && !HasFailure(); ++i)
  {
    const std::uint64_t length = 1 + random() % 150;
    const std::uint64_t others = 1 + random() % 400;
    std::string text(random() % 1000, '0');
    for (char& c : text)
    {
      const bool between = random() % 8 == 0;
      c = random() % length == 0 ? '\n' : between ? ' ' : c;
      c = random() % others == 0 ? rare[random() % rare.size()] : c;
    }
    const LineState states[] = { new_line, in_a_word, behind_blanks };
    expect_all(text, states[random() % 3], random() % 64, "I@!-A\0"[random() % 6]);
  }
}
