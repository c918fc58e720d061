// SPDX-License-Identifier: BSD-3-Clause
// An index does not depend on how many threads make it: of one file in which several pass over a frame,
// and of many files.
#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/frames/run_index.h"
#include "granular/frames/run_index_parts.h"

#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/series.h"
#include "../support/stop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace
{
using granular::FileIndex;
using granular::Notices;
using granular::Progress;
using granular::ScanAhead;

// ---- one file ----------------------------------------------------------------------------------

/// All that an index says of a text.
std::string index_of(const std::string& text, const ScanAhead& ahead)
{
  FileIndex index;
  index.kinds = std::make_shared<granular::FrameKinds>();
  Progress progress;
  granular::index_dump(*granular::open_memory(text), index, progress, ahead);
  return granular::encode_files({ index }) + lines_of(index.notices);
}

void expect_same(const std::string& text, const std::vector<std::size_t>& chunks)
{
  const std::string expected = index_of(text, {});
  for (const std::size_t chunk : chunks)
  {
    for (const int threads : { 2, 3, 8 })
    {
      ASSERT_TRUE(index_of(text, { threads, 0, chunk }) == expected)
        << threads << " threads, chunks of " << chunk << " bytes:\n"
        << text.substr(0, 2000);
    }
  }
  ASSERT_TRUE(index_of(text, { 2, 1000, 64 }) == expected);
}

std::string blank_lines_between(const std::string& text)
{
  return replaced(replaced(text, "\n", "\n \t\n"), "\n \t\nITEM: ", "\n\n   \nITEM: ");
}
}

TEST(IndexThreads, RealFiles)
{
  int files = 0;
  for (const char* folder : { "/good", "/bad" })
  {
    for (const auto& entry :
      std::filesystem::directory_iterator(std::string(GRANULAR_DATA) + folder))
    {
      if (entry.path().extension() == ".dump")
      {
        SCOPED_TRACE(entry.path());
        const std::string text =
          data_file(std::string(folder).substr(1) + "/" + entry.path().filename().string());
        expect_same(text, { 29, 1000, 40'000 });
        expect_same(replaced(text, "\n", "\r\n"), { 1000 });
        expect_same(blank_lines_between(text), { 1000 });
        ++files;
      }
    }
  }
  EXPECT_GE(files, 50);
}

TEST(IndexThreads, EveryCutAndEveryGlue)
{
  const std::string frames = particles(0, ids_from(1, 6)) + particles(10, ids_from(1, 3));
  const std::string blank = blank_lines_between(frames);
  for (std::size_t cut = 0; cut < frames.size(); cut += 3)
  {
    expect_same(frames.substr(0, cut), { 1, 7 });
    expect_same(frames.substr(0, cut) + frames, { 1, 7 });
    expect_same(blank.substr(0, cut) + blank, { 5 });
  }
}

TEST(IndexThreads, LargeFramesWithTheSizesAsTheyAre)
{
  std::string text;
  for (const std::int64_t rows : { 300'000, 5, 200'000, 0, 400'000 })
  {
    text += particles(static_cast<std::int64_t>(text.size()), ids_from(1, rows));
  }
  ASSERT_GT(text.size(), std::size_t{ 15 } << 20);
  const std::string expected = index_of(text, {});
  for (const int threads : { 2, 3, 8 })
  {
    ScanAhead ahead;
    ahead.threads = threads;
    EXPECT_TRUE(index_of(text, ahead) == expected) << threads;
    EXPECT_TRUE(index_of(text.substr(0, text.size() - 1), ahead) ==
      index_of(text.substr(0, text.size() - 1), {}));
  }
}

// ---- many files --------------------------------------------------------------------------------

namespace
{
/// A run of files of all sorts: text, compressed, binary, cut, with faults, missing, none at all.
Files mixed_run(const Folder& folder)
{
  Files files;
  for (int i = 0; i < 40; ++i)
  {
    const std::string name = "run." + std::to_string(i);
    const std::string text =
      particles(10 * i, ids_from(1, 5 + i)) + particles(10 * i + 5, ids_from(1, 9));
    switch (i % 8)
    {
      case 1:
        files.push_back(folder.write(name + ".gz", packing::gzip(text)));
        break;
      case 2:
        files.push_back(folder.write(name, replaced(text, "id x", "id foo" + std::to_string(i))));
        break;
      case 3:
        files.push_back(folder.write(name, text.substr(0, text.size() - 10)));
        break;
      case 4:
        files.push_back(folder.write(name, replaced(text, "\n3 ", "\n") + text));
        break;
      case 5:
        files.push_back(folder.path("missing." + std::to_string(i)));
        break;
      case 6:
        files.push_back(folder.write(name, "no dump at all\n"));
        break;
      case 7:
        files.push_back(folder.write(name + ".bin", data_file("good/ortho_custom.bin")));
        break;
      default:
        files.push_back(folder.write(name, text));
    }
  }
  return files;
}
}

TEST(IndexThreads, ManyFilesOfAllSorts)
{
  const Folder folder;
  const Files files = mixed_run(folder);
  Series alone;
  alone.update(files);
  ASSERT_GT(alone.index.size(), 30u);
  ASSERT_NE(alone.said.find("missing.5: cannot open"), std::string::npos) << alone.said;
  for (const int threads : { 2, 3, 8, 100 })
  {
    Series run;
    run.options.threads = threads;
    run.update(files);
    EXPECT_TRUE(run.index.encode() == alone.index.encode()) << threads;
    EXPECT_EQ(run.said, alone.said) << threads;
    run.update(files);
    EXPECT_TRUE(run.index.encode() == alone.index.encode()) << threads;
  }
}

TEST(IndexThreads, FarMoreFilesThanMayBeOpenAtOnce)
{
  const Folder folder;
  Files files;
  for (int i = 0; i < 300; ++i)
  {
    files.push_back(folder.write(std::to_string(i), particles(i, { 1 })));
  }
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit few = { 40, before.rlim_max };
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  Series run;
  run.options.threads = 8;
  run.update(files);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(run.index.size(), 300u);
  EXPECT_EQ(run.said, "");
}

TEST(IndexThreads, ARunThatGrows)
{
  const Folder folder;
  const Files files = mixed_run(folder);
  Series alone;
  Series run;
  run.options.threads = 4;
  for (int round = 0; round < 3; ++round)
  {
    alone.update(files);
    run.update(files);
    EXPECT_TRUE(run.index.encode() == alone.index.encode()) << round;
    EXPECT_EQ(run.said, alone.said) << round;
    for (std::size_t i = 0; i < files.size(); i += 8)
    {
      const std::string more = particles(1000 * (round + 1), ids_from(1, 20));
      std::ofstream(files[i], std::ios::app | std::ios::binary) << more;
    }
  }
}

TEST(IndexThreads, CancelledAtAnyReportThenWhole)
{
  const Folder folder;
  const Files files = mixed_run(folder);
  Series alone;
  alone.update(files);
  bool stopped = true;
  for (int after = 0; stopped; after += 2)
  {
    Series run;
    run.update({ files[0] });
    run.options.threads = 3;
    Notices notices;
    Stop stop(after);
    stopped = false;
    try
    {
      run.index.update(files, run.options, notices, stop);
      EXPECT_GT(after, 0);
      EXPECT_EQ(lines_of(notices), alone.said);
    }
    catch (const granular::Cancelled&)
    {
      stopped = true;
      EXPECT_TRUE(run.index.files().empty());
      EXPECT_EQ(run.index.size(), 0u);
      run.update(files);
      EXPECT_EQ(run.said, alone.said) << after;
    }
    EXPECT_TRUE(run.index.encode() == alone.index.encode()) << after;
  }
}

TEST(IndexThreads, SeekPointsOfTheFirstFiles)
{
  const Folder folder;
  std::string text;
  for (int step = 0; step < 40; ++step)
  {
    text += particles(step, ids_from(1, 2000));
  }
  const std::string packed = packing::gzip(text);
  std::vector<FileIndex> files(12);
  const auto kinds = std::make_shared<granular::FrameKinds>();
  const auto indexed = [&](int threads, std::size_t most)
  {
    for (std::size_t i = 0; i < files.size(); ++i)
    {
      files[i] = {};
      files[i].path = folder.path(std::to_string(i));
      files[i].kinds = kinds;
      files[i].format = &granular::dump_format();
    }
    Progress progress;
    granular::update_files(files, {}, threads, progress, most);
    std::string with_points;
    for (const FileIndex& file : files)
    {
      EXPECT_EQ(file.frames.size(), 40u);
      with_points += file.points ? '1' : '0';
    }
    return with_points;
  };
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    folder.write(std::to_string(i), i == 2 ? text : packed); // the third needs none
  }
  EXPECT_EQ(indexed(1, std::size_t{ 1 } << 28), "110111111111");
  const std::size_t each = files[0].points->bytes();
  ASSERT_GT(each, 32768u);
  for (const int threads : { 1, 2, 8 })
  {
    for (int round = 0; round < 2; ++round)
    {
      EXPECT_EQ(indexed(threads, 4 * each), "110110000000") << threads;
      EXPECT_EQ(indexed(threads, 4 * each - 1), "110100000000") << threads;
      EXPECT_EQ(indexed(threads, 0), "000000000000") << threads;
    }
  }
}

/// A frame of a compressed file by several threads: from places inside, which the index of a file with one frame has only if
/// they take no memory.
TEST(IndexThreads, FramesOfCompressedFiles)
{
  const Folder folder;
  const std::string frame = particles(0, ids_from(1, 200'000));
  const std::string text = frame + particles(100, ids_from(1, 200'000));
  ASSERT_GT(frame.size(), std::size_t{ 3 } << 20) << "there are several places in it";
  const auto members = [](const std::string& bytes)
  {
    std::string packed;
    for (std::size_t at = 0; at < bytes.size(); at += std::size_t{ 1 } << 19)
    {
      packed += packing::gzip(bytes.substr(at, std::size_t{ 1 } << 19));
    }
    return packed;
  };
  const struct
  {
    std::string bytes;
    std::size_t frames;
    bool points;
  } files[] = {
    { packing::gzip(text), 2, true },
    { members(text), 2, true },
    { packing::zstd_frames(text, std::size_t{ 1 } << 19), 2, true },
    { packing::gzip(frame), 1, false },
    { members(frame), 1, true },
    { packing::zstd(frame), 1, false },
    { packing::zstd_frames(frame, std::size_t{ 1 } << 19), 1, true },
  };
  int number = 0;
  for (const auto& file : files)
  {
    const std::string path = folder.write(std::to_string(number++) + ".gz", file.bytes);
    Series run;
    run.update({ path });
    ASSERT_EQ(run.index.size(), file.frames) << path;
    EXPECT_EQ(run.index.files()[0].points != nullptr, file.points) << path;
    for (std::size_t i = 0; i < file.frames; ++i)
    {
      granular::Request request = everything();
      const Decoded alone = run.read(i, request);
      EXPECT_EQ(alone.rows(), 200'000);
      for (const int threads : { 2, 5 })
      {
        request.threads = threads;
        request.chunk_bytes = 100'000;
        const Decoded decoded = run.read(i, request);
        EXPECT_EQ(decoded.points(), alone.points()) << path;
        EXPECT_EQ(decoded.integers("id"), alone.integers("id")) << path;
      }
    }
  }
}
