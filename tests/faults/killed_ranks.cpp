// SPDX-License-Identifier: BSD-3-Clause
// Run by killed_ranks.py under mpirun: ranks that write files together, one of which is killed at a call of the system.
// Arguments, for each file: its name, Gather or MPI-IO, On or Off for durability, the rank to kill (-1: none) and at which call.
// Each rank writes the number of its calls for each file, one a line, to most_RANK.
#include "../support/dump_writing.h"
#include "../support/dying_calls.h"

#include "granular/mpi/mpi_communicator.h"

#include <mpi.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

#include <unistd.h>

namespace
{
using namespace granular;

void write(const char* const* arguments, FrameView own, Communicator& ranks)
{
  const std::string path = arguments[0];
  DumpFormat format;
  format.binary = is_binary_name(path);
  format.compression = compression_of_name(path);
  const WriteOptions options = { arguments[1] == std::string("Gather") ? ParallelMode::Gather
                                                                       : ParallelMode::MpiIo,
    1, arguments[2] == std::string("On") ? Durability::On : Durability::Off };
  Notices notices;
  Progress progress;
  DumpWriter writer(path, format, options, ranks);
  for (own.header.timestep = 0; own.header.timestep < 3; ++own.header.timestep)
  {
    writer.write(own, notices, progress);
  }
  writer.finish();
}
}

int main(int argc, char** argv)
{
  constexpr int arguments = 5; // for each file
  MPI_Init(&argc, &argv);
  {
    MpiCommunicator ranks(MPI_COMM_WORLD);
    const std::string own = std::to_string(ranks.rank());
    std::ofstream("rank_" + own) << ::getpid();
    const MadeRows rows(12000, small_box(false));
    const std::int64_t share = rows.view().rows / ranks.size();
    const FrameView part = rows_of(rows.view(), ranks.rank() * share, share);
    std::ofstream most("most_" + own);
    for (int i = 1; i + arguments <= argc; i += arguments)
    {
      agree(ranks, nullptr);
      constexpr long never = std::numeric_limits<long>::max();
      const bool dies = std::atoi(argv[i + 3]) == ranks.rank();
      die_at_call(dies ? std::atol(argv[i + 4]) : never);
      write(argv + i, part, ranks);
      const long left = calls_before_death();
      die_at_call(0);
      most << never - left << "\n";
    }
  }
  MPI_Finalize();
}
