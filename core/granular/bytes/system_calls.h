// SPDX-License-Identifier: BSD-3-Clause
// Private to the files of this room. The system's calls for files, once for POSIX and once for Windows. Names are UTF-8 with
// slashes. A call that fails returns -1 and sets errno.
#ifndef granular_bytes_system_calls_h
#define granular_bytes_system_calls_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// Throws IoError for a directory, or for something else that is not a regular file.
[[noreturn]] inline void refuse_no_file(const std::string& path, bool is_folder)
{
  throw IoError(std::string("expected a file, got ") +
      (is_folder ? "a directory: name the files in it" : "a device or a pipe"),
    { path }, is_folder ? std::errc::is_a_directory : std::errc::not_supported);
}

namespace os
{
enum class Kind : std::uint8_t
{
  File,
  Folder,
  Link,
  Other ///< a device or a pipe
};

/// Windows has no numbers for permissions, owner and group: there they are the same for all files.
struct Status
{
  Kind kind = Kind::Other;
  FileStamp stamp = {};
  unsigned permissions = 0;
  unsigned owner = 0;
  unsigned group = 0;
};

/// Ways to open a file.
enum class Opening : std::uint8_t
{
  Read,      ///< does not wait for the other end of a pipe
  Write,     ///< what is there
  ReadSame,  ///< not what a link points to
  WriteSame, ///< not what a link points to, and does not wait
  Create,    ///< fails if the name is taken
  Folder     ///< to synchronise it; EACCES where that is not needed
};

/// Returns a descriptor that children of the process do not inherit.
int open(const std::string& name, Opening how, unsigned permissions = 0) noexcept;
int close(int file) noexcept;

std::ptrdiff_t read_at(int file, char* buffer, std::size_t bytes, std::int64_t offset) noexcept;
std::ptrdiff_t write_at(
  int file, const char* bytes, std::size_t count, std::int64_t offset) noexcept;

/// Returns when the bytes are on the disk.
int sync(int file) noexcept;

/// Locks a file for its descriptor, or fails at once with EWOULDBLOCK.
int lock(int file) noexcept;

/// Makes a file's time of change the last one: Windows would set it when the file is closed.
int settle(int file) noexcept;

int status_of(int file, Status& status) noexcept;

/// behind_links: of the file that a link points to.
int status_of(const std::string& name, Status& status, bool behind_links = false) noexcept;

int set_owner(int file, unsigned owner, unsigned group) noexcept;
int set_permissions(int file, unsigned permissions) noexcept;

/// Returns another descriptor of the same file.
int duplicate(int file) noexcept;

/// Lets the descriptor `to` be another one of the file `from`.
int duplicate_to(int from, int to) noexcept;

/// Windows: closes the file, because an open file cannot be replaced, and makes its descriptor a duplicate of `other`.
int let_replace(int file, int other) noexcept;

/// Succeeds if this user may write a file.
int may_write(const std::string& name) noexcept;

int remove(const std::string& name) noexcept;

/// Renames a file, and replaces `to` atomically if it is there.
int rename(const std::string& from, const std::string& to) noexcept;

/// Removes the files and folders in a folder whose names begin like this, as far as the system tells them.
void remove_all(const std::string& folder, const std::string& begin) noexcept;

/// Succeeds if the names in a folder can be listed.
int list(const std::string& folder);

/// Returns the names that fit a pattern of the shell, in any order.
std::vector<std::string> glob(const std::string& pattern);

/// Returns the name with all its folders.
std::string absolute(const std::string& name);

/// Returns the path behind all symbolic links, there or not; empty and errno if there are too many.
std::string follow(const std::string& path);

/// Returns the number of the user, 0 for one who may do all.
unsigned user() noexcept;
int process() noexcept;

/// Returns the machine's name; empty: not known.
std::string machine();
}
}
#endif
