// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: the bytes of one process from real ranks, and their errors.
#include "granular/mpi/mpi_communicator.h"

#include "../support/dump_writing.h"
#include "../support/dumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace
{
using namespace granular;

constexpr ParallelMode modes[] = { ParallelMode::Gather, ParallelMode::MpiIo };

/// A folder that all ranks use, made by the first.
std::string common_folder(Communicator& ranks, const std::string& name)
{
  const std::string folder = std::string(GRANULAR_OUTPUT) + "/" + name;
  if (ranks.rank() == 0)
  {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  agree(ranks, nullptr);
  return folder;
}

/// This rank's rows: the last has most, the first of several none.
FrameView own_rows(const FrameView& whole, const Communicator& ranks)
{
  const std::int64_t first = std::max(ranks.rank() - 1, 0) * std::int64_t{ 5000 };
  const bool last = ranks.rank() + 1 == ranks.size();
  const std::int64_t end = last ? whole.rows : ranks.rank() * std::int64_t{ 5000 };
  return rows_of(whole, first, end - first);
}

std::string write(const std::string& path, const Frames& frames, const DumpFormat& format,
  const WriteOptions& options, Communicator& ranks)
{
  return error_of(
    [&]
    {
      Notices notices;
      Progress progress;
      DumpWriter writer(path, format, options, ranks);
      for (const FrameView& frame : frames)
      {
        writer.write(own_rows(frame, ranks), notices, progress);
      }
      writer.finish();
    });
}
}

TEST(WriteMpi, same_bytes)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const std::string folder = common_folder(ranks, "same_bytes");
  for (const Form& form : all_forms())
  {
    const MadeRows rows(30000, small_box(form.tilted));
    for (const bool sorted : { false, true })
    {
      DumpFormat format = atom_format(form, Dialect::Lammps);
      format.sort_by_id = sorted;
      Frames frames = { rows.view(), rows.view() };
      frames[1].header.timestep = 200;
      const std::string expected =
        ranks.rank() == 0 ? write_dump(folder + "/alone", frames, format).bytes : "";
      for (const ParallelMode mode : modes)
      {
        const std::string path = folder + "/together";
        EXPECT_EQ(write(path, frames, format, { mode, 2 }, ranks), "");
        EXPECT_EQ(ranks.rank() == 0 ? difference(bytes_of_file(path), expected) : "", "")
          << form.name() << ", mode " << static_cast<int>(mode);
        agree(ranks, nullptr);
      }
    }
  }
}

/// An error of one rank is that of all, and the next file is written as if nothing had been.
TEST(WriteMpi, error_and_another_try)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const std::string folder = common_folder(ranks, "error");
  const MadeRows good(60000, small_box(false));
  MadeRows bad(60000, small_box(false));
  bad.words[20000] = "";
  FrameView later = bad.view();
  later.header.timestep = 200;
  const std::string path = folder + "/file";
  const int last = ranks.size() - 1;
  const std::string error = "column 'element': expected a word, got ''" +
    (last == 0 ? ""
               : " (on rank " + std::to_string(last) + " of " + std::to_string(last + 1) + ")");
  for (int round = 0; round < 3; ++round)
  {
    for (const ParallelMode mode : modes)
    {
      EXPECT_EQ(write(path, { good.view(), later }, {}, { mode, 1 }, ranks), error);
      EXPECT_EQ(write(path, { good.view() }, {}, { mode, 2 }, ranks), "");
      EXPECT_EQ(ranks.rank() == 0 ? names_in(folder) : "", ranks.rank() == 0 ? "file" : "");
      agree(ranks, nullptr);
    }
  }
  EXPECT_EQ(write(folder + "/no/file", { good.view() }, {}, {}, ranks),
    folder + "/no/file: cannot write: No such file or directory" +
      (last == 0 ? "" : " (on rank 0 of " + std::to_string(last + 1) + ")"));
}
