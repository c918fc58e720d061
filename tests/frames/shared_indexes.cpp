// SPDX-License-Identifier: BSD-3-Clause
// Runs of one process that take from each other what they know of their files.
#include "granular/frames/shared_indexes.h"
#include "granular/frames/run_index.h"
#include "granular/frames/saved_index.h"
#include "granular/local/local_file.h"

#include "../support/byte_source_packing.h"
#include "../support/own_folder.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using granular::SharedIndexes;

class SharedIndexesTest : public OwnFolder
{
protected:
  /// A file that has rested for a while.
  std::string rested(const std::string& name, const std::string& bytes) const
  {
    const std::string path = this->write(name, bytes);
    touch(path, -100);
    return path;
  }

  /// Puts other bytes behind the same stamp: only who looks through the file sees them.
  void hide(const std::string& path, const std::string& bytes) const
  {
    const auto time = fs::last_write_time(path);
    ASSERT_EQ(fs::file_size(path), bytes.size());
    this->write(fs::path(path).filename().string(), bytes);
    fs::last_write_time(path, time);
  }

  Series run()
  {
    Series made;
    made.options.shared = &indexes;
    return made;
  }

  SharedIndexes indexes;
  const std::string two = grains(100, { 1, 2 }) + grains(200, { 1, 2 });
  const std::string others = grains(300, { 1, 2 }) + grains(400, { 1, 2 });
};
}

TEST_F(SharedIndexesTest, ASecondRunDoesNotLookThroughTheFile)
{
  const std::string path = this->rested("a.dump", two);
  Series first = this->run();
  first.update({ path });
  this->hide(path, others);
  Series second = this->run();
  second.update({ path });
  EXPECT_EQ(second.steps(), (Steps{ 100, 200 }));
  Series alone;
  alone.update({ path });
  EXPECT_EQ(alone.steps(), (Steps{ 300, 400 }));
}

TEST_F(SharedIndexesTest, AnIndexGoesWithTheLastRunThatHasIt)
{
  const std::string path = this->rested("a.dump", two);
  auto first = std::make_unique<Series>(this->run());
  first->update({ path });
  auto second = std::make_unique<Series>(this->run());
  second->update({ path });
  first.reset();
  this->hide(path, others);
  Series third = this->run();
  third.update({ path });
  EXPECT_EQ(third.steps(), (Steps{ 100, 200 })); // of the second
  second.reset();
  third = this->run();
  third.update({ path });
  EXPECT_EQ(third.steps(), (Steps{ 300, 400 }));
}

TEST_F(SharedIndexesTest, AnIndexStaysWhileAnyRunHasIt)
{
  const std::string path = this->rested("a.dump", two);
  Series first = this->run();
  first.update({ path });
  {
    Series second = this->run();
    second.update({ path });
  }
  this->hide(path, others);
  Series third = this->run();
  third.update({ path });
  EXPECT_EQ(third.steps(), (Steps{ 100, 200 })); // of the first
}

TEST_F(SharedIndexesTest, AFileThatChangedIsLookedThrough)
{
  const std::string path = this->rested("a.dump", two);
  Series first = this->run();
  first.update({ path });
  this->rested("a.dump", others + grains(500, { 3 }));
  touch(path, 10);
  Series second = this->run();
  second.update({ path });
  EXPECT_EQ(second.steps(), (Steps{ 300, 400, 500 }));
  EXPECT_EQ(first.steps(), (Steps{ 100, 200 })); // until it is asked to look
  first.update({ path });
  EXPECT_EQ(first.steps(), (Steps{ 300, 400, 500 }));
}

TEST_F(SharedIndexesTest, AFileJustWrittenIsLookedThrough)
{
  const std::string path = this->write("a.dump", two);
  Series first = this->run();
  first.update({ path });
  this->hide(path, others);
  Series second = this->run();
  second.update({ path });
  EXPECT_EQ(second.steps(), (Steps{ 300, 400 }));
}

TEST_F(SharedIndexesTest, AFileJustWrittenIsNeverSharedWhateverTimePasses)
{
  const std::string path = this->write("a.dump", two);
  Series first = this->run();
  first.update({ path });
  this->hide(path, others);
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));
  first.update({ path }); // which finds the stamp as it was
  EXPECT_EQ(first.steps(), (Steps{ 100, 200 }));
  Series second = this->run();
  second.update({ path });
  EXPECT_EQ(second.steps(), (Steps{ 300, 400 }));
}

TEST_F(SharedIndexesTest, WhatAnIndexFileSaysStaysWithItsReader)
{
  const auto frames = [](std::int64_t third)
  {
    std::string text;
    for (const std::int64_t step :
      { std::int64_t{ 100 }, std::int64_t{ 200 }, third, std::int64_t{ 400 } })
    {
      text += grains(step, ids_from(1, 500));
    }
    return text;
  };
  const std::string path = this->rested("a.dump", frames(300));
  {
    Series writer;
    writer.options.keep_index = granular::KeepIndex::Beside;
    writer.update({ path });
  }
  this->hide(path, frames(333));
  Series first = this->run();
  first.options.keep_index = granular::KeepIndex::Beside;
  first.update({ path });
  EXPECT_EQ(first.steps(), (Steps{ 100, 200, 300, 400 })); // of the index file
  Series second = this->run();
  second.update({ path });
  EXPECT_EQ(second.steps(), (Steps{ 100, 200, 333, 400 }));
}

TEST_F(SharedIndexesTest, AnIndexFileListsFilesThatWereKnown)
{
  const std::string a = this->rested("a.dump", grains(100, { 1, 2 }));
  const std::string b = this->rested("b.dump", grains(200, { 1, 2 }));
  const std::string c = this->rested("c.dump", grains(300, { 1, 2 }));
  Series other = this->run();
  other.update({ c });
  Series run = this->run();
  run.options.keep_index = granular::KeepIndex::Beside;
  run.update({ a, b });
  run.update({ a, c });
  granular::Notices notices;
  const auto listed = granular::load_index(a + std::string(granular::index_file_suffix), a,
    std::make_shared<granular::FrameKinds>(), notices);
  ASSERT_EQ(listed.size(), 2u);
  EXPECT_EQ(listed[1].path, c);
}

TEST_F(SharedIndexesTest, SeekPointsThatAreNotKeptAreNotMissedByOthers)
{
  auto files = std::make_shared<SharedIndexes::Files>(1);
  granular::FileIndex& file = files->front();
  file.path = "a.dump.gz";
  file.format = &granular::dump_format();
  file.frames.resize(2);
  file.compressed = true;
  file.shareable = true;
  indexes.add(files);
  EXPECT_FALSE(indexes.find(file.path, file.format));
  file.points = std::make_shared<granular::SeekPoints>();
  indexes.add(files);
  EXPECT_TRUE(indexes.find(file.path, file.format));
}

TEST_F(SharedIndexesTest, SomeOfTheFilesAreKnown)
{
  const std::string a = this->rested("a.dump", grains(100, { 1, 2 }));
  const std::string b = this->rested("b.dump", grains(200, { 1, 2 }));
  const std::string c = this->rested("c.dump", grains(300, { 1, 2 }));
  Series first = this->run();
  first.update({ a, b });
  this->hide(b, grains(500, { 1, 2 }));
  Series second = this->run();
  second.update({ b, c });
  EXPECT_EQ(second.steps(), (Steps{ 200, 300 }));
  EXPECT_EQ(second.read(1).points()[0], 300);
}

TEST_F(SharedIndexesTest, NoticesAreToldToEachUser)
{
  const std::string path =
    this->rested("a.dump", two + header(300, 3) + "1 0 0 0\n" + grains(400, { 1 }));
  Series first = this->run();
  first.update({ path });
  ASSERT_NE(first.said, "");
  Series second = this->run();
  second.update({ path });
  EXPECT_EQ(second.said, first.said);
  second.update({ path });
  EXPECT_EQ(second.said, "");
}

TEST_F(SharedIndexesTest, AnErrorIsNotShared)
{
  const std::string path = this->path("a.dump");
  const std::string good = this->rested("b.dump", two);
  Series first = this->run();
  first.update({ good, path });
  ASSERT_NE(first.said, "");
  this->rested("a.dump", others);
  Series second = this->run();
  second.update({ good, path });
  EXPECT_EQ(second.steps(), (Steps{ 100, 200, 300, 400 }));
}

TEST_F(SharedIndexesTest, AnotherFormatLooksForItself)
{
  const std::string path = this->rested("a.dump", two);
  Series first = this->run();
  first.update({ path });
  Series other = this->run();
  other.options.format = &granular::local_format();
  EXPECT_THROW(other.update({ path }), granular::FormatError);
  EXPECT_EQ(first.steps(), (Steps{ 100, 200 }));
}

TEST_F(SharedIndexesTest, AnotherLimitLooksForItself)
{
  const std::string path = this->rested("a.dump.gz", packing::gzip(two));
  Series first = this->run();
  first.update({ path });
  Series second = this->run();
  second.options.largest_expansion = 1;
  second.update({ path });
  EXPECT_EQ(second.index.files()[0].largest_expansion, 1);
  EXPECT_EQ(first.index.files()[0].largest_expansion, granular::usual_expansion);
}

TEST_F(SharedIndexesTest, OneRunGrowsWhileAnotherReads)
{
  const auto packed = [](std::int64_t from, std::int64_t to)
  {
    std::string members;
    for (std::int64_t step = from; step < to; ++step)
    {
      members += packing::gzip(grains(step, ids_from(1, 40'000)));
    }
    return members;
  };
  const std::string path = this->rested("a.dump.gz", packed(0, 3));
  Series first = this->run();
  first.update({ path });
  const std::size_t points = first.index.files()[0].points->points.size();
  ASSERT_GT(points, 0u);
  Series second = this->run();
  second.update({ path });
  EXPECT_EQ(second.index.files()[0].points, first.index.files()[0].points); // no copy
  this->rested("a.dump.gz", packed(0, 5));
  touch(path, 10);
  second.update({ path });
  EXPECT_EQ(second.steps(), (Steps{ 0, 1, 2, 3, 4 }));
  EXPECT_GT(second.index.files()[0].points->points.size(), points);
  EXPECT_EQ(first.index.files()[0].points->points.size(), points);
  EXPECT_EQ(first.read(2).points()[0], 2);
  EXPECT_EQ(second.read(4).points()[0], 4);
}

TEST_F(SharedIndexesTest, ManyThreadsAtOnce)
{
  std::vector<std::string> paths;
  Steps steps;
  for (int i = 0; i < 20; ++i)
  {
    paths.push_back(this->rested("a" + std::to_string(i) + ".dump", grains(i, { 1, 2 })));
    steps.push_back(i);
  }
  std::vector<Steps> found(4);
  std::vector<std::thread> threads;
  for (Steps& mine : found)
  {
    threads.emplace_back(
      [&]
      {
        for (int round = 0; round < 20; ++round)
        {
          Series series = this->run();
          series.update(paths);
          mine = series.steps();
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const Steps& mine : found)
  {
    EXPECT_EQ(mine, steps);
  }
}
