// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_writing_file_names_h
#define granular_writing_file_names_h

#include "granular/bytes/byte_sink.h"
#include "granular/bytes/compression.h"
#include "granular/frames/input_files.h"

#include <cstdint>
#include <set>
#include <string>
#include <string_view>

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

/// Returns true if a name is that of a binary dump: it ends in .bin or .lammpsbin, before an ending for compression.
bool is_binary_name(std::string_view path) noexcept;

/// Returns the compression that a name ends in: .gz, .zst.
Compression compression_of_name(std::string_view path) noexcept;

/// Returns the name with the first '*' replaced by the timestep, as in the dump command; folders are left alone.
std::string name_of_step(const std::string& path, std::int64_t timestep);

/// Adds a timestep to those that are written, and returns the name of its file. Throws Error for one that is written already.
std::string name_of_new_step(
  const std::string& path, std::int64_t timestep, std::set<std::int64_t>& written);

/// Returns true if each frame is a file of its own: the name holds '*'.
bool is_name_of_steps(const std::string& path) noexcept;

/// Returns whether the files of this name are made to survive a crash of the system. Automatic: all but those of a series, a
/// file for each frame, where waiting for the disk takes longer than writing.
bool is_durable(Durability durability, const std::string& path) noexcept;

/// Returns true if ranks write files of their own: the name holds '%'.
bool is_name_of_ranks(const std::string& path) noexcept;

/// Returns the name with '%' replaced by the rank.
std::string name_of_rank(const std::string& path, int rank);
}
#endif
