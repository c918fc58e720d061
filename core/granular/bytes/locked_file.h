// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_locked_file_h
#define granular_bytes_locked_file_h

#include "granular/bytes/byte_source.h"

#include <string>

namespace granular
{
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
}
#endif
