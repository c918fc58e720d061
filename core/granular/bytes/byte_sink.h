// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_byte_sink_h
#define granular_bytes_byte_sink_h

#include "granular/bytes/byte_source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace granular
{
/// Survival of a new file in a crash of the whole system, as a loss of power, once it has its name. The numbers are those
/// of the C interface and of VTK.
enum class Durability : std::uint8_t
{
  Off, ///< the system writes to the disk when it likes; whole after a crash of the program alone
  On,  ///< the bytes are on the disk before the name is, and the name before finish() returns
  Automatic ///< On for one file, Off for a series of files: see is_durable
};

/// A file that is written under a temporary name and takes the place of the old file when it is complete. Without
/// finish() the temporary file is removed and the old file stays untouched.
class OutputFile
{
public:
  OutputFile() = default;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  virtual ~OutputFile() = default;

  /// Writes bytes at an offset, in any order, also beyond the end; gaps are filled with zeros. May be called from any
  /// thread for NewFile. Throws IoError; the content of that range is then undefined.
  virtual void write_at(std::int64_t offset, std::string_view bytes) = 0;

  /// Gives the file its name. No other call may follow. durable: as Durability::On. Throws IoError; collective if opened by
  /// open_together.
  virtual void finish(bool durable) = 0;
};

/// The holder of the locks of a file's bytes.
enum class Locking : std::uint8_t
{
  Own,   ///< this object
  Others ///< who writes by the temporary name, or gives it to another file: the lock is then on a file beside it
};

/// A new file under a hidden name in the folder of another file, its target: `.granular-0123456789abcdef-0.tmp`. The hexadecimal
/// number stands for this machine and the target's name. The file is locked while it is open, so a file whose lock is free was
/// left behind by a program that has died. Machines never share such a name, because on some file systems each sees only its
/// own locks.
class LockedFile
{
public:
  /// Ending of a second file, which belongs to the first: a new name may not lock what others lock in their ways.
  static constexpr const char* data_ending = ".data";

  /// Removes the files that dead programs of this machine and user have left behind for the target, then creates a file with
  /// these permissions. Throws std::system_error.
  LockedFile(const std::string& target, unsigned permissions);
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  /// Closes the file, and removes it if it still has its name. A child of the process leaves it to its parent.
  ~LockedFile();

  int descriptor() const noexcept { return file_; }
  const std::string& name() const noexcept { return name_; }

  /// Returns true if the name still is that of this file.
  bool has_name() const noexcept;

  /// Closes the file, which stays: many may wait for their names, and a process may have few files open. Another program that
  /// writes the same target may now take it for a file that was left behind; has_name() then returns false.
  void close() noexcept;

  /// Returns true in the process that created the file, and false in its children, which have a copy of this object.
  bool is_own() const noexcept;

private:
  std::string name_;
  int file_ = -1;    ///< -1: closed
  int process_ = 0;  ///< that created the file
  FileStamp closed_; ///< of a closed file
};

/// An output file that one rank writes. A symbolic link stays, and the file that it points to is replaced. Permissions,
/// owner and group are those of the old file, or what the umask leaves. An old file whose owner or group cannot be kept, and
/// something at the path that is not a regular file, are errors.
///
/// A program that is killed leaves its temporary file behind. The next NewFile of the same path on the same machine removes
/// it: see LockedFile. A child of the process, which has a copy of this object, cannot touch the file.
class NewFile final : public OutputFile
{
public:
  /// Opens a temporary file in the folder of path. Throws IoError.
  explicit NewFile(const std::string& path, Locking locking = Locking::Own);
  ~NewFile() override;

  void write_at(std::int64_t offset, std::string_view bytes) override;

  /// Completes the file and closes it, so that many can wait for their names. Only finish() may follow. durable: as for
  /// finish(). Throws IoError.
  void hold(bool durable);

  /// Throws IoError also if the folder cannot be synchronised; the new file has its name then.
  void finish(bool durable) override;

  /// Throws IoError if another writer has taken the temporary file away, as it may do with one that is held.
  void expect_name() const;

  const std::string& path() const noexcept { return path_; }

  /// Returns the path behind all symbolic links.
  const std::string& target() const noexcept { return target_; }

  /// Returns the temporary name, which is in the same folder.
  const std::string& temporary_name() const noexcept { return name_; }

private:
  void create(Locking locking);
  void keep_owner() const;
  void expect_own() const;
  void complete(bool durable) const;
  void set_permissions() const;
  void expect_written() const;
  void remove() noexcept;
  void close() noexcept;

  std::string path_;   ///< as it was given
  std::string target_; ///< behind all links
  std::optional<LockedFile> locked_;
  std::string name_;     ///< of the data
  int file_ = -1;        ///< the data: that of locked_, or one beside it; -1: complete
  int permissions_ = -1; ///< of the old file; -1: there is none
  unsigned owner_ = 0;   ///< of the old file
  unsigned group_ = 0;   ///< of the old file
};

/// Writes into the existing file `name` at an offset, also beyond its end. Throws IoError that names path.
void write_into(
  const std::string& name, std::int64_t offset, std::string_view bytes, const std::string& path);

/// Returns when all bytes of the existing file `name` that this machine has are on the disk; a file system that cannot
/// tell is none of the errors. Throws IoError that names path.
void sync_file(const std::string& name, const std::string& path);
}
#endif
