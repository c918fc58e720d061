// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_mpi_mpi_file_h
#define granular_mpi_mpi_file_h

#include "granular/bytes/byte_sink.h"
#include "granular/parallel/communicator.h"

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace granular
{
/// A file that all ranks write with MPI-IO. Rank 0 creates it and gives it its name, as NewFile does.
class MpiFile final : public OutputFile
{
public:
  /// Stores the arguments; not collective, and the file is not open yet. MPI counts in int: larger data than most_bytes
  /// go in several writes. The ranks must outlive the file.
  MpiFile(Communicator& ranks, const std::string& path, std::int64_t most_bytes);
  ~MpiFile() override;

  /// Opens the file. Throws IoError on all ranks if one cannot open it. Returns false, and the object is unusable, if
  /// the path contains a colon: MPI may read it as the name of a file system. Collective.
  bool open();

  void write_at(std::int64_t offset, std::string_view bytes) override;
  void finish(bool durable) override;

private:
  void open_own();
  void check(int status) const;
  int write_some(std::int64_t offset, std::string_view bytes, int& status);
  void leave() noexcept;

  Communicator& ranks_;
  std::string path_;
  std::string name_; ///< of the file while it is written; empty: there is none
  std::int64_t most_bytes_;
  std::unique_ptr<NewFile> made_; ///< of rank 0
  MPI_File file_ = MPI_FILE_NULL;
};
}
#endif
