// SPDX-License-Identifier: BSD-3-Clause
// Small compressed files with much in them: refused by a limit that the error names and that can be raised, in little memory and
// no more time than the limit takes.
#include "../support/byte_source_packing.h"
#include "../support/own_folder.h"

#include "granular/common/error.h"
#include "granular/dump/formats/dump_files.h"
#include "granular/frames/run_index.h"
#include "granular/restart/restart_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include <sys/resource.h>

namespace
{
using Bombs = OwnFolder;

constexpr std::size_t part = std::size_t{ 1 } << 20; ///< of the content
constexpr int beyond = 270; ///< parts of content that is not read whatever its file
constexpr int within = 250;

/// The header of a dump and so many parts of its equal rows, each packed by itself.
template <class Pack>
std::string dump_of(int parts, const Pack& pack)
{
  std::string rows;
  while (rows.size() < part)
  {
    rows += "1 1 0 0 0\n";
  }
  const std::string header = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" +
    std::to_string(static_cast<std::int64_t>(parts) * static_cast<std::int64_t>(rows.size() / 10)) +
    "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z\n";
  std::string packed = pack(header);
  const std::string packed_rows = pack(rows);
  for (int i = 0; i < parts; ++i)
  {
    packed += packed_rows;
  }
  return packed;
}

std::string gzip(const std::string& content)
{
  return packing::gzip(content);
}

std::string zstd(const std::string& content)
{
  return packing::zstd(content);
}

/// The error of opening; empty: none. The process must not have grown by much.
std::string error_of(const std::string& path, std::int64_t largest_expansion,
  const granular::FileFormat& format = granular::dump_format())
{
  const auto peak = []
  {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return std::int64_t{ usage.ru_maxrss } << 10;
  };
  const std::int64_t before = peak();
  granular::IndexOptions options{ .format = &format };
  options.largest_expansion = largest_expansion;
  granular::RunIndex run;
  granular::Notices notices;
  granular::Progress progress;
  std::string error;
  try
  {
    run.update({ path }, options, notices, progress);
  }
  catch (const granular::LimitError& caught)
  {
    error = caught.what();
  }
  EXPECT_LT(peak() - before, std::int64_t{ 64 } << 20);
  return error;
}

void expect_limit(const std::string& path, const std::string& bytes)
{
  const std::string error = error_of(path, granular::usual_expansion);
  EXPECT_TRUE(error.starts_with(path + "@")) << error;
  EXPECT_NE(error.find("expected content of at most 200 times the " + std::to_string(bytes.size()) +
              " bytes of the file, got more; raise LargestExpansion if you trust the file"),
    error.npos)
    << error;
  EXPECT_EQ(error_of(path, 100'000), "");
}
}

TEST_F(Bombs, Gzip)
{
  const std::string bytes = dump_of(beyond, gzip);
  expect_limit(this->write("a.dump.gz", bytes), bytes);
}

TEST_F(Bombs, Zstandard)
{
  const std::string bytes = dump_of(beyond, zstd);
  expect_limit(this->write("a.dump.zst", bytes), bytes);
}

TEST_F(Bombs, SmallContentIsReadWhateverItsFile)
{
  EXPECT_EQ(error_of(this->write("a.dump.zst", dump_of(within, zstd)), 1), "");
}

// The content of a compressed restart file is held in memory, up to the limit.
TEST_F(Bombs, ZerosThatPassForARestartFile)
{
  std::string packed;
  const std::string zeros = zstd(std::string(part, '\0'));
  for (int i = 0; i < beyond; ++i)
  {
    packed += zeros;
  }
  const std::string path = this->write("a.restart", packed);
  granular::IndexOptions options{ .format = &granular::restart_format() };
  granular::RunIndex run;
  granular::Notices notices;
  granular::Progress progress;
  EXPECT_THROW(run.update({ path }, options, notices, progress), granular::Error);
}

// Packed files within packed files are not unpacked.
TEST_F(Bombs, Nested)
{
  const std::string path =
    this->write("a.dump.gz", packing::gzip(packing::gzip("ITEM: TIMESTEP\n0\n")));
  granular::IndexOptions options{ .format = &granular::dump_format() };
  granular::RunIndex run;
  granular::Notices notices;
  granular::Progress progress;
  EXPECT_THROW(run.update({ path }, options, notices, progress), granular::FormatError);
}

// Members and frames without content: a million of them end, and are no seek points.
TEST_F(Bombs, EmptyParts)
{
  for (const std::string& empty :
    { packing::gzip(""), packing::zstd(""), packing::zstd_skippable("") })
  {
    std::string packed = empty;
    while (packed.size() < (std::size_t{ 4 } << 20))
    {
      packed += empty;
    }
    const auto points = packing::spaced(1);
    const auto source = packing::open(packed, points);
    EXPECT_EQ(packing::read_all(*source), "");
    EXPECT_LE(points->bytes(), std::size_t{ 1 } << 20);
  }
}
