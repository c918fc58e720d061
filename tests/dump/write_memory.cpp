// SPDX-License-Identifier: BSD-3-Clause
// Rows are written by the batch: what is needed beside them does not grow with their number.
#include "../support/dump_writing.h"
#include "../support/dumps.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <malloc.h>

namespace
{
using namespace granular;

std::int64_t status_bytes(const std::string& name)
{
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
  {
    if (line.starts_with(name))
    {
      return 1024 * std::stol(line.substr(name.size()));
    }
  }
  return -1;
}

/// Lets the system count the most memory from now on. Sanitizers have memory of their own.
bool forget_peak()
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return false;
#else
  ::mallopt(M_MMAP_THRESHOLD, 1 << 16); // so that what is freed is given back
  ::malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << "5";
  file.close();
  return !file.fail() && status_bytes("VmHWM:") > 0;
#endif
}

/// 3 million rows, whose memory has been touched.
struct ManyRows
{
  static constexpr std::int64_t count = 3000000;

  ManyRows()
    : ids(count)
    , types(count, 1)
    , points(3 * count)
  {
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      ids[i] = static_cast<std::int64_t>(i * 7919 % count) + 1;
      for (std::size_t k = 0; k < 3; ++k)
      {
        points[3 * i + k] = static_cast<double>(i * (k + 3) % 9973) / 997;
      }
    }
  }

  FrameView view() const
  {
    FrameHeader header;
    header.box = Box::from_bounds({ 0, 0, 0 }, { 10.1, 10.1, 10.1 });
    header.box.boundary = "pp pp pp";
    return view_atoms({ count, ids.data(), types.data(), points.data(), nullptr }, header);
  }

  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> types;
  std::vector<double> points;
};

constexpr std::int64_t most = std::int64_t{ 64 } << 20;

/// The most that this process has had of memory while it wrote, over what it had before.
std::int64_t needed(const ManyRows& rows, int ranks, const DumpFormat& format, WriteOptions options)
{
  const Folder folder;
  std::int64_t shares = ManyRows::count / ranks;
  if (!forget_peak())
  {
    return -1;
  }
  const std::int64_t before = status_bytes("VmRSS:");
  std::vector<std::string> errors(static_cast<std::size_t>(ranks));
  run_ranks(ranks,
    [&](Communicator& own)
    {
      Notices notices;
      Progress progress;
      const std::int64_t first = own.rank() * shares;
      const FrameView part =
        rows_of(rows.view(), first, own.rank() + 1 == ranks ? ManyRows::count - first : shares);
      errors[static_cast<std::size_t>(own.rank())] = error_of(
        [&]
        {
          DumpWriter writer(folder.path("a"), format, options, own);
          writer.write(part, notices, progress);
          writer.finish();
        });
    });
  const std::int64_t peak = status_bytes("VmHWM:") - before;
  EXPECT_EQ(errors.front(), "");
  EXPECT_GT(std::filesystem::file_size(folder.path("a")),
    75000000U / (format.compression == Compression::None ? 1U : 20U));
  std::filesystem::remove(folder.path("a"));
  return peak;
}
}

TEST(WriteMemory, beside_the_rows)
{
  const ManyRows rows;
  std::int64_t worst = 0;
  for (const Form& form :
    { Form{ { true, false }, false, false }, Form{ { false, true }, false, true } })
  {
    const DumpFormat format = atom_format(form, Dialect::Lammps);
    const int threads = form.binary ? 1 : 4;
    const std::int64_t bytes = needed(rows, 1, format, { ParallelMode::Gather, threads });
    if (bytes < 0)
    {
      GTEST_SKIP() << "the system does not tell";
    }
    worst = std::max(worst, bytes);
    EXPECT_LE(bytes, most) << form.name() << ", threads " << threads;
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_GT(worst, 0);
}

/// Ranks that are threads have their memory together.
TEST(WriteMemory, beside_the_rows_of_ranks)
{
  const ManyRows rows;
  const DumpFormat format = atom_format({ { true, false }, false, false }, Dialect::Lammps);
  for (const ParallelMode mode : { ParallelMode::Gather, ParallelMode::MpiIo })
  {
    const int threads = mode == ParallelMode::Gather ? 4 : 1;
    const std::int64_t bytes = needed(rows, 3, format, { mode, threads });
    if (bytes < 0)
    {
      GTEST_SKIP() << "the system does not tell";
    }
    EXPECT_LE(bytes, most) << "mode " << static_cast<int>(mode) << ", threads " << threads;
  }
}
