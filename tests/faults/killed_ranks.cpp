// SPDX-License-Identifier: BSD-3-Clause
// Run by killed_ranks.py under mpirun: ranks that write a file together, one of which is killed.
// Arguments: the file, Gather or MPI-IO, On or Off for durability, the rank to kill (-1: none) and after how many seconds.
#include "../support/dump_writing.h"

#include "granular/mpi/mpi_communicator.h"

#include <mpi.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>

#include <unistd.h>

namespace
{
using namespace granular;

/// Kills this process after some time, while it does something else.
void kill_after(double seconds)
{
  const pid_t self = ::getpid();
  if (::fork() == 0)
  {
    ::usleep(static_cast<useconds_t>(seconds * 1e6));
    ::kill(self, SIGKILL);
    ::_exit(0);
  }
}

void write(const std::string& path, const DumpFormat& format, const WriteOptions& options,
  const FrameView& own, Communicator& ranks)
{
  Notices notices;
  Progress progress;
  DumpWriter writer(path, format, options, ranks);
  for (int frame = 0; frame < 3; ++frame)
  {
    writer.write(own, notices, progress);
  }
  writer.finish();
}
}

int main(int argc, char** argv)
{
  if (argc != 6)
  {
    return 2;
  }
  MPI_Init(&argc, &argv);
  {
    MpiCommunicator ranks(MPI_COMM_WORLD);
    std::ofstream("rank_" + std::to_string(ranks.rank())) << ::getpid();
    const MadeRows rows(30000, small_box(false));
    const std::int64_t share = rows.view().rows / ranks.size();
    const FrameView whole = rows.view();
    const std::string path = argv[1];
    DumpFormat format;
    format.binary = is_binary_name(path);
    format.compression = compression_of_name(path);
    const WriteOptions options = { argv[2] == std::string("Gather") ? ParallelMode::Gather
                                                                    : ParallelMode::MpiIo,
      1, argv[3] == std::string("On") ? Durability::On : Durability::Off };
    agree(ranks, nullptr);
    const auto begin = std::chrono::steady_clock::now();
    if (std::atoi(argv[4]) == ranks.rank())
    {
      kill_after(std::atof(argv[5]));
    }
    write(path, format, options, rows_of(whole, ranks.rank() * share, share), ranks);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    if (ranks.rank() == 0)
    {
      std::ofstream("took") << took.count();
    }
  }
  MPI_Finalize();
}
