// SPDX-License-Identifier: BSD-3-Clause
// Series of files on disk, as a run writes them and as they change while somebody looks.
#include "granular/frames/run_index.h"

#include "../support/byte_source_packing.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using granular::RunIndex;
using Times = std::vector<double>;

/// A frame of so many particles, whose x is the timestep.
std::string frame(std::int64_t step, int rows = 2)
{
  return particles(step, ids_from(1, rows));
}

std::string at_time(double time, std::int64_t step)
{
  return "ITEM: TIME\n" + std::to_string(time) + "\n" + frame(step, 1);
}
}

// ---- one file, many files ----------------------------------------------------------------------

TEST(RunIndex, TrapRepeatedTimestepsTheLastOneStays)
{
  const Folder folder;
  // restarted at 100, and appended to the same file
  const std::string first = frame(0) + frame(100) + frame(200);
  Series run;
  run.update({ folder.write("a.dump", first + frame(100, 5) + frame(200, 6)) });
  EXPECT_EQ(run.steps(), (Steps{ 0, 100, 200 }));
  EXPECT_EQ(run.read(0).rows(), 2);
  EXPECT_EQ(run.read(1).rows(), 5);
  EXPECT_EQ(run.read(2).rows(), 6);
  // and in several files, in their order
  run.update({ folder.write("1.dump", frame(0, 1) + frame(100, 1)),
    folder.write("2.dump", frame(100, 2) + frame(200, 2)) });
  EXPECT_EQ(run.steps(), (Steps{ 0, 100, 200 }));
  EXPECT_EQ(run.read(1).rows(), 2);
  run.update({ folder.path("2.dump"), folder.path("1.dump") });
  EXPECT_EQ(run.read(1).rows(), 1);
}

TEST(RunIndex, TrapDecreasingAndNegativeTimesteps)
{
  const Folder folder;
  Series run;
  run.update({ folder.write("a.dump",
    frame(500) + frame(0) + frame(-100) + frame(9'000'000'000) + frame(500, 7) + frame(100)) });
  EXPECT_EQ(run.steps(), (Steps{ -100, 0, 100, 500, 9'000'000'000 }));
  EXPECT_EQ(run.read(3).rows(), 7);
}

TEST(RunIndex, UnitsAreOfTheirFile)
{
  const Folder folder;
  Series run;
  run.update({ folder.write("a.dump", "ITEM: UNITS\nsi\n" + frame(0) + frame(100)),
    folder.write("b.dump", frame(200)) });
  EXPECT_EQ(run.entry(0).kind->units, "si");
  EXPECT_EQ(run.entry(1).kind->units, "si");
  EXPECT_EQ(run.entry(2).kind->units, "");
}

// ---- time --------------------------------------------------------------------------------------

TEST(RunIndex, TrapTimeIsTheTimestepTimesItsSize)
{
  const Folder folder;
  Series run;
  run.update({ folder.write("a.dump", frame(0) + frame(100) + frame(250)) });
  EXPECT_EQ(run.index.times(1), (Times{ 0, 100, 250 }));
  EXPECT_EQ(run.index.times(0.5), (Times{ 0, 50, 125 }));
}

TEST(RunIndex, TimeOfTheHeadersIfEveryFrameHasOneAndTheyIncrease)
{
  const Folder folder;
  const auto times = [&](const std::string& text)
  {
    Series run;
    run.update({ folder.write("a.dump", text) });
    return run.index.times(2);
  };
  EXPECT_EQ(times(at_time(0.25, 0) + at_time(0.5, 100)), (Times{ 0.25, 0.5 }));
  EXPECT_EQ(times(at_time(0.25, 0) + frame(100)), (Times{ 0, 200 }));
  EXPECT_EQ(times(frame(0) + at_time(0.25, 100)), (Times{ 0, 200 }));
  EXPECT_EQ(times(at_time(0.5, 0) + at_time(0.5, 100)), (Times{ 0, 200 }));
  EXPECT_EQ(times(at_time(0.5, 0) + at_time(0.25, 100)), (Times{ 0, 200 }));
  EXPECT_EQ(times(at_time(-1.5, 0) + at_time(0, 100)), (Times{ -1.5, 0 }));
  // the frames that stay decide: the first one of step 100 has a later time
  EXPECT_EQ(
    times(at_time(0, 0) + at_time(9, 100) + at_time(1, 100) + at_time(2, 200)), (Times{ 0, 1, 2 }));
}

TEST(RunIndex, TimesThatAreNoNumbersAreNotTaken)
{
  const Folder folder;
  for (const double time : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    Series run;
    run.update({ folder.write("a.dump", at_time(time, 3)) });
    EXPECT_EQ(run.index.times(2), Times{ 6 });
  }
}

TEST(RunIndex, FindsTheLastFrameAtOrBeforeATime)
{
  const Times times = { 0, 1, 2.5 };
  EXPECT_EQ(RunIndex::find(times, -1), 0u);
  EXPECT_EQ(RunIndex::find(times, 0), 0u);
  EXPECT_EQ(RunIndex::find(times, 0.999), 0u);
  EXPECT_EQ(RunIndex::find(times, 1), 1u);
  EXPECT_EQ(RunIndex::find(times, 2.49), 1u);
  EXPECT_EQ(RunIndex::find(times, 2.5), 2u);
  EXPECT_EQ(RunIndex::find(times, 1e300), 2u);
  EXPECT_EQ(RunIndex::find({}, 1), 0u);
}

// ---- files that change -------------------------------------------------------------------------

TEST(RunIndex, SaysWhatItLeavesOutOnce)
{
  const Folder folder;
  const std::string path = folder.write("a.dump", frame(0) + "garbage\n" + frame(100));
  Series run;
  run.update({ path });
  EXPECT_EQ(run.said, path + ":1: expected 2 rows, got 3; the frame is left out\n");
  run.update({ path });
  EXPECT_EQ(run.said, "");
  folder.append("a.dump", frame(200));
  run.update({ path });
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(run.steps(), (Steps{ 100, 200 }));
}

TEST(RunIndex, AFileThatWasShortenedIsReadAnew)
{
  const Folder folder;
  const std::string path = folder.write("a.dump", frame(0) + frame(100) + frame(200));
  Series run;
  run.update({ path });
  fs::resize_file(path, frame(0).size() + 20);
  run.update({ path });
  EXPECT_EQ(run.steps(), Steps{ 0 });
  folder.append("a.dump", frame(100).substr(20));
  run.update({ path });
  EXPECT_EQ(run.steps(), (Steps{ 0, 100 }));
}

TEST(RunIndex, AFileThatWasWrittenAnewIsReadAnew)
{
  const Folder folder;
  const std::string path = folder.write("a.dump", frame(0) + frame(100));
  Series run;
  run.update({ path });
  // a new file of that name: the same size, and the same time of change
  const std::string other =
    folder.write("b.dump", frame(8, 7) + frame(9) + frame(10, 1) + "            ");
  fs::resize_file(other, fs::file_size(path));
  fs::last_write_time(other, fs::last_write_time(path));
  fs::rename(other, path);
  run.update({ path });
  EXPECT_EQ(run.steps()[0], 8);
}

TEST(RunIndex, AFileThatDidNotChangeIsNotRead)
{
  const Folder folder;
  const std::string path = folder.write("a.dump", frame(100) + frame(200));
  Series run;
  run.update({ path });
  // other bytes behind the same stamp: only a reader would see them
  const auto time = fs::last_write_time(path);
  folder.write("a.dump", frame(300) + frame(400));
  fs::last_write_time(path, time);
  run.update({ path });
  EXPECT_EQ(run.steps(), (Steps{ 100, 200 }));
}

TEST(RunIndex, ACopyReadsWhileTheFileGrows)
{
  const Folder folder;
  const auto packed = [](std::int64_t from, std::int64_t to)
  {
    std::string members;
    for (std::int64_t step = from; step < to; ++step)
    {
      members += packing::gzip(particles(step, ids_from(1, 40'000)));
    }
    return members;
  };
  const std::string path = folder.write("a.dump.gz", packed(0, 3));
  Series run;
  run.update({ path });
  const Series copy = run;
  const std::size_t points = copy.index.files()[0].points->points.size();
  ASSERT_GT(points, 0u);
  folder.append("a.dump.gz", packed(3, 5));
  run.update({ path });
  EXPECT_EQ(run.steps(), (Steps{ 0, 1, 2, 3, 4 }));
  EXPECT_GT(run.index.files()[0].points->points.size(), points);
  EXPECT_EQ(copy.index.files()[0].points->points.size(), points);
  EXPECT_EQ(copy.read(2).points()[0], 2);
  EXPECT_EQ(run.read(4).points()[0], 4);
}

TEST(RunIndex, WhatIsWrongAtTheEndIsSaidOnceWhileTheFileGrows)
{
  const Folder folder;
  const std::string bad = "ITEM: TIMESTEP\nx\n";
  const std::string path = folder.write("a.dump", frame(0) + bad + "ITEM: TIMESTEP\n");
  Series run;
  run.update({ path });
  EXPECT_NE(run.said.find("got 'x'; the frame is left out"), std::string::npos) << run.said;
  for (int i = 0; i < 5; ++i)
  {
    folder.append("a.dump", i == 0 ? "10\n" : "\n");
    run.update({ path });
    EXPECT_EQ(run.said, "") << i;
    EXPECT_EQ(run.index.files()[0].notices.size(), 1u) << i;
  }
}

// ---- what is no dump ---------------------------------------------------------------------------

TEST(RunIndex, ErrorsSayWhatIsWrongWithTheFirstFile)
{
  const Folder folder;
  const auto error = [](const std::string& path)
  {
    Series run;
    return error_of([&] { run.update({ path }); });
  };
  EXPECT_EQ(error_of([] { Series().update({}); }), "expected the name of a file, got none");
  Series without;
  without.options.format = nullptr;
  EXPECT_EQ(error_of([&] { without.update({ "a" }); }),
    "expected the format of the files in the options, got none");
  const std::string blank = folder.write("blank", "\n \n");
  EXPECT_EQ(error(blank), blank + ": expected a dump, got no complete frame");
  const std::string garbage = folder.write("garbage",
    "\x7f"
    "ELF\x02\x01\n");
  EXPECT_EQ(
    error(garbage), garbage + "@0: expected a complete frame, got the end of the file in it");
  const std::string zeros = folder.write("zeros", std::string(5'000'000, '\0'));
  EXPECT_EQ(error(zeros),
    zeros + "@92: expected 1 to 5000 columns, got 0; no known layout of a binary dump fits");
  const std::string one_line = folder.write("one", std::string(1000, 'x'));
  EXPECT_EQ(error(one_line), one_line + ": expected a dump, got no complete frame");
}

// ---- rewritten in place ------------------------------------------------------------------------

TEST(RunIndex, ARerunThatGrewWithTheSameFirstHeader)
{
  const Folder folder;
  const std::string path = folder.write("a.dump", frame(0));
  Series run;
  run.update({ path });
  // the same header, rows of another length, and more frames behind
  folder.write("a.dump", replaced(frame(0), "0.25\n", "0.125\n") + frame(100) + frame(200));
  touch(path, 1);
  run.update({ path });
  EXPECT_EQ(run.steps(), (Steps{ 0, 100, 200 }));
  EXPECT_EQ(run.read(0).points()[2], 0.125);
  EXPECT_EQ(run.said, "");
}

// ---- what is said of a series ------------------------------------------------------------------

TEST(RunIndex, TimesThatCannotBeUsedAreSaid)
{
  const Folder folder;
  const auto said = [](const std::string& got)
  {
    return ": expected an increasing ITEM: TIME in every frame, got " + got +
      "; times are timestep x TimestepSize\n";
  };
  Series run;
  const std::string some = folder.write("some.dump", at_time(1, 0) + frame(10));
  run.update({ some });
  EXPECT_EQ(run.said, some + said("frames without"));
  const std::string back = folder.write("back.dump", at_time(1, 0) + at_time(0.5, 10));
  run.update({ back });
  EXPECT_EQ(run.said, back + said("one that does not increase"));
  EXPECT_EQ(run.index.times(2), (Times{ 0, 20 }));
}
