// SPDX-License-Identifier: BSD-3-Clause
// One index for all ranks: rank 0 makes it, and all can read every frame.
#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/frames/run_index.h"

#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/series.h"
#include "../support/stop.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using granular::Communicator;
using granular::IndexOptions;
using granular::Notices;
using granular::Progress;
using granular::RunIndex;

/// What one rank sees.
struct Rank
{
  explicit Rank(Communicator& communicator)
    : ranks(communicator)
  {
  }

  /// Returns what this rank is told.
  std::string update(
    const Files& files, const IndexOptions& options = { .format = &granular::dump_format() })
  {
    Progress progress;
    return this->update(files, options, progress);
  }

  std::string update(const Files& files, const IndexOptions& options, Progress& progress)
  {
    Notices notices;
    granular::update_run_index(index, ranks, files, options, notices, progress);
    return lines_of(notices);
  }

  /// Every frame as it is read here: timestep, header, ids.
  std::string frames() const
  {
    std::string text;
    for (std::size_t i = 0; i < index.size(); ++i)
    {
      Progress progress;
      Decoded decoded;
      decoded.frame = granular::read_dump(index.pieces(i), {}, decoded.notices, progress);
      text += std::to_string(decoded.frame.header.timestep) + ":";
      for (const std::int64_t id : decoded.integers("id"))
      {
        text += " " + std::to_string(id);
      }
      text += "\n" + decoded.said();
    }
    return text;
  }

  /// Bytes that rank 0 has sent so far.
  std::size_t sent() const
  {
    const auto* several = dynamic_cast<const ThreadCommunicator*>(&ranks);
    return several ? several->broadcast_bytes() : 0;
  }

  Communicator& ranks;
  RunIndex index;
};

constexpr int ranks_of_tests = 3;

/// A run with files that are no dumps among those that are.
Files mixed_run(const Folder& folder)
{
  std::string text;
  for (int step = 0; step < 40; ++step)
  {
    text += particles(step, ids_from(1, 3000));
  }
  return { folder.path("missing"), folder.write("a.dump", particles(100, ids_from(1, 4))),
    folder.write("b.gz", packing::gzip(text)), folder.write("c.jpg", "\xff\xd8 no dump\n"),
    folder.write(
      "d.dump", particles(200, ids_from(1, 2)) + particles(300, {}) + "ITEM: TIMESTEP\nx\n"),
    folder.write("e.zst", packing::zstd_frames(particles(400, ids_from(5, 7)), 100)) };
}
}

TEST(IndexRanks, AllReadEveryFrame)
{
  const Folder folder;
  const Files files = mixed_run(folder);
  Series alone;
  alone.update(files);
  run_ranks(ranks_of_tests,
    [&](Communicator& communicator)
    {
      Rank rank(communicator);
      EXPECT_EQ(rank.update(files), communicator.rank() == 0 ? alone.said : "");
      EXPECT_TRUE(rank.index.encode() == alone.index.encode());
      EXPECT_EQ(rank.index.size(), 44u);
      EXPECT_EQ(rank.index.files().size(), files.size());
      ASSERT_TRUE(rank.index.files()[2].points);
      EXPECT_FALSE(rank.index.files()[2].points->points.empty());
      EXPECT_EQ(rank.index.times(0.5), alone.index.times(0.5));
      Rank other(communicator);
      other.index.decode(alone.index.encode());
      EXPECT_EQ(rank.frames(), other.frames());
      EXPECT_EQ(rank.frames().substr(0, 8), "0: 1 2 3");
    });
}

TEST(IndexRanks, NewFilesAreLookedThroughByAll)
{
  const Folder folder;
  const Files files = mixed_run(folder);
  for (const std::string& path : files)
  {
    if (fs::exists(path))
    {
      touch(path, -100);
    }
  }
  Series alone;
  alone.update(files);
  run_ranks(ranks_of_tests,
    [&](Communicator& communicator)
    {
      Rank rank(communicator);
      Stop progress;
      EXPECT_EQ(rank.update(files, { .format = &granular::dump_format() }, progress),
        communicator.rank() == 0 ? alone.said : "");
      EXPECT_GT(progress.reports, 0);
      if (communicator.rank() == 0)
      {
        EXPECT_EQ(progress.last, 1);
      }
      EXPECT_TRUE(rank.index.encode() == alone.index.encode());
      Rank other(communicator);
      other.index.decode(alone.index.encode());
      EXPECT_EQ(rank.frames(), other.frames());
      // what is known is looked through by none
      Stop quiet;
      rank.update(files, { .format = &granular::dump_format() }, quiet);
      EXPECT_EQ(quiet.reports > 0, communicator.rank() == 0);
      // files that come are looked through by all, others stay
      Files more = files;
      for (int i = 0; i < ranks_of_tests; ++i)
      {
        more.push_back(folder.path("more" + std::to_string(i)));
        if (communicator.rank() == 0)
        {
          folder.write("more" + std::to_string(i), particles(1000 + i, ids_from(1, 5)));
          touch(more.back(), -100);
        }
      }
      communicator.agree({});
      Stop again;
      rank.update(more, { .format = &granular::dump_format() }, again);
      EXPECT_GT(again.reports, 0);
      EXPECT_EQ(rank.index.size(), 44u + ranks_of_tests);
      EXPECT_NE(rank.frames().find("\n1002: 1 2 3 4 5\n"), std::string::npos);
    });
}

TEST(IndexRanks, AFileThatARankSeesOtherwiseIsLookedThroughByRank0)
{
  /// Writes a file again while its rank looks.
  class Writing final : public Progress
  {
  public:
    Writing(const Folder& folder, bool writes)
      : folder_(folder)
      , writes_(writes)
    {
    }

    bool report(double) override
    {
      if (writes_)
      {
        folder_.write("b.dump", particles(300, { 3, 4 }));
        touch(folder_.path("b.dump"), -50);
      }
      return true;
    }

  private:
    const Folder& folder_;
    bool writes_;
  };
  const Folder folder;
  Files files;
  for (const char* const name : { "a.dump", "b.dump", "c.dump" })
  {
    files.push_back(folder.write(name, particles(100 * (name[0] - 'a'), { 1, 2 })));
    touch(files.back(), -100);
  }
  run_ranks(ranks_of_tests,
    [&](Communicator& communicator)
    {
      Rank rank(communicator);
      Writing progress(folder, communicator.rank() == 1);
      rank.update(files, { .format = &granular::dump_format() }, progress);
      EXPECT_EQ(rank.frames(), "0: 1 2\n200: 1 2\n300: 3 4\n");
    });
}

TEST(IndexRanks, PiecesAreThoseOfRank0)
{
  const Folder folder;
  Files files;
  for (int piece = 0; piece < 3; ++piece)
  {
    files.push_back(folder.write("run." + std::to_string(piece),
      particles(0, ids_from(10 * piece, 3)) + particles(5, ids_from(10 * piece, 4))));
  }
  run_ranks(ranks_of_tests,
    [&](Communicator& communicator)
    {
      Rank rank(communicator);
      rank.update(files);
      EXPECT_EQ(rank.frames(), "0: 0 1 2 10 11 12 20 21 22\n5: 0 1 2 3 10 11 12 13 20 21 22 23\n");
      IndexOptions options = { .format = &granular::dump_format() };
      options.repeated_steps = granular::RepeatedSteps::Last;
      rank.update(files, options); // no file has changed
      EXPECT_EQ(rank.frames(), "0: 20 21 22\n5: 20 21 22 23\n");
    });
}

TEST(IndexRanks, OnlyWhatIsNewIsSent)
{
  const Folder folder;
  const Files files = mixed_run(folder);
  run_ranks(ranks_of_tests,
    [&](Communicator& communicator)
    {
      Rank rank(communicator);
      rank.update(files);
      EXPECT_GT(rank.sent(), 0u);
      const std::size_t before = rank.sent();
      rank.update(files);
      EXPECT_EQ(rank.sent(), before);
      EXPECT_FALSE(granular::is_changed(rank.index, rank.ranks));
      if (communicator.rank() == 0)
      {
        folder.append("a.dump", particles(110, ids_from(7, 2)));
      }
      EXPECT_TRUE(granular::is_changed(rank.index, rank.ranks));
      rank.update(files);
      EXPECT_EQ(rank.index.size(), 45u);
      EXPECT_NE(rank.frames().find("\n110: 7 8\n"), std::string::npos);
      EXPECT_FALSE(granular::is_changed(rank.index, rank.ranks));
    });
}

TEST(IndexRanks, AllHearWhatIsWrong)
{
  const Folder folder;
  const std::string path = folder.write("a.dump", particles(0, { 1, 2 }));
  run_ranks(ranks_of_tests,
    [&](Communicator& communicator)
    {
      Rank rank(communicator);
      rank.update({ path });
      EXPECT_EQ(rank.index.size(), 1u);
      EXPECT_EQ(error_of([&] { rank.update({ folder.path("none") }); }),
        folder.path("none") + ": cannot open: No such file or directory (on rank 0 of 3)");
      EXPECT_EQ(rank.index.size(), 0u);
      rank.update({ path });
      EXPECT_EQ(rank.frames(), "0: 1 2\n");
      EXPECT_NE(error_of([&] { rank.update({}); }), "");
      rank.update({ path });
      EXPECT_EQ(rank.frames(), "0: 1 2\n");
    });
}

TEST(IndexRanks, CancelledOnAll)
{
  const Folder folder;
  const Files files = mixed_run(folder);
  run_ranks(ranks_of_tests,
    [&](Communicator& communicator)
    {
      Rank rank(communicator);
      Notices notices;
      Stop stop(0);
      EXPECT_THROW(granular::update_run_index(rank.index, rank.ranks, files,
                     { .format = &granular::dump_format() }, notices, stop),
        granular::Cancelled);
      EXPECT_EQ(rank.index.size(), 0u);
      rank.update(files);
      EXPECT_EQ(rank.index.size(), 44u);
    });
}

TEST(IndexRanks, ASingleProcessSendsNothing)
{
  const Folder folder;
  const Files files = mixed_run(folder);
  Series alone;
  alone.update(files);
  granular::SerialCommunicator serial;
  Rank rank(serial);
  EXPECT_EQ(rank.update(files), alone.said);
  EXPECT_EQ(rank.sent(), 0u);
  EXPECT_TRUE(rank.index.encode() == alone.index.encode());
  EXPECT_THROW(rank.update({ folder.path("none") }), granular::IoError);
}

TEST(IndexRanks, BytesThatAreNoIndex)
{
  const Folder folder;
  Series alone;
  alone.update(mixed_run(folder));
  const std::string good = alone.index.encode();
  RunIndex index;
  index.decode(good);
  EXPECT_TRUE(index.encode() == good);
  for (std::size_t cut = 0; cut < good.size(); cut += 97)
  {
    EXPECT_THROW(index.decode(good.substr(0, cut)), granular::FormatError) << cut;
  }
  EXPECT_THROW(index.decode(good + "x"), granular::FormatError);
  // places: those of another run
  Series other;
  const std::string path = folder.write("z.dump", particles(0, { 1 }));
  other.update({ path });
  const std::string small = other.index.encode();
  constexpr std::size_t places = 44 * 8 + 16;
  EXPECT_THROW(index.decode(small.substr(0, small.size() - 24) + good.substr(good.size() - places)),
    granular::FormatError);
  EXPECT_TRUE(index.encode() == good) << "what fails changes nothing";
}
