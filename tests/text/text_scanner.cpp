// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/text_scanner.h"

#include "../support/counting_source.h"
#include "../support/error_of.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace
{
using granular::open_memory;
using granular::Progress;
using granular::TextScanner;

constexpr std::size_t window = std::size_t{ 1 } << 18;

struct Line
{
  std::string text;
  std::int64_t offset;
  std::int64_t number;

  bool operator==(const Line&) const = default;
};

std::ostream& operator<<(std::ostream& to, const Line& line)
{
  return to << "line " << line.number << " at " << line.offset << " of " << line.text.size()
            << " bytes: " << line.text.substr(0, 60);
}

/// All lines of a text, found the plain way.
std::vector<Line> naive_lines(std::string_view text)
{
  std::vector<Line> lines;
  std::size_t start = 0;
  for (std::size_t feed = text.find('\n'); feed != text.npos; feed = text.find('\n', start))
  {
    std::string_view line = text.substr(start, feed - start);
    line.remove_suffix(line.ends_with('\r') ? 1 : 0);
    lines.push_back({ std::string(line), static_cast<std::int64_t>(start),
      static_cast<std::int64_t>(lines.size()) + 1 });
    start = feed + 1;
  }
  return lines;
}

std::vector<Line> scanned_lines(std::string_view text)
{
  const auto source = open_memory(text);
  TextScanner scanner(*source, 0, 1);
  std::vector<Line> lines;
  std::string_view line;
  while (scanner.next(line))
  {
    lines.push_back({ std::string(line), scanner.last_offset(), scanner.where().line });
    EXPECT_EQ(scanner.line(), scanner.where().line + 1);
  }
  return lines;
}
}

// ---- words -------------------------------------------------------------------------------------

TEST(SplitWords, EverythingUpToBlankSeparates)
{
  using Words = std::vector<std::string_view>;
  using namespace std::string_view_literals;
  EXPECT_EQ(granular::split_words(""), Words{});
  EXPECT_EQ(granular::split_words(" \t\r"), Words{});
  EXPECT_EQ(granular::split_words("a"), Words{ "a" });
  EXPECT_EQ(granular::split_words(" a\tbc  d \r"), (Words{ "a", "bc", "d" }));
  EXPECT_EQ(granular::split_words("a\0b\x7f\x80"sv), (Words{ "a", "b\x7f\x80" }));
}

// ---- lines -------------------------------------------------------------------------------------

TEST(TextScanner, LinesOfBothKinds)
{
  EXPECT_EQ(scanned_lines("one\ntwo\r\n\n\r\nfive\n"),
    (std::vector<Line>{
      { "one", 0, 1 }, { "two", 4, 2 }, { "", 9, 3 }, { "", 10, 4 }, { "five", 12, 5 } }));
}

TEST(TextScanner, LastLineWithoutLineFeedIsNotThere)
{
  EXPECT_EQ(scanned_lines("one\ntwo"), (std::vector<Line>{ { "one", 0, 1 } }));
  EXPECT_EQ(scanned_lines("one"), std::vector<Line>{});
  EXPECT_EQ(scanned_lines(""), std::vector<Line>{});
}

TEST(TextScanner, OnlyOneCarriageReturnBelongsToTheLineEnd)
{
  EXPECT_EQ(scanned_lines("a\rb\r\r\n"), (std::vector<Line>{ { "a\rb\r", 0, 1 } }));
}

TEST(TextScanner, LinesAcrossTheWindow)
{
  for (std::size_t before = window - 5; before <= window + 5; ++before)
  {
    const std::string text =
      std::string(before, 'x') + "\nITEM: next\r\n" + std::string(before, 'y') + "\nend\n";
    ASSERT_EQ(scanned_lines(text), naive_lines(text)) << before;
  }
}

TEST(TextScanner, RandomLinesOfAllLengths)
{
  std::mt19937_64 random(17);
  for (int round = 0; round < 6; ++round)
  {
    std::string text;
    while (text.size() < 5 * window)
    {
      const std::uint64_t most = random() % 100 == 0 ? 300'000 : 2'000;
      text += std::string(random() % most, 'a') + (random() % 2 == 0 ? "\n" : "\r\n");
    }
    text += random() % 2 == 0 ? "cut" : "";
    ASSERT_EQ(scanned_lines(text), naive_lines(text));
  }
}

TEST(TextScanner, PutBackMakesTheLineComeAgain)
{
  const std::string text = "one\n" + std::string(window, 'x') + "\nthree\n";
  const auto source = open_memory(text);
  TextScanner scanner(*source, 0, 1);
  std::string_view line;
  for (const std::int64_t number : { 1, 2, 3 })
  {
    ASSERT_TRUE(scanner.next(line));
    const std::string first(line);
    scanner.put_back();
    EXPECT_EQ(scanner.line(), number);
    EXPECT_EQ(scanner.offset(), scanner.last_offset());
    ASSERT_TRUE(scanner.next(line));
    EXPECT_EQ(line, first);
    EXPECT_EQ(scanner.where().line, number);
  }
  EXPECT_FALSE(scanner.next(line));
}

TEST(TextScanner, StartsInTheMiddleAndGoesElsewhere)
{
  const auto source = open_memory("one\ntwo\nthree\n");
  TextScanner scanner(*source, 4, 2);
  std::string_view line;
  ASSERT_TRUE(scanner.next(line));
  EXPECT_EQ(line, "two");
  EXPECT_EQ(scanner.where().line, 2);
  scanner.go_to(0, 1);
  ASSERT_TRUE(scanner.next(line));
  EXPECT_EQ(line, "one");
  EXPECT_EQ(scanner.offset(), 4);
}

TEST(TextScanner, AnEndlessLineIsALimitError)
{
  const std::string text = "first\n" + std::string(8 * TextScanner::longest_line, '\0');
  const CountingSource source(text);
  TextScanner scanner(source, 0, 1);
  std::string_view line;
  ASSERT_TRUE(scanner.next(line));
  EXPECT_EQ(error_of<granular::LimitError>([&] { scanner.next(line); }),
    "memory:2: expected a line of at most 4194304 bytes, got a longer one");
  EXPECT_LE(source.bytes_read(), static_cast<std::int64_t>(2 * TextScanner::longest_line + window));
}

TEST(TextScanner, ALongLineIsNone)
{
  const std::string text = std::string(TextScanner::longest_line - 1, 'x') + "\nend\n";
  EXPECT_EQ(scanned_lines(text), naive_lines(text));
}

// ---- sections ----------------------------------------------------------------------------------

namespace
{
struct Skipped
{
  std::int64_t lines; ///< with words
  std::int64_t line;
  std::int64_t offset;

  bool operator==(const Skipped&) const = default;
};

std::ostream& operator<<(std::ostream& to, const Skipped& skipped)
{
  return to << skipped.lines << " lines, to line " << skipped.line << " at " << skipped.offset;
}

/// From the line that offset is the start of, up to an ITEM: or to the start of a line without LF.
Skipped naive_skip(std::string_view text, std::size_t offset, std::int64_t line)
{
  Skipped skipped{ 0, line, static_cast<std::int64_t>(offset) };
  while (!text.substr(offset).starts_with("ITEM:"))
  {
    const std::size_t feed = text.find('\n', offset);
    if (feed == text.npos)
    {
      break;
    }
    ++skipped.line;
    skipped.lines += granular::split_words(text.substr(offset, feed - offset)).empty() ? 0 : 1;
    offset = feed + 1;
  }
  skipped.offset = static_cast<std::int64_t>(offset);
  return skipped;
}

Skipped skip(TextScanner& scanner)
{
  Progress progress;
  const std::int64_t lines = scanner.skip_to_item(progress);
  return { lines, scanner.line(), scanner.offset() };
}

void expect_skips(std::string_view text, const granular::ScanAhead& ahead)
{
  const auto source = open_memory(text);
  TextScanner scanner(*source, 0, 1, window, ahead);
  std::string_view line;
  for (;;)
  {
    const Skipped expected =
      naive_skip(text, static_cast<std::size_t>(scanner.offset()), scanner.line());
    ASSERT_EQ(skip(scanner), expected) << ahead.threads << " " << ahead.chunk;
    if (!scanner.next(line))
    {
      break;
    }
    ASSERT_EQ(line, naive_lines(text.substr(static_cast<std::size_t>(expected.offset)))[0].text);
    ASSERT_EQ(scanner.where().line, expected.line);
  }
}

/// By one thread and by several, which take more or less of it.
void expect_skips(std::string_view text)
{
  expect_skips(text, {});
  const bool small = text.size() < 1000;
  for (const int threads : { 2, 5 })
  {
    for (const std::size_t chunk : small ? std::vector<std::size_t>{ 1, 2, 3, 4, 5, 6, 7, 64 }
                                         : std::vector<std::size_t>{ 4'001, 100'000 })
    {
      expect_skips(text, { threads, 0, chunk });
      expect_skips(text, { threads, small ? 3 : 300'000, chunk });
    }
  }
}
}

TEST(TextScanner, SkipsToTheNextItem)
{
  const std::string text = "1 2\nI 3\n ITEM: no\nxITEM: no\nITEM no\nITEMS:\nITEM: yes\nmore\n";
  const auto source = open_memory(text);
  TextScanner scanner(*source, 0, 1);
  EXPECT_EQ(skip(scanner), (Skipped{ 6, 7, 43 }));
  EXPECT_EQ(skip(scanner), (Skipped{ 0, 7, 43 })); // stands on one
  std::string_view line;
  ASSERT_TRUE(scanner.next(line));
  EXPECT_EQ(line, "ITEM: yes");
  EXPECT_EQ(skip(scanner), (Skipped{ 1, 9, 58 }));
  EXPECT_FALSE(scanner.next(line));
}

TEST(TextScanner, SkipsToTheStartOfALineWithoutLineFeed)
{
  expect_skips("1\n2\n3 cut");
  expect_skips("cut");
  expect_skips("");
  expect_skips("1\nI");
  expect_skips("1\nITEM");
  expect_skips("1\nITEM:");
  expect_skips("1\nITEM: TIM");
  expect_skips("\n\n");
  expect_skips("1\n \n\r\n\n2\n \t");
  expect_skips("     \n   x   \n      ITEM:\nITEM: a\n        \n");
}

TEST(TextScanner, ItemSplitAtTheEndOfTheWindow)
{
  for (std::size_t before = window - 12; before <= window + 3; ++before)
  {
    const std::string head = std::string(before - 9, '1') + "\nI 2\nITE\n";
    expect_skips(head + "ITEM: A\n3\nITEM: B\n4\n");
    expect_skips(head + "ITEM:");
    expect_skips(head + "ITE");
    expect_skips(head + "ITEX: A\n3\n");
    // and where it is the second window that ends there
    expect_skips(std::string(window, '\n') + head + "ITEM: A\n3\nITEM: B");
  }
}

TEST(TextScanner, RandomTextsAreSkippedAsTheyAreByHand)
{
  std::mt19937_64 random(23);
  for (int round = 0; round < 20; ++round)
  {
    std::string text;
    while (text.size() < 3 * window)
    {
      switch (random() % 12)
      {
        case 0:
          text += random() % 300 == 0 ? "ITEM: X\n" : "ITEMx\n";
          break;
        case 1:
          text += "I\n";
          break;
        case 3:
          text += std::string(random() % (random() % 50 == 0 ? 300'000 : 80), ' ') + "\n";
          break;
        case 2:
          text += std::string(random() % (random() % 50 == 0 ? 300'000 : 300), 'I') + "\r\n";
          break;
        default:
          text += std::string(random() % 100, '8') + "\n";
      }
    }
    text += random() % 2 == 0 ? "ITE" : "";
    expect_skips(text);
  }
}

TEST(TextScanner, SkippingReportsAndCanBeStopped)
{
  class Stopping final : public Progress
  {
  public:
    bool report(double fraction) override
    {
      EXPECT_GT(fraction, last);
      EXPECT_EQ(std::this_thread::get_id(), caller_);
      last = fraction;
      return ++reports < 3;
    }
    int reports = 0;
    double last = 0;

  private:
    std::thread::id caller_ = std::this_thread::get_id();
  };
  const std::string text(std::size_t{ 160 } << 20, '\n');
  const auto source = open_memory(text);
  Stopping alone;
  EXPECT_THROW(TextScanner(*source, 0, 1).skip_to_item(alone), granular::Cancelled);
  EXPECT_EQ(alone.reports, 3);
  EXPECT_GT(alone.last, 0.55);
  EXPECT_LT(alone.last, 0.65);
  // of several threads the caller's may get little to do: every 128 chunks a thread, and more often
  granular::ScanAhead ahead;
  ahead.threads = 2;
  ahead.chunk = std::size_t{ 1 } << 17;
  Stopping progress;
  EXPECT_THROW(
    TextScanner(*source, 0, 1, window, ahead).skip_to_item(progress), granular::Cancelled);
  EXPECT_EQ(progress.reports, 3);
}
