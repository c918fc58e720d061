// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a frame is said in the same words by any number of threads in chunks of any size;
// files that change while they are read, and tasks that are stopped, end in an error, never in other
// numbers.
#include "../support/binary_dumps.h"
#include "../support/dumps.h"
#include "../support/frame_content.h"
#include "../support/series.h"
#include "../support/stop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace
{
using granular::ByteSource;
using granular::Notices;
using granular::Progress;
using granular::Request;

constexpr std::pair<int, std::size_t> manners[] = { { 1, 1 }, { 1, 50 }, { 2, 7 }, { 2, 64 },
  { 3, 50 }, { 4, 23 }, { 5, 300 }, { 3, std::size_t{ 1 } << 18 } };

/// What the plain reading gives, after all others gave the same.
Outcome same_outcome(const ReadFrame& read, const Request& request = {})
{
  const Outcome whole = outcome_of(read, plainly(request));
  for (const auto& [threads, chunk] : manners)
  {
    EXPECT_EQ(outcome_of(read, in_chunks(request, threads, chunk)).difference(whole), "")
      << threads << " threads, chunks of " << chunk;
  }
  return whole;
}

ReadFrame reading(const Dump& dump, std::size_t frame = 0)
{
  return [&dump, frame](const Request& request, Notices& notices)
  {
    Decoded decoded = dump.read(request, frame);
    notices = decoded.notices;
    return std::move(decoded.frame);
  };
}
}

// ---- faults ------------------------------------------------------------------------------------

TEST(FrameFaults, FilesOfBadData)
{
  int errors = 0;
  for (const auto& file : std::filesystem::directory_iterator(GRANULAR_DATA "/bad"))
  {
    const std::string name = "bad/" + file.path().filename().string();
    SCOPED_TRACE(name);
    std::optional<Dump> dump;
    const std::string refused = error_of([&] { dump.emplace(data_file(name)); });
    for (std::size_t frame = 0; refused.empty() && frame < dump->frames(); ++frame)
    {
      for (const Request& request : { Request{}, everything() })
      {
        errors += same_outcome(reading(*dump, frame), request).error.empty() ? 0 : 1;
      }
    }
  }
  EXPECT_GE(errors, 12);
}

namespace
{
/// What may be wrong with a row "id type x y z state".
struct Fault
{
  const char* row;
  const char* said; ///< behind the path and the line; empty: nothing is wrong
  bool error;
};

constexpr Fault faults[] = {
  { "17 1 0.5 0.5 0.5 1", "", false },
  { "17 1 0.5 half 0.5 1", " column 'y': expected a number, got 'half'", true },
  { "17 1 0.5 0.5 0.5", " expected 6 words in a row, got 5", true },
  { "17 1 0.5 0.5 0.5 1 0", " expected 6 words in a row, got 7", true },
  { "1.5 1 0.5 0.5 0.5 1", " column 'id': expected an integer, got '1.5'", true },
  { "17 2.5 0.5 0.5 0.5 1",
    " column 'type': expected an integer, got '2.5'; the column is kept as doubles", false },
  { "17 1 0.5 0.5 0.5 wet",
    " column 'state': expected a number, got 'wet'; the column is kept as texts", false },
  { "17 3.5 0.5 0.5 0.5 dry",
    " column 'type': expected an integer, got '3.5'; the column is kept as doubles", false },
};

std::string with_rows(std::size_t first, const char* one, std::size_t second, const char* other)
{
  std::string rows;
  for (std::size_t row = 0; row < 40; ++row)
  {
    rows += row == first ? one
      : row == second    ? other
                         : std::to_string(row) + " 1 0.25 0.5 0.75 " + std::to_string(row % 3);
    rows += "\n";
  }
  return one_frame("id type x y z state", rows);
}
}

/// Two faults: the first error counts, and the notices stand in the order of the rows.
TEST(FrameFaults, TheFirstByPositionCounts)
{
  for (const Fault& one : faults)
  {
    for (const Fault& other : faults)
    {
      for (const auto& [first, second] :
        std::vector<std::pair<std::size_t, std::size_t>>{ { 1, 39 }, { 11, 12 }, { 5, 30 } })
      {
        const Dump dump(with_rows(first, one.row, second, other.row));
        const Outcome outcome = same_outcome(reading(dump));
        const auto line = [](std::size_t row, const Fault& fault)
        { return "memory:" + std::to_string(10 + row) + ":" + fault.said; };
        EXPECT_EQ(outcome.error,
          one.error       ? line(first, one)
            : other.error ? line(second, other)
                          : "");
        if (outcome.error.empty() && *one.said != '\0')
        {
          EXPECT_TRUE(outcome.said.starts_with(line(first, one))) << outcome.said;
        }
      }
    }
  }
}

TEST(FrameFaults, BinaryValuesThatDoNotFit)
{
  const binary::Form& form = binary::form("plain, little-endian");
  for (const std::size_t row : { 0u, 13u, 29u })
  {
    binary::Frame frame = binary::particles(form, 1, 30);
    const std::size_t half = frame.chunks[0].size();
    std::vector<double>& run = 12 * row < half ? frame.chunks[0] : frame.chunks[2];
    run[12 * row - (12 * row < half ? 0 : half) + 1] = 1.5;
    run[12 * row - (12 * row < half ? 0 : half)] = 0.5;
    const Dump dump(binary::write(form, { frame }).bytes, binary::particle_columns);
    const Outcome outcome = same_outcome(reading(dump));
    EXPECT_EQ(outcome.error, "");
    EXPECT_NE(outcome.said.find(
                "column 'id': expected an integer, got '0.5'; the column is kept as doubles\n"),
      std::string::npos);
    EXPECT_NE(
      outcome.said.find("column 'type': expected an integer, got '1.5'"), std::string::npos);
  }
}

// ---- files that change -------------------------------------------------------------------------

namespace
{
/// Bytes that are others from the n-th read on.
class Liar final : public ByteSource
{
public:
  Liar(std::string before, std::string after, int reads, bool concurrent)
    : before_(std::move(before))
    , after_(std::move(after))
    , reads_(reads)
    , concurrent_(concurrent)
  {
  }

  const std::string& path() const override { return path_; }
  granular::FileStamp stamp() const override { return {}; }
  bool concurrent() const override { return concurrent_; }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    EXPECT_TRUE(++inside_ == 1 || concurrent_); // nobody reads while another does
    const std::string& content = count_.fetch_add(1) < reads_ ? before_ : after_;
    const std::size_t start = std::min(static_cast<std::size_t>(offset), content.size());
    const std::size_t got = content.copy(buffer, bytes, start);
    --inside_;
    return got;
  }

  int reads() const { return count_; }

private:
  std::string before_;
  std::string after_;
  int reads_;
  bool concurrent_;
  std::string path_ = "liar";
  mutable std::atomic<int> count_ = 0;
  mutable std::atomic<int> inside_ = 0;
};

/// Bytes of which one read fails, and those after it do not.
class FailsOnce final : public ByteSource
{
public:
  FailsOnce(std::string bytes, int at)
    : bytes_(std::move(bytes))
    , left_(at)
  {
  }

  const std::string& path() const override { return path_; }
  granular::FileStamp stamp() const override { return {}; }
  bool concurrent() const override { return true; }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    if (left_.fetch_sub(1) == 0)
    {
      for (int patience = 1000; patience > 0 && left_ > -3; --patience)
      {
        std::this_thread::yield(); // others are to be at work then
      }
      throw granular::IoError("a read that fails", { path_ });
    }
    return bytes_.copy(buffer, bytes, std::min(static_cast<std::size_t>(offset), bytes_.size()));
  }

  bool failed() const { return left_ < 0; }

private:
  std::string bytes_;
  std::string path_ = "once";
  mutable std::atomic<int> left_;
};

/// Others of the same length, and of other lengths.
std::vector<std::string> changed(const std::string& bytes)
{
  const std::size_t size = bytes.size();
  std::vector<std::string> all = { bytes.substr(0, size / 2), bytes.substr(0, size - 1), "",
    std::string(size, 'x'), std::string(size, '\n'), std::string(size, '\0'),
    std::string(size, '\xff'), bytes + bytes, bytes.substr(0, size / 2) + bytes };
  std::string other = bytes;
  std::reverse(other.begin(), other.end());
  all.push_back(other);
  other = bytes;
  std::replace(other.begin(), other.end(), ' ', '\n');
  all.push_back(other);
  other = bytes;
  std::replace(other.begin(), other.end(), '\n', ' ');
  all.push_back(other);
  return all;
}

/// Whatever the file becomes: an error, or as many rows as there are.
void expect_no_crash(const std::string& bytes, const Dump& dump)
{
  for (const std::string& other : changed(bytes))
  {
    for (Request request : { Request{}, all_requests()[3], all_requests()[8] })
    {
      for (const auto& [threads, chunk] :
        std::vector<std::pair<int, std::size_t>>{ { 1, 100 }, { 3, 40 }, { 2, 1 << 18 } })
      {
        request = in_chunks(request, threads, chunk);
        request.pieces = threads == 3 ? 2 : 1;
        request.piece = request.pieces - 1;
        for (const int reads : { 0, 1, 2, 3, 5, 9, 20 })
        {
          const Liar liar(bytes, other, reads, threads % 2 == 1);
          Notices notices;
          Progress progress;
          try
          {
            const granular::Table frame = read_dump(liar, dump.entry(), request, notices, progress);
            EXPECT_LE(frame.rows, dump.entry().rows);
            EXPECT_TRUE(
              request.pieces > 1 || request.stride > 1 || frame.rows == dump.entry().rows);
          }
          catch (const granular::IoError&)
          {
          }
          catch (const granular::FormatError&)
          {
          }
        }
      }
    }
  }
}
}

TEST(FrameFaults, TextsThatChangeWhileTheyAreRead)
{
  const std::string text = with_rows(3, "9 1 0 0 0 1", 50, "");
  expect_no_crash(text, Dump(text));
}

TEST(FrameFaults, BinariesThatChangeWhileTheyAreRead)
{
  const binary::Form& form = binary::form("DUMPCUSTOM revision 2, little-endian");
  const std::string bytes = binary::write(form, { binary::particles(form, 1, 30) }).bytes;
  expect_no_crash(bytes, Dump(bytes));
}

/// Cut to some bytes after so many reads.
TEST(FrameFaults, ShortenedWhileItIsRead)
{
  std::string rows;
  for (int row = 0; row < 10'000; ++row)
  {
    rows += std::to_string(row) + " 0.5 0.25 0.125 H\n";
  }
  const std::string text = one_frame("id x y z element", rows);
  const Dump dump(text);
  int shortened = 0;
  for (int reads = 0; reads < 5; ++reads)
  {
    for (const std::size_t left :
      { std::size_t{ 0 }, std::size_t{ 200 }, text.size() / 2, text.size() - 1 })
    {
      const Liar source(text, text.substr(0, left), reads, false);
      const std::string error = error_of(
        [&]
        {
          Notices notices;
          Progress progress;
          read_dump(source, dump.entry(), {}, notices, progress);
        });
      if (reads == 0 && left == 0) // the header is gone
      {
        EXPECT_EQ(error,
          "liar:1: the file changed since it was indexed: expected the frame of timestep 0; reload "
          "the files");
      }
      else if (!error.empty())
      {
        ++shortened;
        EXPECT_TRUE(error.starts_with("liar: the file was shortened while it was read: expected " +
          std::to_string(text.size()) + " bytes, got "))
          << error;
      }
    }
  }
  EXPECT_GT(shortened, 7) << "two reads of the header and the rows, and all after them cut";
}

/// Those who cannot be read by several at once are not.
TEST(FrameFaults, OneReadAtATime)
{
  const std::string text = with_rows(3, "9 1 0 0 0 1", 50, "");
  const Dump dump(text);
  for (const int threads : { 1, 2, 5 })
  {
    const Liar honest(text, text, 0, false);
    Request request = in_chunks({}, threads, 30);
    request.stride = 3;
    request.pieces = 2;
    request.piece = 1;
    Notices notices;
    Progress progress;
    read_dump(honest, dump.entry(), request, notices, progress);
    EXPECT_GT(honest.reads(), 10);
  }
}

/// Those who wait for the chunk that failed are not left waiting.
TEST(FrameFaults, AReadThatFailsAmongOthers)
{
  const std::string text = with_rows(3, "9 1 0 0 0 1", 50, "");
  const Dump dump(text);
  for (const Request& request : all_requests())
  {
    for (const int threads : { 1, 2, 4 })
    {
      bool failed = true;
      int at = 0;
      for (; failed; ++at)
      {
        const FailsOnce source(text, at);
        const Outcome outcome = outcome_of(
          [&](const Request& own, Notices& notices)
          {
            Progress progress;
            return read_dump(source, dump.entry(), own, notices, progress);
          },
          in_chunks(request, threads, 60));
        failed = source.failed();
        EXPECT_EQ(outcome.error, failed ? "once: a read that fails" : "");
      }
      EXPECT_GT(at, 15);
    }
  }
}

/// As many bytes as before, but other rows.
TEST(FrameFaults, RowsThatCameOrWent)
{
  const std::string text = with_rows(3, "9 1 0 0 0 1 # more words here", 50, "");
  const Dump dump(text);
  const auto read_other = [&](const std::string& other)
  {
    EXPECT_EQ(other.size(), text.size());
    const auto source = granular::open_memory(other);
    return same_outcome(
      [&](const Request& request, Notices& notices)
      {
        Progress progress;
        return read_dump(*source, dump.entry(), request, notices, progress);
      });
  };
  const std::string row = "\n30 1 0.25 0.5 0.75 0\n";
  ASSERT_NE(text.find(row), text.npos);
  EXPECT_EQ(read_other(replaced(text, row, "\n" + std::string(row.size() - 2, ' ') + "\n")).error,
    "memory:1: expected 40 rows, got 39");
  const std::string longer = replaced(text, "1 # more words here", "1\n8 1 0 0 0 1      ");
  EXPECT_EQ(read_other(longer).error, "memory:1: expected 40 rows, got more");
  // the row too many is the last one, and stands before one that is wrong
  EXPECT_EQ(read_other(replaced(longer, "\n39 1 0.25", "\n39 1 wron")).error,
    "memory:1: expected 40 rows, got more");
  EXPECT_EQ(read_other(replaced(longer, "\n20 1 0.25", "\n20 1 wron")).error,
    "memory:31: column 'x': expected a number, got 'wron'");
}

namespace
{
/// Three pieces of a frame, of which some change behind the back of the index: not at their ends, by
/// which it would know them.
class ChangingPieces
{
public:
  ChangingPieces()
  {
    Files files;
    for (int process = 0; process < 3; ++process)
    {
      std::string rows;
      for (int row = 0; row < 1200; ++row)
      {
        rows += std::to_string(10'000 * process + row) + " 0.5 0.5 0.5\n" +
          (row == 600 ? "             \n" : "");
      }
      texts_.push_back(header(5, 1200) + rows);
      files.push_back(folder_.write("a." + std::to_string(process) + ".dump", texts_.back()));
    }
    series_.update(files);
  }

  std::string path(int process) const
  {
    return folder_.path("a." + std::to_string(process) + ".dump");
  }

  /// Replaces what stands in a piece by something as long.
  void change(int process, const std::string& what, const std::string& with)
  {
    std::string& text = texts_.at(static_cast<std::size_t>(process));
    const std::string other = replaced(text, what, with);
    ASSERT_EQ(other.size(), text.size());
    ASSERT_NE(other, text);
    text = other;
    folder_.write("a." + std::to_string(process) + ".dump", text);
  }

  Outcome read() const
  {
    return outcome_in({ { 1, std::size_t{ 1 } << 40 }, { 1, 1000 }, { 3, 5000 }, { 4, 1 << 18 } });
  }

private:
  Outcome outcome_in(const std::vector<std::pair<int, std::size_t>>& ways) const
  {
    std::optional<Outcome> first;
    for (const auto& [threads, chunk] : ways)
    {
      const Outcome outcome = outcome_of(
        [&](const Request& request, Notices& notices)
        {
          Progress progress;
          return read_dump(series_.index.pieces(0), request, notices, progress);
        },
        in_chunks({}, threads, chunk));
      first = first ? first : outcome;
      EXPECT_EQ(outcome.difference(*first), "") << threads << " threads, chunks of " << chunk;
    }
    return *first;
  }

  Folder folder_;
  std::vector<std::string> texts_;
  Series series_;
};

constexpr const char* blank_row = "\n             \n";
}

/// One may have a row too many, which stands where a blank line was, another too few, and a third a word for a number.
TEST(FrameFaults, TheFirstPieceThatIsWrongIsNamed)
{
  struct Change
  {
    int process;
    const char* what;
    const char* with;
  };
  constexpr Change more[] = { { 0, blank_row, "\n17 0.5 0.5 .5\n" },
    { 1, blank_row, "\n17 0.5 0.5 .5\n" }, { 2, blank_row, "\n18 0.5 0.5 .5\n" } };
  constexpr Change fewer[] = { { 0, "\n500 0.5 0.5 0.5\n", "\n               \n" },
    { 1, "\n10500 0.5 0.5 0.5\n", "\n                 \n" },
    { 2, "\n20500 0.5 0.5 0.5\n", "\n                 \n" } };
  constexpr Change faulty[] = { { 0, "\n500 0.5 0.5 0.5\n", "\n500 0.5 bad 0.5\n" },
    { 1, "\n10500 0.5 0.5 0.5\n", "\n10500 0.5 bad 0.5\n" } };
  const std::string too_many = ":1: expected 1200 rows, got more";
  const std::string too_few = ":1: expected 1200 rows, got 1199";
  const struct
  {
    std::vector<Change> changes;
    int process;
    std::string said;
  } cases[] = {
    { { more[1] }, 1, too_many },
    { { more[0], fewer[2] }, 0, too_many }, // there is room for it
    { { fewer[0], faulty[1] }, 0, too_few },
    { { faulty[0], fewer[1] }, 0, ":510: column 'y': expected a number, got 'bad'" },
    { { fewer[0], more[1], more[2] }, 0, too_few },
  };
  for (const auto& one : cases)
  {
    ChangingPieces pieces;
    EXPECT_EQ(pieces.read().content.rows, 3600);
    for (const Change& change : one.changes)
    {
      pieces.change(change.process, change.what, change.with);
    }
    EXPECT_EQ(pieces.read().error, pieces.path(one.process) + one.said);
  }
}

// ---- stopped -----------------------------------------------------------------------------------

TEST(FrameFaults, StoppedAtEveryReport)
{
  const Dump dump(with_rows(3, "9 2.5 0 0 0 wet", 50, ""));
  Request request = all_requests()[3];
  request.pieces = 2;
  request.piece = 1;
  for (const Request& one : { Request{}, request, all_requests()[4], all_requests()[8] })
  {
    const Outcome whole = outcome_of(reading(dump), one);
    for (const int threads : { 1, 2, 3, 4 })
    {
      const Request small = in_chunks(one, threads, 100);
      int at = 0;
      for (bool stopped = true; stopped; ++at)
      {
        Stop stop(at);
        const Outcome outcome = outcome_of(
          [&](const Request& asked, Notices&) { return dump.read(asked, 0, stop).frame; }, small);
        stopped = stop.reports > at;
        EXPECT_EQ(outcome.error, stopped ? "cancelled" : "");
        EXPECT_TRUE(stopped || stop.last == 1);
        EXPECT_EQ(outcome_of(reading(dump), small).difference(whole), "");
      }
      EXPECT_GT(at, 2);
    }
  }
}
