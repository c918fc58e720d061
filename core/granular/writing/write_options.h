// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_writing_write_options_h
#define granular_writing_write_options_h

#include "granular/bytes/byte_sink.h"
#include "granular/frames/input_files.h"

#include <cstdint>

namespace granular
{
/// Ways of ranks to write a file together.
enum class ParallelMode : std::uint8_t
{
  Gather, ///< the first rank writes; the others send their rows, one rank after the other, chunk by chunk
  MpiIo ///< each rank writes its rows in place; Gather for compressed files and ranks without MPI-IO
};

/// Options of the writing that do not change the bytes.
struct WriteOptions
{
  ParallelMode mode = ParallelMode::Gather;
  int threads = 1; ///< at least 1, of each rank
  Durability durable = Durability::Automatic;
  const InputFiles* inputs =
    nullptr; ///< files that are read meanwhile, the same on all ranks; null: none
};
}
#endif
