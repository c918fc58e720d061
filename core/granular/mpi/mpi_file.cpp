// SPDX-License-Identifier: BSD-3-Clause
#include "granular/mpi/mpi_communicator.h"

#include "granular/bytes/byte_sink.h"
#include "granular/common/error.h"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace granular
{
namespace
{
struct Reason
{
  int mpi_class;
  std::errc code;
};

constexpr Reason reasons[] = {
  { MPI_ERR_NO_SPACE, std::errc::no_space_on_device },
  { MPI_ERR_QUOTA, static_cast<std::errc>(EDQUOT) },
  { MPI_ERR_ACCESS, std::errc::permission_denied },
  { MPI_ERR_READ_ONLY, std::errc::read_only_file_system },
  { MPI_ERR_NO_SUCH_FILE, std::errc::no_such_file_or_directory },
};

/// Returns the error that the system would tell; std::errc{} if MPI does not tell.
std::errc code_of(int status)
{
  int mpi_class = MPI_ERR_UNKNOWN;
  MPI_Error_class(status, &mpi_class);
  const auto* const reason = std::find_if(std::begin(reasons), std::end(reasons),
    [&](const Reason& one) { return one.mpi_class == mpi_class; });
  return reason == std::end(reasons) ? std::errc{} : reason->code;
}

/// A file that all ranks write with MPI-IO. Rank 0 creates it and gives it its name, as NewFile does.
class MpiFile final : public OutputFile
{
public:
  /// Stores the arguments; not collective, and the file is not open yet. MPI counts in int: larger data than most_bytes
  /// go in several writes. The ranks must outlive the file.
  MpiFile(Communicator& ranks, const std::string& path, std::int64_t most_bytes)
    : ranks_(ranks)
    , path_(path)
    , most_bytes_(most_bytes)
  {
  }
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

MpiFile::~MpiFile()
{
  if (!name_.empty())
  {
    this->leave();
  }
}

bool MpiFile::open()
{
  std::string name;
  do_together(ranks_,
    [&]
    {
      if (ranks_.rank() == 0)
      {
        made_ = std::make_unique<NewFile>(path_, Locking::Others); // MPI locks files on NFS
        name = made_->temporary_name();
      }
    });
  ranks_.broadcast(name, 0);
  name_ = std::move(name);
  if (name_.find(':') != std::string::npos)
  {
    return false; // ROMIO, and what is made from it, cuts off all up to there
  }
  do_together(ranks_, [&] { this->open_own(); });
  return true;
}

/// Each for itself: where all open it as one and one of them fails, others may wait for ever.
void MpiFile::open_own()
{
  write_into(name_, 0, {}, path_); // Open MPI crashes where it cannot open a file
  MPI_File file = MPI_FILE_NULL;
  this->check(MPI_File_open(MPI_COMM_SELF, name_.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file));
  file_ = file;
  this->check(MPI_File_set_errhandler(file_, MPI_ERRORS_RETURN));
}

void MpiFile::write_at(std::int64_t offset, std::string_view bytes)
{
  while (!bytes.empty())
  {
    int status = MPI_SUCCESS;
    const int done = this->write_some(offset, bytes, status);
    if (done <= 0)
    {
      if (code_of(status) == std::errc{})
      {
        // a full disk may look like this, or like a success of no bytes: the system knows the reason
        write_into(name_, offset, bytes, path_);
      }
      this->check(status == MPI_SUCCESS ? MPI_ERR_IO : status);
    }
    bytes.remove_prefix(static_cast<std::size_t>(done));
    offset += done;
  }
}

/// Gives the bytes that were written, at most as many as fit.
int MpiFile::write_some(std::int64_t offset, std::string_view bytes, int& status)
{
  const auto part =
    static_cast<int>(std::min(most_bytes_, static_cast<std::int64_t>(bytes.size())));
  MPI_Status state = {};
  status = MPI_File_write_at(file_, offset, bytes.data(), part, MPI_BYTE, &state);
  int done = 0;
  if (status == MPI_SUCCESS)
  {
    status = MPI_Get_count(&state, MPI_BYTE, &done);
  }
  return status == MPI_SUCCESS ? done : 0;
}

void MpiFile::finish(bool durable)
{
  do_together(ranks_,
    [&]
    {
      MPI_File file = std::exchange(file_, MPI_FILE_NULL);
      this->check(MPI_File_close(&file));
      if (durable)
      {
        sync_file(name_, path_); // of another machine's bytes the first rank knows nothing
      }
    });
  do_together(ranks_,
    [&]
    {
      if (made_)
      {
        made_->finish(durable);
      }
    });
  name_.clear();
}

/// Nothing is left when the first rank goes on.
void MpiFile::leave() noexcept
{
  if (file_ != MPI_FILE_NULL)
  {
    MPI_File_close(&file_); // what was written is of no use any more
  }
  try
  {
    agree(ranks_, nullptr); // a file that is open elsewhere may not go at once
    made_.reset();
    agree(ranks_, nullptr);
  }
  catch (const IoError&)
  {
    // the ranks have lost each other, and rank 0 removes the file nevertheless
  }
}

void MpiFile::check(int status) const
{
  if (status == MPI_SUCCESS)
  {
    return;
  }
  const std::errc code = code_of(status);
  if (code != std::errc{})
  {
    throw IoError("cannot write: " + std::make_error_code(code).message(), { path_ }, code);
  }
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(status, text, &length);
  throw IoError("cannot write: " + std::string(text, static_cast<std::size_t>(length)), { path_ },
    std::errc::io_error);
}
}

std::unique_ptr<OutputFile> MpiCommunicator::open_together(const std::string& path)
{
  std::unique_ptr<MpiFile> file;
  do_together(*this, [&] { file = std::make_unique<MpiFile>(*this, path, most_bytes_); });
  return file->open() ? std::move(file) : nullptr;
}
}
