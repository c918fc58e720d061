// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong on one rank goes wrong on all, with the same words; the old file stays, and nothing else is left.
#include "../support/dump_writing.h"
#include "../support/dumps.h"
#include "../support/small_disk.h"
#include "../support/stop.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace
{
using namespace granular;

constexpr ParallelMode modes[] = { ParallelMode::Gather, ParallelMode::MpiIo };
constexpr const char* old_content = "what was there before";

/// Three ranks with rows of several batches each.
struct ThreeRanks
{
  explicit ThreeRanks(std::int64_t rows = 30000)
    : made(rows, small_box(false))
  {
    frames = { made.view(), made.view() };
    frames[1].header.timestep = 101;
  }

  std::vector<Frames> ranks() const { return cut(frames, { made_rows() / 3, made_rows() / 3, 1 }); }
  std::int64_t made_rows() const { return static_cast<std::int64_t>(made.ids.size()); }

  MadeRows made;
  Frames frames;
};

/// Writes to a file that is there, which must stay.
void expect_error(const std::vector<Frames>& ranks, const DumpFormat& format,
  const std::string& error, const std::string& what)
{
  for (const ParallelMode mode : modes)
  {
    for (const int threads : { 1, 3 })
    {
      const Folder folder;
      folder.write("old", old_content);
      const Written written = write_dump(folder.path("old"), ranks, format, { mode, threads });
      EXPECT_EQ(written.error, error) << what << ", mode " << static_cast<int>(mode);
      EXPECT_EQ(written.bytes, old_content);
      EXPECT_EQ(names_in(folder.path("")), "old");
    }
  }
}

class CountReports final : public Progress
{
public:
  explicit CountReports(std::atomic<int>& reports)
    : reports_(reports)
  {
  }
  bool report(double) override
  {
    ++reports_;
    return true;
  }

private:
  std::atomic<int>& reports_;
};
}

TEST(WriteFaults, missing_array)
{
  const ThreeRanks three;
  std::vector<Frames> ranks = three.ranks();
  for (FrameView& frame : ranks[1])
  {
    std::erase_if(frame.arrays, [](const ArrayView& array) { return array.name == "radius"; });
  }
  expect_error(ranks, {},
    "column 'radius': expected an array to make it from, got none: there are id, type, v, image, "
    "element (on rank 1 of 3)",
    "missing array");
  for (Frames& frames : ranks)
  {
    std::erase_if(frames[0].arrays, [](const ArrayView& array) { return array.name == "radius"; });
  }
  DumpFormat format;
  format.columns = { "id", "radius" };
  expect_error(ranks, format,
    "column 'radius': expected an array to make it from, got none: there are id, type, v, image, "
    "element (on rank 0 of 3)",
    "missing on all");
}

/// Each would go its own way: one would sort with the others and the other would not.
TEST(WriteFaults, other_arrays)
{
  const ThreeRanks three;
  const std::vector<double> real(30000);
  const auto with = [&](const std::string& name, const ArrayView* other)
  {
    std::vector<Frames> ranks = three.ranks();
    for (FrameView& frame : ranks[2])
    {
      std::erase_if(frame.arrays, [&](const ArrayView& array) { return array.name == name; });
      if (other)
      {
        frame.arrays.push_back(*other);
      }
    }
    return ranks;
  };
  const auto others = [](const std::string& column)
  {
    return "column '" + column +
      "': expected an array of the same kind on all ranks, got others (on rank 2 of 3)";
  };
  DumpFormat format;
  format.sort_by_id = true;
  format.columns = { "type", "x" };
  const ArrayView real_ids = view_rows("id", ValueType::Float64, real.data());
  expect_error(with("id", &real_ids), format, others("id"), "real ids");
  expect_error(with("id", nullptr), format, others("id"), "no ids");
  format.columns = { "type", "ix" };
  expect_error(with("image", nullptr), format, others("ix"), "no images");
  format.columns = { "id" };
  expect_error(with("id", &real_ids), format, others("id"), "real ids that are written");
  format.columns = { "element" };
  const ArrayView numbers = view_rows("element", ValueType::Float64, real.data());
  expect_error(with("element", &numbers), format, others("element"), "numbers for texts");
}

TEST(WriteFaults, encoding)
{
  DumpFormat binary;
  binary.binary = true;
  binary.columns = { "id", "x" };
  for (const bool sorted : { false, true })
  {
    for (const int rank : { 0, 1, 2 })
    {
      ThreeRanks three;
      const auto row = static_cast<std::size_t>(rank) * 10000 + 9999;
      three.made.ids[row] = (std::int64_t{ 1 } << 53) + 1;
      three.made.words[row] = "two words";
      binary.sort_by_id = sorted;
      // the biggest id is the last one of all
      const std::string at = " (on rank " + std::to_string(sorted ? 2 : rank) + " of 3)";
      expect_error(three.ranks(), binary,
        "column 'id': expected integers that a double can hold, as all up to 2^53, for a binary "
        "dump, got 9007199254740993" +
          at,
        "big id");
      DumpFormat text;
      text.sort_by_id = sorted;
      expect_error(three.ranks(), text, "column 'element': expected a word, got 'two words'" + at,
        "two words");
    }
  }
}

/// All ranks fail alike: none is named.
TEST(WriteFaults, everywhere)
{
  ThreeRanks three;
  std::fill(three.made.words.begin(), three.made.words.end(), "");
  expect_error(three.ranks(), {}, "column 'element': expected a word, got ''", "all");
}

TEST(WriteFaults, no_folder)
{
  const ThreeRanks three(300);
  const Folder folder;
  for (const ParallelMode mode : modes)
  {
    const std::string path = folder.path("missing/file");
    EXPECT_EQ(write_dump(path, three.ranks(), {}, { mode, 1 }).error,
      path + ": cannot write: No such file or directory (on rank 0 of 3)");
    std::filesystem::create_directories(folder.path("folder"));
    EXPECT_EQ(write_dump(folder.path("folder"), three.ranks(), {}, { mode, 1 }).error,
      folder.path("folder") + ": cannot write: Is a directory (on rank 0 of 3)");
  }
  // the files of two ranks can be opened, that of the third cannot
  std::filesystem::create_directories(folder.path("own.2"));
  EXPECT_EQ(write_dump(folder.path("own.%"), three.ranks(), {}).error,
    folder.path("own.2") + ": cannot write: Is a directory (on rank 2 of 3)");
  EXPECT_EQ(names_in(folder.path("")), "folder own.2");
}

TEST(WriteFaults, full_disk)
{
  const Folder folder;
  const SmallDisk disk(folder.path("disk"));
  if (!disk.there())
  {
    GTEST_SKIP() << SmallDisk::not_there;
  }
  const ThreeRanks three;
  const std::string path = disk.path("old");
  for (const ParallelMode mode : modes)
  {
    for (const bool binary : { false, true })
    {
      folder.write("disk/old", old_content);
      DumpFormat format;
      format.binary = binary;
      format.columns = { "id", "x", "v" };
      const Written written = write_dump(path, three.ranks(), format, { mode, 2 });
      EXPECT_EQ(written.error.substr(0, written.error.find(" (on rank")),
        path + ": cannot write: No space left on device");
      EXPECT_EQ(written.bytes, old_content);
      EXPECT_EQ(names_in(disk.path("")), "old");
    }
  }
  DumpFormat own;
  EXPECT_NE(
    write_dump(disk.path("%"), three.ranks(), own).error.find("No space left"), std::string::npos);
  EXPECT_EQ(names_in(disk.path("")), "old");
}

TEST(WriteFaults, cancelled)
{
  const ThreeRanks three(3000);
  for (const bool sorted : { false, true })
  {
    for (const ParallelMode mode : modes)
    {
      DumpFormat format;
      format.sort_by_id = sorted;
      for (const int stopped : { 0, 1, 2 })
      {
        const Folder folder;
        folder.write("old", old_content);
        std::atomic<int> reports = 0;
        const Written whole = write_dump(folder.path("new"), three.ranks(), format, { mode, 2 },
          [&](int rank)
          {
            return rank == stopped ? std::unique_ptr<Progress>(new CountReports(reports))
                                   : std::make_unique<Progress>();
          });
        ASSERT_EQ(whole.error, "");
        ASSERT_GE(reports, 2);
        for (int report = 0; report < 2; ++report)
        {
          const Written written = write_dump(folder.path("old"), three.ranks(), format, { mode, 2 },
            [&](int rank) {
              return rank == stopped ? std::make_unique<Stop>(report) : std::make_unique<Stop>();
            });
          EXPECT_EQ(written.error, "cancelled") << report << " on " << stopped;
          EXPECT_EQ(written.bytes, old_content);
          EXPECT_EQ(names_in(folder.path("")), "new old");
        }
      }
    }
  }
}

/// At each report of a single process, whose number does not depend on time.
TEST(WriteFaults, cancelled_at_each_report)
{
  const MadeRows rows(30000, small_box(false));
  for (const bool sorted : { false, true })
  {
    DumpFormat format;
    format.sort_by_id = sorted;
    const Folder folder;
    const auto write = [&](Progress& progress)
    {
      SerialCommunicator alone;
      Notices notices;
      DumpWriter writer(folder.path("old"), format, {}, alone);
      writer.write(rows.view(), notices, progress);
      writer.finish();
    };
    Stop all;
    write(all);
    folder.write("old", old_content);
    ASSERT_GT(all.reports, 10);
    for (int report = 0; report < all.reports; ++report)
    {
      Stop stop(report);
      EXPECT_THROW(write(stop), Cancelled) << report;
      EXPECT_EQ(bytes_of_file(folder.path("old")), old_content);
      EXPECT_EQ(names_in(folder.path("")), "old");
    }
    Stop late(all.reports);
    write(late);
  }
}

/// A writer that ends without finish, before and behind a frame.
TEST(WriteFaults, not_finished)
{
  const ThreeRanks three(3000);
  for (const ParallelMode mode : modes)
  {
    for (const char* const name : { "old", "own.%" })
    {
      for (const bool after_a_frame : { false, true })
      {
        const Folder folder;
        folder.write("old", old_content);
        run_ranks(3,
          [&](Communicator& ranks)
          {
            Notices notices;
            Progress progress;
            DumpWriter writer(folder.path(name), {}, { mode, 2 }, ranks);
            if (after_a_frame)
            {
              writer.write(
                three.ranks()[static_cast<std::size_t>(ranks.rank())][0], notices, progress);
            }
          });
        EXPECT_EQ(bytes_of_file(folder.path("old")), old_content);
        EXPECT_EQ(names_in(folder.path("")), "old");
      }
    }
  }
}

/// The first rank lacks memory for a message of another: it takes the rest all the same, and the next file is whole.
TEST(WriteFaults, no_memory_for_a_message)
{
  const ThreeRanks three;
  const Folder folder;
  const std::string whole = write_dump(folder.path("whole"), three.frames, {}).bytes;
  for (const int kept : { 0, 1, 2 })
  {
    std::vector<std::string> errors(3);
    run_ranks(3,
      [&](Communicator& ranks)
      {
        const auto rank = static_cast<std::size_t>(ranks.rank());
        const Frames frames = three.ranks()[rank];
        dynamic_cast<ThreadCommunicator&>(ranks).lack_memory_after(kept);
        for (int i = 0; i < 2; ++i)
        {
          Notices notices;
          Progress progress;
          errors[rank] += error_of(
                            [&]
                            {
                              DumpWriter writer(folder.path("a"), {}, {}, ranks);
                              for (const FrameView& frame : frames)
                              {
                                writer.write(frame, notices, progress);
                              }
                              writer.finish();
                            }) +
            "\n";
        }
      });
    EXPECT_EQ(errors[0], "out of memory (on rank 0 of 3)\n\n") << kept;
    EXPECT_EQ(errors[0], errors[1]);
    EXPECT_EQ(errors[0], errors[2]);
    EXPECT_EQ(difference(bytes_of_file(folder.path("a")), whole), "");
  }
}
