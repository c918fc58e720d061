// SPDX-License-Identifier: BSD-3-Clause
// Runs in many files: what `*` and `%` in the name of a dump write, restarts, and what lies beside.
#include "granular/frames/run_index.h"

#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/frame_content.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using granular::RepeatedSteps;

/// What is said where no frame of a file is shown, nor of others: a later one is shown instead.
std::string hidden(const std::string& first_file, const std::string& shown, int others = 0)
{
  return first_file + ": no frame of this file" +
    (others > 0 ? ", and of " + std::to_string(others) + " more," : "") +
    " is shown: later files have the same timesteps, such as " + shown +
    "; leave out files of other runs, or, if these are pieces of one run, set RepeatedSteps to "
    "Merge\n";
}

/// What is said of a frame that lacks pieces; none is " (none for 1 2)" or nothing.
std::string lacking(const std::string& first_file, int expected, std::int64_t step, int got,
  const std::string& none = "")
{
  return first_file + ":1: expected " + std::to_string(expected) + " pieces of timestep " +
    std::to_string(step) + ", got " + std::to_string(got) + none + "; the frame is left out\n";
}

void shuffle(Files& files, unsigned seed = 1)
{
  std::minstd_rand random(seed);
  std::shuffle(files.begin(), files.end(), random);
}

const Steps tens = { 0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100 };

/// Frames of the same particles at these steps.
std::string frames_of(const Steps& steps, const Ids& ids)
{
  std::string text;
  for (const std::int64_t step : steps)
  {
    text += particles(step, ids);
  }
  return text;
}

/// A frame less the last bytes of its last row: its writer is at work.
std::string unfinished(const std::string& frame)
{
  return frame.substr(0, frame.size() - 4);
}

/// A frame less its last row: its writer was killed.
std::string less_a_row(const std::string& frame)
{
  return frame.substr(0, frame.rfind('\n', frame.size() - 2) + 1);
}

/// Files of one process each, at every step: two particles a process, whose ids begin with 10 x process.
Files write_pieces(const Folder& folder, const std::string& before, const Steps& steps,
  int processes, const std::string& after = ".dump")
{
  Files files;
  for (const std::int64_t step : steps)
  {
    for (int process = 0; process < processes; ++process)
    {
      const std::string name =
        before + std::to_string(step) + "." + std::to_string(process) + after;
      files.push_back(folder.write(name, particles(step, ids_from(10 * process, 2))));
    }
  }
  return files;
}

/// The ids of such a frame.
Ids ids_of_pieces(int processes)
{
  Ids ids;
  for (int process = 0; process < processes; ++process)
  {
    ids.push_back(10 * process);
    ids.push_back(10 * process + 1);
  }
  return ids;
}

/// All of every frame, never a part.
void expect_all_pieces(const Series& run, int processes, const std::string& what = "")
{
  for (std::size_t i = 0; i < run.index.size(); ++i)
  {
    EXPECT_EQ(run.ids(i), ids_of_pieces(processes)) << what << ", step " << run.steps()[i];
  }
}
}

// ---- one file a step ---------------------------------------------------------------------------

TEST(FileSeries, TheNumberMayBeAnywhereInTheName)
{
  const Folder folder;
  const Steps steps = { 0, 5, 50, 100, 1000, 9999, 10000, 20000 };
  for (const std::string name : { "run3_dump.*.lammpstrj", "*.dump", "dump.*", "*", "dump*",
         "dump_*_300K.bin", "2024-11-21_*.liggghts", "pour.2.*.dump", "*.dump.3" })
  {
    for (const bool padded : { false, true })
    {
      Files files;
      for (const std::int64_t step : steps)
      {
        const std::string digits = std::to_string(step);
        const std::string zeros(padded ? 8 - digits.size() : 0, '0');
        files.push_back(
          folder.write(replaced(name, "*", zeros + digits), particles(step, { step })));
      }
      shuffle(files);
      Series run;
      run.update(files);
      ASSERT_EQ(run.steps(), steps) << name;
      EXPECT_EQ(run.said, "") << name;
      for (std::size_t i = 0; i < steps.size(); ++i)
      {
        EXPECT_EQ(run.index.pieces(i).size(), 1u) << name;
        EXPECT_EQ(run.ids(i), (Ids{ steps[i] })) << name;
      }
    }
  }
}

TEST(FileSeries, NumbersThatGoTogetherAreOneFileAStep)
{
  // step and time, step and date: each number has a value of its own in every file
  const Folder folder;
  Files files;
  Steps steps;
  for (int i = 0; i < 500; ++i)
  {
    const std::string name = "t" + std::to_string(i / 10) + "." + std::to_string(i % 10) + "_step" +
      std::to_string(100 * i) + ".dump";
    files.push_back(folder.write(name, particles(100 * i, { 1 })));
    steps.push_back(100 * i);
  }
  shuffle(files);
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), steps);
  EXPECT_EQ(run.said, "");
}

TEST(FileSeries, AFewFramesAFile)
{
  const Folder folder;
  // each begins with the frame that the one before ended with
  Series run;
  run.update({ folder.write("a.0.dump", frames_of({ 0, 10, 20 }, { 1 })),
    folder.write("a.20.dump", frames_of({ 20, 30, 40 }, { 2 })),
    folder.write("a.40.dump", frames_of({ 40, 50, 60 }, { 3 })) });
  EXPECT_EQ(run.steps(), (Steps{ 0, 10, 20, 30, 40, 50, 60 }));
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(run.names(2), "a.20.dump");
  EXPECT_EQ(run.ids(2), Ids{ 2 });
  EXPECT_EQ(run.ids(4), Ids{ 3 });
  // and steps that interleave
  run.update({ folder.write("even.dump", frames_of({ 0, 20, 40 }, { 1 })),
    folder.write("odd.dump", frames_of({ 10, 30, 50 }, { 2 })) });
  EXPECT_EQ(run.steps(), (Steps{ 0, 10, 20, 30, 40, 50 }));
  EXPECT_EQ(run.ids(4), Ids{ 1 });
  EXPECT_EQ(run.ids(5), Ids{ 2 });
}

TEST(FileSeries, PlainAndCompressedFilesOfOneRun)
{
  const Folder folder;
  // old files were compressed to save room, two of them without a fitting name
  const Files files = { folder.write("dump.0.gz", packing::gzip(particles(0, { 1 }))),
    folder.write("dump.100.zst", packing::zstd(particles(100, { 2 }))),
    folder.write("dump.200", particles(200, { 3 })),
    folder.write("dump.300", packing::gzip(particles(300, { 4 }))),
    folder.write(
      "dump.400.zst", packing::gzip(particles(400, { 5 })) + packing::gzip(particles(500, { 6 }))),
    folder.write("dump.600.gz", particles(600, { 7 })) };
  Series run;
  run.update(files);
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(run.steps(), (Steps{ 0, 100, 200, 300, 400, 500, 600 }));
  for (std::size_t i = 0; i < run.steps().size(); ++i)
  {
    EXPECT_EQ(run.ids(i), Ids{ static_cast<std::int64_t>(i) + 1 });
  }
}

TEST(FileSeries, TheSameFilePlainAndCompressedCountsOnce)
{
  const Folder folder;
  const std::string plain = folder.write("dump.0.lammpstrj", particles(0, { 1, 2 }));
  const std::string packed =
    folder.write("dump.0.lammpstrj.gz", packing::gzip(particles(0, { 1, 2 })));
  const std::string other = folder.write("dump.100.lammpstrj", particles(100, { 1, 2 }));
  Series run;
  run.update({ plain, packed, other });
  EXPECT_EQ(run.steps(), (Steps{ 0, 100 }));
  EXPECT_EQ(run.ids(0), (Ids{ 1, 2 }));
  EXPECT_EQ(run.said, hidden(plain, packed));
  // and of pieces
  Files files = write_pieces(folder, "p.", { 0, 100 }, 2);
  files.push_back(folder.write("p.0.0.dump.gz", packing::gzip(particles(0, { 0, 1 }))));
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    shuffle(files, seed);
    run.update(files);
    EXPECT_EQ(run.steps(), (Steps{ 0, 100 }));
    EXPECT_EQ(run.ids(0), ids_of_pieces(2));
    EXPECT_EQ(run.ids(1), ids_of_pieces(2));
  }
}

TEST(FileSeries, BoundingBoxesAreNoFrames)
{
  const Folder folder;
  const std::string box = particles(100, { 1, 2, 3, 4, 5, 6, 7, 8 });
  const Files files = { folder.write("dump100.stl", particles(100, { 1 })),
    folder.write("dump100_boundingBox.vtk", box),
    folder.write("dump200.stl", particles(200, { 1 })),
    folder.write("dump200_boundingBox.vtk", "# vtk DataFile Version 2.0\n") };
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 100, 200 }));
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(run.index.files().size(), 2u);
  // a folder of that name is no matter
  fs::create_directory(folder.path("boundingBox"));
  run.update({ folder.write("boundingBox/dump100.stl", particles(100, { 1 })), files[2] });
  EXPECT_EQ(run.steps(), (Steps{ 100, 200 }));
  // where there is nothing else they are looked at as any file is
  run.update({ files[1] });
  EXPECT_EQ(run.steps(), Steps{ 100 });
  EXPECT_EQ(error_of([&] { run.update({ files[3] }); }),
    files[3] +
      ": expected a dump, got a VTK file: GranularVTKParticleReader opens particles in it, and "
      "GranularMeshReader walls, "
      "under a name like NAME.vtk");
}

TEST(FileSeries, OneOfThreeFilesIsNoDump)
{
  const Folder folder;
  const std::string first = folder.write("dump.0", particles(0, { 1 }));
  const std::string last = folder.write("dump.200", particles(200, { 3 }));
  const std::string path = folder.path("dump.100");
  const std::string gz = packing::gzip(packing::rows(100000) + particles(100, { 2 }));
  struct Case
  {
    std::string bytes;
    std::string said;
  };
  const Case cases[] = {
    { "", "" }, // its writer has opened it
    { unfinished(particles(100, { 2 })), "" },
    { "no dump\n",
      ":1: expected ITEM: TIMESTEP, UNITS or TIME, got 'no dump'; the file is left out\n" },
    { gz.substr(0, gz.size() / 2) + "damage" + gz.substr(gz.size() / 2), "left out\n" },
  };
  for (const Case& one : cases)
  {
    folder.write("dump.100", one.bytes);
    Series run;
    run.update({ first, path, last });
    EXPECT_EQ(run.steps(), (Steps{ 0, 200 })) << one.bytes.substr(0, 20);
    EXPECT_EQ(run.said.substr(0, path.size()), one.said.empty() ? "" : path);
    EXPECT_TRUE(run.said.ends_with(one.said)) << run.said;
    EXPECT_LE(std::count(run.said.begin(), run.said.end(), '\n'), 1) << run.said;
    EXPECT_EQ(run.ids(1), Ids{ 3 });
    // and when it is good
    folder.write("dump.100", particles(100, { 2 }) + "\n");
    run.update({ first, path, last });
    EXPECT_EQ(run.steps(), (Steps{ 0, 100, 200 }));
    EXPECT_EQ(run.said, "");
  }
}

// ---- restarts ----------------------------------------------------------------------------------

TEST(FileSeries, ARestartRepeatsTheStepItStartsFrom)
{
  for (int number = 0; number < 3; ++number)
  {
    const Folder folder;
    const std::string first = "run" + std::to_string(number) + "_";
    const std::string second = "run" + std::to_string(number + 1) + "_";
    Files files;
    for (const int step : { 0, 500, 1000 })
    {
      files.push_back(folder.write(first + std::to_string(step), particles(step, { 1 })));
    }
    for (const int step : { 1000, 1500, 2000 })
    {
      files.push_back(folder.write(second + std::to_string(step), particles(step, { 2 })));
    }
    Series run;
    run.update(files);
    EXPECT_EQ(run.steps(), (Steps{ 0, 500, 1000, 1500, 2000 }));
    EXPECT_EQ(run.names(2), second + "1000");
    EXPECT_EQ(run.ids(2), Ids{ 2 });
    EXPECT_EQ(run.said, hidden(folder.path(first + "1000"), folder.path(second + "1000")));
    // as a shell lists them
    std::ranges::sort(files);
    run.update(files);
    EXPECT_EQ(run.names(2), second + "1000");
  }
}

TEST(FileSeries, ARestartOfManyFramesAFile)
{
  const Steps before(tens.begin(), tens.begin() + 6);
  for (int number = 0; number < 3; ++number)
  {
    const Folder folder;
    const std::string first = "run." + std::to_string(number) + ".dump";
    const std::string second = "run." + std::to_string(number + 1) + ".dump";
    Series run;
    // goes on from the last frame, from an earlier one, from one that the first run did not dump
    for (const std::int64_t from : { 50, 30, 10, 60 })
    {
      const Steps after(tens.begin() + from / 10, tens.end());
      run.update({ folder.write(first, frames_of(before, { 1 })),
        folder.write(second, frames_of(after, { 2 })) });
      ASSERT_EQ(run.index.size(), 11u) << from;
      EXPECT_EQ(run.said, "");
      for (std::size_t i = 0; i < 11; ++i)
      {
        EXPECT_EQ(run.ids(i), Ids{ 10 * static_cast<std::int64_t>(i) < from ? 1 : 2 }) << from;
      }
    }
  }
}

TEST(FileSeries, ARestartWithMostOfTheStepsAgain)
{
  // a file a step; the second run goes on from an early step, and repeats most of them
  for (int number = 0; number < 3; ++number)
  {
    const Folder folder;
    Files files;
    for (int step = 0; step <= 1000; step += 100)
    {
      files.push_back(folder.write(
        "run" + std::to_string(number) + "_" + std::to_string(step), particles(step, { 1 })));
    }
    for (int step = 200; step <= 1000; step += 100)
    {
      files.push_back(folder.write(
        "run" + std::to_string(number + 1) + "_" + std::to_string(step), particles(step, { 2 })));
    }
    Series run;
    run.update(files);
    ASSERT_EQ(run.index.size(), 11u) << number;
    for (std::size_t i = 0; i < 11; ++i)
    {
      EXPECT_EQ(run.ids(i), Ids{ i < 2 ? 1 : 2 }) << "run" << number << ", frame " << i;
    }
  }
}

TEST(FileSeries, ARunThatBeganAgain)
{
  // from its first step on, under another number, and has come further; its number is not 0
  const Folder folder;
  Series run;
  run.update({ folder.write("run.1.dump", frames_of(Steps(tens.begin(), tens.begin() + 6), { 1 })),
    folder.write("run.2.dump", frames_of(tens, { 2 })) });
  ASSERT_EQ(run.index.size(), 11u);
  for (std::size_t i = 0; i < 11; ++i)
  {
    EXPECT_EQ(run.ids(i), Ids{ 2 });
  }
  EXPECT_EQ(run.said, hidden(folder.path("run.1.dump"), folder.path("run.2.dump")));
}

TEST(FileSeries, NumbersThatDifferInTheirZerosAloneAreTheSame)
{
  const Folder folder;
  const std::string plain = folder.write("a_1.dump", particles(10, { 1 }));
  const std::string padded = folder.write("a_01.dump", particles(10, { 2 }));
  Series run;
  run.update({ padded, plain });
  EXPECT_EQ(run.steps(), Steps{ 10 });
  EXPECT_EQ(run.ids(0), Ids{ 1 });
  EXPECT_EQ(run.said, hidden(padded, plain));
  run.update({ plain, padded });
  EXPECT_EQ(run.ids(0), Ids{ 2 });
}

TEST(FileSeries, RunsInFoldersOfTheirOwnAreNoPieces)
{
  const Folder folder;
  fs::create_directory(folder.path("run1"));
  fs::create_directory(folder.path("run2"));
  const std::string first = folder.write("run1/dump.0", particles(0, { 1 }));
  const std::string second = folder.write("run2/dump.0", particles(0, { 2 }));
  Series run;
  run.update({ first, second });
  EXPECT_EQ(run.steps(), Steps{ 0 });
  EXPECT_EQ(run.ids(0), Ids{ 2 });
  EXPECT_EQ(run.said, hidden(first, second));
  // but they are pieces if somebody says so
  run.options.repeated_steps = RepeatedSteps::Merge;
  run.update({ first, second });
  EXPECT_EQ(run.ids(0), (Ids{ 1, 2 }));
  EXPECT_EQ(run.said, "");
}

TEST(FileSeries, OtherBoxesOrColumnsAreOtherRuns)
{
  const Folder folder;
  const std::string first = folder.write("a.0.dump", particles(10, { 1 }));
  Series run;
  for (const std::string& other : { particles(10, { 2 }, "0 2"),
         header(10, 1, "id z y x") + "2 0 0 0\n", header(10, 1, "id x y z fx") + "2 0 0 0 0\n",
         replaced(particles(10, { 2 }), "pp pp pp", "pp pp ff"), particles(20, { 2 }) })
  {
    run.update({ first, folder.write("a.1.dump", other) });
    EXPECT_EQ(run.index.pieces(run.index.size() - 1).size(), 1u) << other;
    EXPECT_EQ(run.ids(run.index.size() - 1), Ids{ 2 }) << other;
  }
  // and when they are merged nevertheless the reader says why it does not
  run.options.repeated_steps = RepeatedSteps::Merge;
  run.update({ first, folder.write("a.1.dump", particles(10, { 2 }, "0 2")) });
  EXPECT_EQ(error_of([&] { run.read(0); }),
    folder.path("a.1.dump") + ":1: expected a piece of the same frame, got one with another box");
  run.update({ first, folder.write("a.1.dump", header(10, 1, "id z y x") + "2 0 0 0\n") });
  EXPECT_EQ(error_of([&] { run.read(0); }),
    folder.path("a.1.dump") +
      ":1: expected a piece of the same frame, got one with the columns id z y x");
}

// ---- pieces: which files they are --------------------------------------------------------------

TEST(Pieces, OfOneStepAFileAreMergedInTheOrderOfTheProcesses)
{
  const Folder folder;
  constexpr int processes = 12; // so that 10 and 11 come after 9
  const Steps steps = { 0, 500, 1000 };
  for (const std::string name :
    { "dump.%.*", "p%_dump.*.lammpstrj", "*.%", "run7_%_*.dump", "dump_*_%", "%_300K_*.dump" })
  {
    for (const bool padded : { false, true })
    {
      Files files;
      for (const std::int64_t step : steps)
      {
        for (int process = 0; process < processes; ++process)
        {
          const std::string digits = (padded && process < 10 ? "0" : "") + std::to_string(process);
          const std::string path = replaced(replaced(name, "%", digits), "*", std::to_string(step));
          files.push_back(folder.write(path, particles(step, ids_from(10 * process, 2))));
        }
      }
      shuffle(files);
      Series run;
      run.update(files);
      ASSERT_EQ(run.steps(), steps) << name;
      EXPECT_EQ(run.said, "") << name;
      for (std::size_t i = 0; i < steps.size(); ++i)
      {
        EXPECT_EQ(run.ids(i), ids_of_pieces(processes)) << name;
        EXPECT_EQ(run.read(i).frame.header.rows, 2 * processes);
        EXPECT_EQ(run.read(i).points()[0], static_cast<double>(steps[i]));
      }
    }
  }
}

TEST(Pieces, OfManyFramesAFileAreMerged)
{
  const Folder folder;
  Files files;
  for (const int process : { 3, 0, 2, 1 })
  {
    files.push_back(folder.write("pieces." + std::to_string(process) + ".dump",
      frames_of({ 0, 10, 20 }, ids_from(10 * process, 2))));
  }
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 10, 20 }));
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(run.names(1), "pieces.0.dump pieces.1.dump pieces.2.dump pieces.3.dump");
  expect_all_pieces(run, 4);
}

TEST(Pieces, MayBeCompressedInPart)
{
  const Folder folder;
  Series run;
  for (const bool many_frames : { false, true })
  {
    const std::string more = many_frames ? particles(10, { 9 }) : "";
    run.update({ folder.write("a.2.dump.zst", packing::zstd(particles(0, { 3 }) + more)),
      folder.write("a.0.dump.gz", packing::gzip(particles(0, { 1 }) + more)),
      folder.write("a.1.dump", particles(0, { 2 }) + more) });
    EXPECT_EQ(run.ids(0), (Ids{ 1, 2, 3 }));
    EXPECT_EQ(run.said, "");
    EXPECT_EQ(run.index.size(), many_frames ? 2u : 1u);
  }
}

TEST(Pieces, MayBeEmpty)
{
  const Folder folder;
  Series run;
  // no process has a particle yet; the first one alone; the last one alone
  run.update({ folder.write("d.0.0", particles(0, {})), folder.write("d.0.1", particles(0, {})),
    folder.write("d.0.2", particles(0, {})), folder.write("d.5.0", particles(5, { 4, 2 })),
    folder.write("d.5.1", particles(5, {})), folder.write("d.5.2", particles(5, {})),
    folder.write("d.9.0", particles(9, {})), folder.write("d.9.1", particles(9, {})),
    folder.write("d.9.2", particles(9, { 7 })) });
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(run.steps(), (Steps{ 0, 5, 9 }));
  EXPECT_EQ(run.read(0).rows(), 0);
  EXPECT_EQ(run.ids(1), (Ids{ 4, 2 }));
  EXPECT_EQ(run.ids(2), Ids{ 7 });
  EXPECT_EQ(run.index.pieces(2).size(), 3u);
}

TEST(Pieces, FourThousandOfAFrame)
{
  const Folder folder;
  Files files;
  Ids ids;
  for (int process = 0; process < 4096; ++process)
  {
    files.push_back(folder.write("dump.7." + std::to_string(process), particles(7, { process })));
    ids.push_back(process);
  }
  shuffle(files);
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), Steps{ 7 });
  EXPECT_EQ(run.ids(0), ids);
  EXPECT_EQ(run.said, "");
}

TEST(Pieces, OfTwoRunsOneAfterTheOther)
{
  const Folder folder;
  // a restart: step 20 twice, four pieces each
  Files files = write_pieces(folder, "run1.", { 0, 10, 20 }, 4);
  std::ranges::copy(write_pieces(folder, "run2.", { 20, 30 }, 4), std::back_inserter(files));
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 10, 20, 30 }));
  EXPECT_EQ(run.names(2), "run2.20.0.dump run2.20.1.dump run2.20.2.dump run2.20.3.dump");
  expect_all_pieces(run, 4);
}

TEST(Pieces, OfARestartIntoTheSameFiles)
{
  const Folder folder;
  Files files;
  for (int process = 0; process < 3; ++process)
  {
    files.push_back(folder.write("d." + std::to_string(process),
      frames_of({ 0, 10, 20, 10, 20, 30 }, ids_from(10 * process, 2))));
  }
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 10, 20, 30 }));
  expect_all_pieces(run, 3);
}

TEST(Pieces, OfARunThatWasKilledWhileSomeHadWritten)
{
  const Folder folder;
  Files files;
  for (int process = 0; process < 3; ++process)
  {
    const auto frame = [&](int step) { return particles(step, ids_from(10 * process, 2)); };
    // killed in step 20, which process 1 had written and the others had not; goes on from 10
    const std::string cut = process == 1 ? frame(20) : less_a_row(frame(20));
    files.push_back(folder.write("d." + std::to_string(process),
      frame(0) + frame(10) + cut + frame(10) + frame(20) + frame(30)));
  }
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 10, 20, 30 }));
  expect_all_pieces(run, 3);
}

TEST(Pieces, OfARunThatWentOnWithMoreProcesses)
{
  const Folder folder;
  for (const std::size_t later : { 2u, 4u, 6u }) // of eight steps
  {
    Steps before;
    Steps after;
    for (int i = 0; i < 8; ++i)
    {
      (static_cast<std::size_t>(i) < 8 - later ? before : after).push_back(10 * i);
    }
    Files files = write_pieces(folder, "d" + std::to_string(later) + ".", before, 2);
    std::ranges::copy(
      write_pieces(folder, "d" + std::to_string(later) + ".", after, 4), std::back_inserter(files));
    Series run;
    run.update(files);
    // all of a frame, or nothing of it: never a part
    for (std::size_t i = 0; i < run.index.size(); ++i)
    {
      EXPECT_EQ(run.ids(i), ids_of_pieces(run.steps()[i] < after[0] ? 2 : 4))
        << later << " steps of more, step " << run.steps()[i];
    }
  }
}

TEST(Pieces, ARunThatWasDoneAgainIsNone)
{
  // a study: the same steps and box under names that differ in a number; no particle is there twice
  const Folder folder;
  for (const int first : { 0, 1 })
  {
    Files files;
    for (int run = first; run < first + 2; ++run)
    {
      files.push_back(folder.write("study." + std::to_string(run) + ".dump",
        particles(0, {}) + particles(10, { 5, 1, run, 9 }) + particles(20, { 5, 1, run, 9 })));
    }
    Series run;
    run.update(files);
    EXPECT_EQ(run.steps(), (Steps{ 0, 10, 20 }));
    EXPECT_EQ(run.ids(1), (Ids{ 5, 1, first + 1, 9 }));
    EXPECT_EQ(run.said, hidden(files[0], files[1]));
  }
}

TEST(Pieces, TheFirstIsNumberedZero)
{
  // others may be pieces of which the first is missing, or anything: not without a word
  const Folder folder;
  Files files;
  for (int process = 1; process < 4; ++process)
  {
    files.push_back(
      folder.write("d." + std::to_string(process), particles(0, ids_from(10 * process, 2))));
  }
  Series run;
  run.update(files);
  EXPECT_EQ(run.ids(0), (Ids{ 30, 31 }));
  EXPECT_EQ(run.said, hidden(files[0], files.back(), 1));
  run.options.repeated_steps = RepeatedSteps::Merge;
  run.update(files);
  EXPECT_EQ(run.ids(0), (Ids{ 10, 11, 20, 21, 30, 31 }));
}

TEST(Pieces, OneOfTwoThatLags)
{
  const Folder folder;
  const Files files = { folder.write(
                          "x.0", particles(0, { 1 }) + particles(10, { 1 }) + particles(20, { 1 })),
    folder.write("x.1", particles(0, { 2 })) };
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), Steps{ 0 });
  EXPECT_EQ(run.ids(0), (Ids{ 1, 2 }));
  EXPECT_NE(run.said.find("left out until all are there"), std::string::npos) << run.said;
}

// ---- pieces that are not there -----------------------------------------------------------------

TEST(Pieces, AMissingOneLeavesTheFrameOut)
{
  const Folder folder;
  Files files = write_pieces(folder, "dump.", { 0, 100, 200, 300, 400 }, 4);
  files.erase(files.begin() + 4 + 2); // 100, process 2
  files.erase(files.begin() + 7 + 1); // 200, process 1
  files.erase(files.begin() + 7 + 1); // 200, process 2
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 300, 400 }));
  EXPECT_EQ(run.ids(1), ids_of_pieces(4));
  EXPECT_EQ(run.said,
    lacking(folder.path("dump.100.0.dump"), 4, 100, 3, " (none for 2)") +
      lacking(folder.path("dump.200.0.dump"), 4, 200, 2, " (none for 1 2)"));
}

TEST(Pieces, AnUnreadableOneLeavesTheFrameOut)
{
  const Folder folder;
  const Files files = write_pieces(folder, "dump.", { 0, 100, 200 }, 3);
  for (const std::string& bytes : { std::string(), std::string("no dump\n"),
         unfinished(particles(100, { 10, 11 })), std::string("\x1f\x8b\x08\xff damage", 11) })
  {
    folder.write("dump.100.1.dump", bytes);
    Series run;
    run.update(files);
    EXPECT_EQ(run.steps(), (Steps{ 0, 200 })) << bytes;
    EXPECT_TRUE(run.said.ends_with(lacking(files[3], 3, 100, 2)) ||
      run.said.starts_with(lacking(files[3], 3, 100, 2)))
      << run.said;
    EXPECT_EQ(run.ids(1), ids_of_pieces(3));
  }
  fs::remove(folder.path("dump.100.1.dump"));
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 200 }));
  EXPECT_EQ(run.said,
    lacking(files[3], 3, 100, 2) + files[4] +
      ": cannot open: No such file or directory; the file is left out\n");
}

TEST(Pieces, OneWithAnotherBoxLeavesTheFrameOut)
{
  const Folder folder;
  const Files files = write_pieces(folder, "dump.", { 0, 100, 200, 300 }, 3);
  folder.write("dump.100.1.dump", particles(100, { 10, 11 }, "0 2"));
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 200, 300 }));
  EXPECT_EQ(run.said,
    files[3] +
      ":1: expected pieces of timestep 100 with the same box and columns, got others; the "
      "frame is left out\n");
  EXPECT_EQ(run.ids(1), ids_of_pieces(3));
}

TEST(Pieces, OfADamagedFileOfManyFramesNoPartIsShown)
{
  // one file a process; that of process 1 lost a frame in the middle, or is damaged altogether
  const Folder folder;
  const auto frames = [](int process, const Steps& steps)
  { return frames_of(steps, ids_from(10 * process, 2)); };
  const Steps all = { 0, 10, 20, 30 };
  const std::string lost = frames(1, { 0 }) + less_a_row(frames(1, { 10 })) + frames(1, { 20, 30 });
  for (const std::string& bytes :
    { lost, std::string("no dump\n"), std::string(), frames(1, { 0, 10 }) })
  {
    Series run;
    const Files files = { folder.write("d.0", frames(0, all)), folder.write("d.1", bytes),
      folder.write("d.2", frames(2, all)) };
    try
    {
      run.update(files);
    }
    catch (const granular::Error&)
    {
      continue; // as good
    }
    EXPECT_NE(run.said, "");
    expect_all_pieces(run, 3, "d.1 of " + std::to_string(bytes.size()) + " bytes");
  }
}

TEST(Pieces, AStepThatIsBeingWrittenIsLeftOutSilentlyAndFoundLater)
{
  // of the last step, the first `done` processes have written all, the others a part
  for (const int processes : { 2, 3, 4 })
  {
    for (const std::size_t steps_before : { 1u, 2u, 3u })
    {
      for (int done = 0; done < processes; ++done)
      {
        // what is there of those that have not written all
        for (const std::string others : { "a part", "an empty file", "no file" })
        {
          if (done == 0 && others == "no file")
          {
            continue;
          }
          const Folder folder;
          const std::string what = std::to_string(processes) + " processes, of which " +
            std::to_string(done) + " have written step " + std::to_string(10 * steps_before) +
            "; of the others there is " + others;
          Steps steps;
          for (std::size_t i = 0; i < steps_before; ++i)
          {
            steps.push_back(10 * static_cast<std::int64_t>(i));
          }
          const Files before = write_pieces(folder, "d.", steps, processes);
          steps.push_back(10 * static_cast<std::int64_t>(steps_before));
          Files files = write_pieces(folder, "d.", steps, processes);
          const std::size_t written = before.size() + static_cast<std::size_t>(done);
          for (std::size_t i = written; i < files.size(); ++i)
          {
            fs::resize_file(files[i], others == "a part" ? fs::file_size(files[i]) - 5 : 0);
          }
          files.resize(others == "no file" ? written : files.size());
          Series run;
          run.update(files);
          EXPECT_TRUE(run.said.empty() || others == "no file") << what << run.said;
          EXPECT_EQ(run.index.size(), steps_before) << what;
          expect_all_pieces(run, processes, what);
          files = write_pieces(folder, "d.", steps, processes);
          for (const std::string& file : files)
          {
            touch(file, 1);
          }
          run.update(files);
          EXPECT_EQ(run.said, "") << what;
          EXPECT_EQ(run.steps(), steps) << what;
          EXPECT_EQ(run.ids(steps_before), ids_of_pieces(processes)) << what;
        }
      }
    }
  }
}

TEST(Pieces, TheVeryFirstStepIsBeingWritten)
{
  const Folder folder;
  const Files files = write_pieces(folder, "d.", { 0 }, 3);
  for (int done = 0; done < 3; ++done)
  {
    write_pieces(folder, "d.", { 0 }, 3);
    for (std::size_t i = static_cast<std::size_t>(done); i < 3; ++i)
    {
      fs::resize_file(files[i], fs::file_size(files[i]) - 5);
    }
    Series run;
    const std::string error = error_of([&] { run.update(files); });
    // nothing is shown, as of an incomplete file; never a part of the particles
    EXPECT_NE(error, "") << done;
    EXPECT_EQ(run.index.size(), 0u) << done;
  }
}

TEST(Pieces, ARestartOfWhichSomeAreNotWrittenDoesNotHideTheFirstRun)
{
  const Folder folder;
  Files files = write_pieces(folder, "run1.", { 0, 10, 20 }, 2);
  std::ranges::copy(write_pieces(folder, "run2.", { 20 }, 2), std::back_inserter(files));
  fs::resize_file(files.back(), 0);
  Series run;
  run.update(files);
  // step 20 was there before the restart, and is still
  EXPECT_EQ(run.steps(), (Steps{ 0, 10, 20 }));
  expect_all_pieces(run, 2);
}

// ---- what the user says ------------------------------------------------------------------------

TEST(Pieces, LastForcesTheLastFile)
{
  const Folder folder;
  const Files files = write_pieces(folder, "d.", { 0, 10 }, 2);
  Series run;
  run.options.repeated_steps = RepeatedSteps::Last;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 10 }));
  EXPECT_EQ(run.names(0), "d.0.1.dump");
  EXPECT_EQ(run.ids(1), (Ids{ 10, 11 }));
  EXPECT_EQ(run.said, hidden(files[0], folder.path("d.0.1.dump"), 1));
  // and back
  run.options.repeated_steps = RepeatedSteps::Auto;
  run.update(files);
  EXPECT_EQ(run.ids(0), ids_of_pieces(2));
}

TEST(Pieces, MergeForcesAllFilesInTheirOrder)
{
  const Folder folder;
  // names that no rule understands: a rank in letters, another folder
  fs::create_directory(folder.path("b"));
  const Files files = { folder.write("beta.dump", particles(0, { 3, 4 }) + particles(10, { 3 })),
    folder.write("b/alpha.dump", particles(0, { 1 }) + particles(10, { 1, 2 })),
    folder.write("gamma.dump", particles(0, { 5 }) + particles(10, {})) };
  Series run;
  run.options.repeated_steps = RepeatedSteps::Merge;
  run.update(files);
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(run.steps(), (Steps{ 0, 10 }));
  EXPECT_EQ(run.ids(0), (Ids{ 3, 4, 1, 5 }));
  EXPECT_EQ(run.ids(1), (Ids{ 3, 1, 2 }));
  // a timestep with fewer pieces than others
  folder.append("beta.dump", particles(20, { 3 }) + particles(30, { 3 }));
  folder.append("b/alpha.dump", particles(30, { 1 }));
  folder.append("gamma.dump", particles(20, { 5 }) + particles(30, { 5 }));
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 10, 30 }));
  EXPECT_EQ(run.ids(2), (Ids{ 3, 1, 5 }));
  EXPECT_NE(run.said.find("expected 3 pieces of timestep 20, got 2; the frame is left out"),
    std::string::npos)
    << run.said;
}

TEST(Pieces, MergeOfOneFileAStepChangesNothing)
{
  const Folder folder;
  Series run;
  run.options.repeated_steps = RepeatedSteps::Merge;
  run.update(
    { folder.write("d.10", particles(10, { 2 })), folder.write("d.0", particles(0, { 1 })) });
  EXPECT_EQ(run.said, "");
  EXPECT_EQ(run.steps(), (Steps{ 0, 10 }));
  EXPECT_EQ(run.ids(0), Ids{ 1 });
}

TEST(Pieces, MergedFollowARunWithoutAWord)
{
  // as in Auto, a last frame that some have not written yet is no matter to speak of
  const Folder folder;
  const Files files = { folder.write("a", particles(0, { 1 })),
    folder.write("b", particles(0, { 2 })) };
  Series run;
  run.options.repeated_steps = RepeatedSteps::Merge;
  run.update(files);
  folder.append("a", particles(10, { 1 }));
  folder.append("b", unfinished(particles(10, { 2 })));
  run.update(files);
  EXPECT_EQ(run.steps(), Steps{ 0 });
  EXPECT_EQ(run.said, "");
}

// ---- reading pieces ----------------------------------------------------------------------------

TEST(Pieces, GiveTheSameAsOneFileWithAllRows)
{
  const Folder folder;
  // several batches of the decoder, and pieces that end within one; ids in no order
  constexpr int rows = 10000;
  std::vector<int> ids(rows);
  for (int i = 0; i < rows; ++i)
  {
    ids[static_cast<std::size_t>(i)] = (i * 7919) % rows + 1;
  }
  std::minstd_rand random(3);
  std::vector<std::string> lines;
  for (const int id : ids)
  {
    lines.push_back(std::to_string(id) + " " + std::to_string(id % 3) + " 0." +
      std::to_string(random() % 100000) + " 0." + std::to_string(random() % 100000) + " 0." +
      std::to_string(random() % 100000) + " 1 -2 " + std::to_string(id % 5) + " 0.5 0 -" +
      std::to_string(id) + " w" + std::to_string(id % 7) + "\n");
  }
  const std::string columns = "id type xs ys zs ix iy iz vx vy vz word";
  const auto text = [&](std::size_t from, std::size_t to)
  {
    std::string all = header(0, to - from, columns, "-1 3");
    for (std::size_t i = from; i < to; ++i)
    {
      all += lines[i];
    }
    return all;
  };
  const std::vector<std::size_t> ends = { 0, 1, 2048, 2048, 6000, 9999, rows };
  Files files;
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece)
  {
    files.push_back(folder.write("p." + std::to_string(piece), text(ends[piece], ends[piece + 1])));
  }
  Series merged;
  merged.update(files);
  Series whole;
  whole.update({ folder.write("whole", text(0, rows)) });
  ASSERT_EQ(merged.index.pieces(0).size(), 6u);

  std::vector<granular::Request> requests = all_requests();
  requests.push_back(everything());
  requests.back().coordinates = granular::Coordinates::Unwrapped;
  requests.back().point_origin = { 1, 2, 3 };
  requests.push_back(everything());
  requests.back().stride = 20000; // nothing
  requests.push_back(everything());
  requests.back().region = { 0, 0, 0, 0, 0, 0 };
  for (std::size_t i = 0; i < requests.size(); ++i)
  {
    const Decoded a = merged.read(0, requests[i]);
    const Decoded b = whole.read(0, requests[i]);
    EXPECT_EQ(content_of(a.frame).difference(content_of(b.frame)), "") << i;
    EXPECT_EQ(a.said(), b.said()) << i;
  }
}

TEST(Pieces, StrideWithoutIdsCountsTheRowsOfAll)
{
  const Folder folder;
  const auto text = [](std::vector<int> rows)
  {
    std::string all = header(0, rows.size(), "x y z");
    for (const int x : rows)
    {
      all += std::to_string(x) + " 0 0\n";
    }
    return all;
  };
  Series run;
  run.update({ folder.write("p.0", text({ 0, 1, 2, 3 })), folder.write("p.1", text({})),
    folder.write("p.2", text({ 4 })), folder.write("p.3", text({ 5, 6, 7, 8, 9, 10 })) });
  granular::Request request;
  request.stride = 3;
  EXPECT_EQ(
    run.read(0, request).points(), (std::vector<double>{ 0, 0, 0, 3, 0, 0, 6, 0, 0, 9, 0, 0 }));
}

TEST(Pieces, OneThatWasShortenedOrChangedIsNamed)
{
  const Folder folder;
  const Files files = { folder.write("p.0", particles(5, ids_from(0, 100))),
    folder.write("p.1", particles(5, ids_from(100, 100))),
    folder.write("p.2", particles(5, ids_from(200, 100))) };
  Series run;
  run.update(files);
  const auto size = fs::file_size(files[1]);
  fs::resize_file(files[1], 200);
  EXPECT_EQ(error_of([&] { run.read(0); }),
    files[1] + ": the file was shortened since it was indexed: expected at least " +
      std::to_string(size) + " bytes, got 200; reload the files");
  fs::remove(files[1]);
  EXPECT_EQ(error_of([&] { run.read(0); }), files[1] + ": cannot open: No such file or directory");
  folder.write("p.1", particles(6, ids_from(100, 100)));
  EXPECT_EQ(error_of([&] { run.read(0); }),
    files[1] + ": the file changed since it was indexed; reload the files");
}

TEST(Pieces, AColumnOfWordsInSomeIsOneInAll)
{
  const Folder folder;
  const auto piece = [](const std::string& rows)
  {
    const auto count = static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n'));
    return header(0, count, "id x y z kind") + rows;
  };
  const std::string words = "1 0 0 0 big\n2 0 0 0 small\n";
  const std::string numbers = "3 0 0 0 17\n4 0 0 0 1.50\n";
  const std::string more = "5 0 0 0 small\n6 0 0 0 19\n";
  std::vector<std::string> pieces = { words, numbers, "", more };
  // whichever comes first
  for (int round = 0; round < 4; ++round)
  {
    Files files;
    std::vector<std::string> expected;
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      files.push_back(folder.write("p." + std::to_string(i), piece(pieces[i])));
      const std::vector<std::string> here = pieces[i] == words
        ? std::vector<std::string>{ "big", "small" }
        : pieces[i] == numbers ? std::vector<std::string>{ "17", "1.50" }
        : pieces[i] == more    ? std::vector<std::string>{ "small", "19" }
                               : std::vector<std::string>{};
      expected.insert(expected.end(), here.begin(), here.end());
    }
    Series run;
    run.update(files);
    ASSERT_EQ(run.index.pieces(0).size(), 4u);
    EXPECT_EQ(run.read(0).texts("kind"), expected) << round;
    EXPECT_EQ(run.read(0).said(), "") << round;
    std::rotate(pieces.begin(), pieces.begin() + 1, pieces.end());
  }
  // numbers in all that have rows
  Series run;
  run.update({ folder.write("q.0", piece("")), folder.write("q.1", piece(numbers)) });
  EXPECT_EQ(run.read(0).values("kind"), (std::vector<double>{ 17, 1.5 }));
}
