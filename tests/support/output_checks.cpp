// SPDX-License-Identifier: BSD-3-Clause
// Files that ranks write together.
#include "communicator_checks.h"
#include "dumps.h"
#include "small_disk.h"
#include "write_file.h"

#include "granular/bytes/byte_sink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

namespace
{
namespace fs = std::filesystem;
using granular::Communicator;
using granular::do_together;

std::string content(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

/// Blocks of many sizes, some of none. Every third rank has nothing to write.
constexpr int blocks = 200;
std::string block(int number)
{
  const auto bytes = static_cast<std::size_t>(number % 7 == 0 ? 0 : number * 37 % 1001);
  return std::string(bytes, static_cast<char>('!' + number % 90));
}
int owner(const Communicator& ranks, int number)
{
  const int rank = number % ranks.size();
  return rank % 3 == 2 ? 0 : rank;
}

/// One line for all ranks: what work throws as an IoError on each of them.
template <class Work>
std::string error_of(Communicator& ranks, const Work& work)
{
  std::string said;
  std::errc code = {};
  try
  {
    work();
    said = "no error";
  }
  catch (const granular::IoError& error)
  {
    said = error.what();
    code = error.code();
  }
  const std::vector<std::string> all =
    ranks.all_gather(said + std::to_string(static_cast<int>(code)));
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 1u) << "not the same on all";
  return said;
}

/// As agreed errors have it.
std::string on_rank_0(const Communicator& ranks)
{
  return ranks.size() == 1 ? "" : " (on rank 0 of " + std::to_string(ranks.size()) + ")";
}
}

void empty_folder(Communicator& ranks, const std::string& folder)
{
  do_together(ranks,
    [&]
    {
      if (ranks.rank() == 0)
      {
        fs::remove_all(folder);
        fs::create_directories(folder);
      }
    });
}

std::string open_together_error(Communicator& ranks, const std::string& path)
{
  return error_of(ranks, [&] { ranks.open_together(path); });
}

void check_open_together(Communicator& ranks, const std::string& folder)
{
  empty_folder(ranks, folder);
  const std::string path = folder + "/file";
  for (const bool there : { false, true })
  {
    const std::unique_ptr<granular::OutputFile> file = ranks.open_together(path);
    ASSERT_TRUE(file);
    std::string expected;
    do_together(ranks,
      [&]
      {
        for (int number = 0; number < blocks; ++number)
        {
          // from the end, so that there is something to fill
          std::int64_t offset = 0;
          for (int before = 0; before < blocks - 1 - number; ++before)
          {
            offset += static_cast<std::int64_t>(block(before).size());
          }
          if (owner(ranks, blocks - 1 - number) == ranks.rank())
          {
            file->write_at(offset, block(blocks - 1 - number));
          }
          expected += block(number);
        }
      });
    EXPECT_EQ(fs::exists(path), there) << "it has no name before it is finished";
    do_together(ranks, [] {});
    file->finish(true);
    EXPECT_TRUE(content(path) == expected);
    EXPECT_EQ(names_in(folder), "file");
    do_together(ranks, [] {});
  }
}

void check_open_together_fails(Communicator& ranks, const std::string& folder)
{
  empty_folder(ranks, folder);
  const std::string path = folder + "/file";
  do_together(ranks,
    [&]
    {
      if (ranks.rank() == 0)
      {
        write_file(path, "old");
      }
    });

  std::unique_ptr<granular::OutputFile> file = ranks.open_together(path);
  file->write_at(ranks.rank(), "x");
  file.reset();
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(names_in(folder), "file");

  const std::string where = on_rank_0(ranks);
  EXPECT_EQ(open_together_error(ranks, folder), folder + ": cannot write: Is a directory" + where);
  EXPECT_EQ(
    open_together_error(ranks, path + "/x"), path + "/x: cannot write: Not a directory" + where);
  EXPECT_EQ(open_together_error(ranks, "/dev/null"),
    "/dev/null: cannot write: expected a file, got a device or a pipe" + where);

  // the name is taken by a folder before the file is complete
  const std::string taken = folder + "/taken";
  file = ranks.open_together(taken);
  do_together(ranks,
    [&]
    {
      if (ranks.rank() == 0)
      {
        fs::create_directory(taken);
      }
    });
  EXPECT_EQ(
    error_of(ranks, [&] { file->finish(true); }), taken + ": cannot write: Is a directory" + where);
  file.reset();
  EXPECT_EQ(names_in(folder), "file taken");
  do_together(ranks, [] {});
}

bool check_full_disk(Communicator& ranks, const std::string& folder)
{
  empty_folder(ranks, folder);
  std::optional<SmallDisk> disk;
  std::string there;
  if (ranks.rank() == 0)
  {
    disk.emplace(folder + "/disk");
    there = disk->there() ? "yes" : "no";
  }
  ranks.broadcast(there, 0);
  if (there == "no")
  {
    return false;
  }
  const std::string path = folder + "/disk/file";
  if (ranks.rank() == 0)
  {
    write_file(path, "old");
  }
  const std::string bytes(300'000 / static_cast<std::size_t>(ranks.size()) + 1, 'x');
  std::unique_ptr<granular::OutputFile> file = ranks.open_together(path);
  const std::string error = error_of(ranks,
    [&]
    {
      do_together(ranks,
        [&] { file->write_at(ranks.rank() * static_cast<std::int64_t>(bytes.size()), bytes); });
    });
  const std::string expected = path + ": cannot write: No space left on device";
  EXPECT_EQ(error.substr(0, expected.size()), expected);
  file.reset();
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(names_in(folder + "/disk"), "file");
  do_together(ranks, [] {});
  return true;
}
