// SPDX-License-Identifier: BSD-3-Clause
// A frame that ranks read together: each its part, the same notices and the same errors on all.
#include "../support/binary_dumps.h"
#include "../support/dumps.h"
#include "../support/frame_content.h"
#include "../support/series.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
using granular::Communicator;
using granular::FramePiece;
using granular::Notices;
using granular::Progress;
using granular::Request;

/// Stops when it should.
class Stop final : public Progress
{
public:
  bool report(double) override { return !stop; }

  bool stop = false;
};

/// One rank's reading.
Outcome read_rank(
  const std::vector<FramePiece>& pieces, Request request, Communicator& ranks, bool stop)
{
  request.piece = ranks.rank();
  request.pieces = ranks.size();
  return outcome_of(
    [&](const Request& own, Notices& notices)
    {
      Stop progress;
      progress.stop = stop;
      return read_dump(pieces, own, ranks, notices, progress);
    },
    request);
}

/// Parts of all ranks, put together. Notices and errors must be the same on all.
Outcome read_together(
  const std::vector<FramePiece>& pieces, const Request& request, int size, int stopped_rank = -1)
{
  std::vector<Outcome> outcomes(static_cast<std::size_t>(size));
  run_ranks(size,
    [&](Communicator& ranks)
    {
      outcomes[static_cast<std::size_t>(ranks.rank())] =
        read_rank(pieces, request, ranks, ranks.rank() == stopped_rank);
    });
  Outcome all = outcomes.front();
  for (std::size_t rank = 1; rank < outcomes.size(); ++rank)
  {
    EXPECT_EQ(outcomes[rank].said, all.said);
    EXPECT_EQ(outcomes[rank].error, all.error);
    if (all.error.empty())
    {
      all.content.append(outcomes[rank].content);
    }
  }
  return all;
}

/// The same as one process reads, for any number of ranks.
void expect_same_on_ranks(const Series& series, std::size_t frame = 0)
{
  const std::vector<FramePiece> pieces = series.index.pieces(frame);
  for (const Request& request : all_requests())
  {
    const Outcome whole = outcome_of(
      [&](const Request& own, Notices& notices)
      {
        Progress progress;
        return read_dump(pieces, own, notices, progress);
      },
      plainly(request));
    for (int size = 1; size <= 5; ++size)
    {
      const Request small = in_chunks(request, 1 + size % 3, 700);
      EXPECT_EQ(read_together(pieces, small, size).difference(whole), "") << size << " ranks";
    }
  }
}

Series index_of(const Files& files)
{
  Series series;
  series.update(files);
  return series;
}

/// Rows "id type x y z state", of which some are others.
std::string rows_with(const std::vector<std::pair<int, std::string>>& others)
{
  std::string rows;
  for (int row = 0; row < 90; ++row)
  {
    std::string line = std::to_string(89 - row) + " 1 0." + std::to_string(row) + " 0.5 0.75 " +
      std::to_string(row % 3);
    for (const auto& [at, other] : others)
    {
      line = at == row ? other : line;
    }
    rows += line + "\n";
  }
  return one_frame("id type x y z state", rows);
}
}

TEST(FrameRanks, RealFiles)
{
  const std::string good = std::string(GRANULAR_DATA) + "/good/";
  expect_same_on_ranks(index_of({ good + "grains_1000.dump" }));
  expect_same_on_ranks(index_of({ good + "ortho_custom.bin" }), 1);
  expect_same_on_ranks(index_of({ good + "tri_000100.dump.gz" }));
}

TEST(FrameRanks, RealPieces)
{
  Files files;
  for (const char* const process : { "0", "1", "2", "3" })
  {
    files.push_back(std::string(GRANULAR_DATA) + "/good/pieces_2000." + process + ".dump");
  }
  expect_same_on_ranks(index_of(files));
}

/// What one rank alone sees changes the columns of all, in the order of the rows.
TEST(FrameRanks, ColumnsAreWidenedOnAll)
{
  const Folder folder;
  for (const int row : { 0, 40, 89 })
  {
    expect_same_on_ranks(
      index_of({ folder.write("one.dump", rows_with({ { row, "1000 2.5 0 0 0 1" } })) }));
  }
  expect_same_on_ranks(index_of({ folder.write("several.dump",
    rows_with(
      { { 88, "1001 2.5 0 0 0 1" }, { 3, "1002 1 0 0 0 wet" }, { 50, "1003 3.5 0 0 0 dry" } })) }));
}

TEST(FrameRanks, NoticesOfEachAreThereOnce)
{
  const Folder folder;
  const Series series = index_of({ folder.write(
    "a.dump", rows_with({ { 0, "1000 1.5 0 0 0 1" }, { 80, "1002 2.5 0 0 0 1" } })) });
  expect_same_on_ranks(series);
  const Outcome outcome = read_together(series.index.pieces(0), {}, 3);
  EXPECT_EQ(outcome.said,
    folder.path("a.dump") +
      ":10: column 'type': expected an integer, got '1.5'; the column is kept as doubles\n");
}

TEST(FrameRanks, AnErrorOfOneIsThatOfAll)
{
  const Folder folder;
  const std::string path =
    folder.write("a.dump", rows_with({ { 45, "420 1 0 zero 0 1" }, { 85, "1.5 1 0 0 0 1" } }));
  const Series series = index_of({ path });
  const std::string said = path + ":55: column 'y': expected a number, got 'zero'";
  for (const Request& request : { Request{}, all_requests()[3] })
  {
    EXPECT_EQ(read_together(series.index.pieces(0), request, 1).error, said);
    EXPECT_EQ(read_together(series.index.pieces(0), request, 3).error, said + " (on rank 1 of 3)");
  }
}

TEST(FrameRanks, OneThatIsStoppedStopsAll)
{
  const Folder folder;
  const Series series = index_of({ folder.write("a.dump", rows_with({})) });
  for (const int rank : { 0, 1, 2 })
  {
    EXPECT_EQ(read_together(series.index.pieces(0), {}, 3, rank).error, "cancelled");
  }
}

/// No rank sees all rows of the frame, but all of them do.
TEST(FrameRanks, RowsThatAreMissingAreMissed)
{
  const Folder folder;
  std::string text = header(5, 1200);
  for (int row = 0; row < 1200; ++row)
  {
    text += std::to_string(1000 + row) + " 0.5 0.5 0.5\n" + (row == 600 ? "             \n" : "");
  }
  const std::string path = folder.write("a.dump", text);
  const Series series = index_of({ path });
  // behind the back of the index, which looks at both ends of a file
  folder.write("a.dump", replaced(text, "\n1500 0.5 0.5 0.5\n", "\n                \n"));
  EXPECT_EQ(
    read_together(series.index.pieces(0), {}, 1).error, path + ":1: expected 1200 rows, got 1199");
  EXPECT_EQ(
    read_together(series.index.pieces(0), {}, 3).error, path + ":1: expected 1200 rows, got 1199");
  folder.write("a.dump", replaced(text, "\n             \n", "\n17 0.5 0.5 .5\n"));
  EXPECT_EQ(
    read_together(series.index.pieces(0), {}, 3).error, path + ":1: expected 1200 rows, got more");
}
