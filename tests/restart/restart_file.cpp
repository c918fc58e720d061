// SPDX-License-Identifier: BSD-3-Clause
// Restart files in the list of a run, and which files are some.
#include "granular/formats/restart/restart_file.h"

#include "restart_files.h"

#include "../support/byte_source_packing.h"
#include "../support/counting_source.h"
#include "../support/dumps.h"

#include "granular/frames/run_index.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using restart_builder::RestartBuilder;

/// An index of restart files, and what it says.
struct Indexed
{
  granular::RunIndex index;
  std::string said;

  void update(const std::vector<std::string>& files)
  {
    granular::Notices notices;
    granular::Progress progress;
    granular::IndexOptions options;
    options.format = &granular::restart_format();
    said.clear();
    try
    {
      index.update(files, options, notices, progress);
    }
    catch (const granular::Error& error)
    {
      said = std::string("error: ") + error.what() + "\n";
    }
    for (const granular::Notice& notice : notices)
    {
      said += to_string(notice) + "\n";
    }
  }
};

TEST(RestartFile, WhatOtherFilesSayOfAFileDoesNotStay)
{
  const Folder folder;
  const RestartBuilder file = small_file();
  RestartBuilder other = small_file();
  other.timestep = 5;
  const std::string cut = file.base().substr(0, file.base().size() / 2);
  const std::string base = folder.write("rbase.restart", cut);
  const std::string part = folder.write("r1.restart", file.part(1));
  const std::string whole = folder.write("s.restart", other.file());
  Indexed run;
  run.update({ base, part, whole });
  run.update({ part, whole });
  Indexed alone;
  alone.update({ part, whole });
  EXPECT_EQ(run.said, alone.said);
  EXPECT_NE(run.said, "");
}

TEST(RestartFile, OneFrameEach)
{
  const Folder folder;
  RestartBuilder file = small_file();
  std::vector<std::string> files;
  for (const std::int64_t step : { 300, 100, 200 })
  {
    file.timestep = step;
    file.time = static_cast<double>(step) / 1000;
    files.push_back(folder.write("run." + std::to_string(step) + ".restart", file.file()));
  }
  file.timestep = 1234;
  file.time = 1.5;
  files.push_back(folder.write("packed.restart.gz", packing::gzip(file.file())));
  Indexed all;
  all.update(files);
  EXPECT_EQ(all.said, "");
  ASSERT_EQ(all.index.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const granular::FileIndex& one = all.index.files()[i];
    ASSERT_EQ(one.frames.size(), 1u);
    EXPECT_EQ(one.frames[0].rows, 5);
    EXPECT_EQ(one.frames[0].offset, 0);
    EXPECT_TRUE(one.frames[0].kind);
  }
  const granular::FileIndex& first = all.index.files()[0];
  EXPECT_EQ(first.frames[0].timestep, 300);
  EXPECT_EQ(first.frames[0].time, 0.3);
  const granular::FrameEntry& packed = all.index.files()[3].frames[0];
  EXPECT_EQ(packed.timestep, 1234);
  EXPECT_EQ(packed.time, 1.5);
  EXPECT_EQ(packed.end, static_cast<std::int64_t>(file.file().size()));
  Indexed without;
  without.update({ folder.write("without.restart", small_file().file()) });
  EXPECT_EQ(without.said, "");
  EXPECT_TRUE(std::isnan(without.index.files()[0].frames.at(0).time));
}

TEST(RestartFile, HalfWritten)
{
  const Folder folder;
  const std::string good = folder.write("a.restart", small_file().file());
  RestartBuilder later = small_file();
  later.timestep = 5000;
  const std::string cut = folder.write("b.restart", later.file().substr(0, 1200));
  Indexed all;
  all.update({ good, cut });
  EXPECT_EQ(all.index.size(), 1u);
  EXPECT_NE(all.said.find(cut + "@"), std::string::npos) << all.said;
  EXPECT_NE(
    all.said.find("understood: header, groups, masses; the file is left out"), std::string::npos)
    << all.said;
  folder.write("b.restart", later.file());
  all.update({ good, cut });
  EXPECT_EQ(all.index.size(), 2u);
  EXPECT_EQ(all.said, "");
}

TEST(RestartFile, FilesOfProcessesBesideTheirBase)
{
  const Folder folder;
  const RestartBuilder file = small_file();
  const std::string first = folder.write("r0.restart", file.part(0));
  const std::string second = folder.path("r1.restart");
  const std::string base = folder.write("rbase.restart", file.base());
  Indexed all;
  all.update({ first, base });
  EXPECT_EQ(all.index.size(), 0u);
  EXPECT_NE(all.said.find("error: " + second + ": expected the particles of process 1 of 2"),
    std::string::npos)
    << all.said;

  folder.write("r1.restart", file.part(1)); // the base is as it was
  all.update({ first, second, base });
  EXPECT_EQ(all.said, "");
  ASSERT_EQ(all.index.size(), 1u);
  EXPECT_EQ(all.index.files()[2].frames[0].rows, 5);
  EXPECT_EQ(all.index.files()[2].frames[0].timestep, 1234);
  EXPECT_TRUE(all.index.files()[0].frames.empty());

  Indexed alone;
  alone.update({ first });
  EXPECT_EQ(alone.index.size(), 0u);
  EXPECT_EQ(alone.said,
    "error: " + first +
      ": expected a restart file, got what one of several processes has written of it: open the "
      "file with 'base' in its name\n");
}

/// The bytes that are read to learn the layout of a file that is in an index.
std::int64_t bytes_for_layout(const granular::FileIndex& file, const std::string& bytes)
{
  const CountingSource source(bytes);
  granular::Notices notices;
  granular::Progress progress;
  const auto layout = granular::find_restart_layout(file, source, notices, progress);
  EXPECT_EQ(layout->records, file.frames.at(0).rows);
  return source.bytes_read();
}

TEST(RestartFile, IsLookedThroughOnce)
{
  const Folder folder;
  RestartBuilder file = small_file();
  const std::string path = folder.write("a.restart", file.file());
  Indexed all;
  all.update({ path });
  EXPECT_EQ(bytes_for_layout(all.index.files()[0], file.file()), 0);

  file.forces += "longer";
  folder.write("a.restart", file.file()); // behind the back of the index
  EXPECT_GT(bytes_for_layout(all.index.files()[0], file.file()), 0);
  all.update({ path });
  EXPECT_EQ(bytes_for_layout(all.index.files()[0], file.file()), 0);

  granular::RunIndex passed; // to another rank
  passed.decode(all.index.encode());
  EXPECT_GT(bytes_for_layout(passed.files()[0], file.file()), 0);
}

TEST(RestartFile, FilesOfProcessesAreLookedThroughOnce)
{
  const Folder folder;
  RestartBuilder file = small_file();
  const std::string base = folder.write("rbase.restart", file.base());
  folder.write("r0.restart", file.part(0));
  folder.write("r1.restart", file.part(1));
  Indexed all;
  all.update({ base });
  const granular::FileIndex& index = all.index.files()[0];
  const auto look = [&]
  {
    granular::Notices notices;
    granular::Progress progress;
    return granular::find_restart_layout(index, *granular::open_file(base), notices, progress);
  };
  EXPECT_EQ(look(), index.layout);
  file.chunks[1] = particles(4, 20);
  folder.write("r1.restart", file.part(1));
  EXPECT_THROW(look(), granular::FormatError) << "the base says how many particles there are";
}

TEST(RestartFile, NoticesAreGivenWithAKnownLayout)
{
  const Folder folder;
  RestartBuilder file = small_file();
  file.peratom_fixes[1].id = "p\x01";
  const std::string path = folder.write("a.restart", file.file());
  Indexed all;
  all.update({ path });
  const granular::FileIndex& index = all.index.files()[0];
  granular::Notices known;
  granular::Notices anew;
  granular::Progress progress;
  const auto source = granular::open_file(path);
  ASSERT_EQ(granular::find_restart_layout(index, *source, known, progress), index.layout);
  granular::read_layout(*source, anew, progress);
  ASSERT_EQ(known.size(), 1u);
  ASSERT_EQ(anew.size(), 1u);
  EXPECT_EQ(to_string(known[0]), to_string(anew[0]));
}

TEST(RestartFile, WhichFilesAreSome)
{
  const Folder folder;
  RestartBuilder file = small_file();
  for (const bool swapped : { false, true })
  {
    file.swapped = swapped;
    const std::string bytes = file.file();
    EXPECT_TRUE(granular::is_restart_file(folder.write("a", bytes)));
    EXPECT_TRUE(granular::is_restart_file(folder.write("b", packing::gzip(bytes))));
    EXPECT_TRUE(granular::is_restart_file(folder.write("c", packing::zstd(bytes))));
    EXPECT_TRUE(granular::is_restart_file(folder.write("d", bytes.substr(0, 60))));
    EXPECT_FALSE(granular::is_restart_file(folder.write("e", bytes.substr(0, 40))));
    EXPECT_FALSE(granular::is_restart_file(folder.write("f", bytes.substr(1))));
    EXPECT_FALSE(granular::is_restart_file(folder.write("g", file.part(0))));
  }
  EXPECT_TRUE(granular::is_restart_file(
    folder.write("lammps", std::string("LammpS RestartT\0\1\0\0\0", 20))));
  EXPECT_FALSE(granular::is_restart_file(folder.write("h", "")));
  EXPECT_FALSE(granular::is_restart_file(folder.write("i", std::string(100, '\0'))));
  EXPECT_FALSE(granular::is_restart_file(folder.path("none")));
  EXPECT_FALSE(granular::is_restart_file(folder.path("")));
}

TEST(RestartFile, AllOfTheTestData)
{
  int restarts = 0;
  int others = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(GRANULAR_DATA "/good"))
  {
    const std::string path = entry.path().string();
    if (!entry.is_regular_file())
    {
      continue;
    }
    const bool expected = entry.path().extension() == ".restart";
    EXPECT_EQ(granular::is_restart_file(path), expected) << path;
    ++(expected ? restarts : others);
  }
  EXPECT_GE(restarts, 6);
  EXPECT_GE(others, 100);
}
}
