// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_error_h
#define granular_common_error_h

#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace granular
{
/// A position in a file. Unknown members keep their defaults and are not printed.
struct Where
{
  std::string path = {};
  std::int64_t line = 0;   ///< first line is 1; 0: not known or not a text file
  std::int64_t byte = -1;  ///< first byte is 0; -1: not known
  std::string column = {}; ///< name of the column as the file spells it
};

/// Returns a file name, or a text with words of a user, for a message. It is on one line and in UTF-8: control characters become
/// \n, \t or \x1b, and bytes that are not UTF-8 become \xff.
std::string shown_path(std::string_view path);

/// Returns "path:line: column 'name'" or "path@byte: column 'name'", as far as known.
std::string to_string(const Where& where);

/// Base of all errors of the core. what() is "place: text": lower case, says expected and got.
class Error : public std::runtime_error
{
public:
  explicit Error(const std::string& text, Where where = {});
  const Where& where() const noexcept { return where_; }

  /// Returns what() without the position.
  const std::string& text() const noexcept { return text_; }

private:
  std::string text_;
  Where where_;
};

/// The operating system refused an operation (open, read, stat), or the file changed meanwhile.
class IoError : public Error
{
public:
  explicit IoError(const std::string& text, Where where = {}, std::errc code = {});

  /// Returns the system's error code; std::errc{} if the file exists but has changed.
  std::errc code() const noexcept { return code_; }

private:
  std::errc code_;
};

/// The bytes contradict the format.
class FormatError : public Error
{
  using Error::Error;
};

/// Larger than a documented limit of the format or of this library.
class LimitError : public Error
{
  using Error::Error;
};

/// Lack of memory on some rank: the same request may succeed another time, unlike other limits.
class MemoryError : public LimitError
{
  using LimitError::LimitError;
};

/// Legal, but not supported by this library.
class UnsupportedError : public Error
{
  using Error::Error;
};

/// An argument that cannot be used, such as an unknown name.
class ArgumentError : public Error
{
  using Error::Error;
};

/// Returns the exception that a catch-all has caught, to be thrown again later. The end of a thread, as by pthread_exit in a function
/// for progress, is no exception, and goes on at once.
inline std::exception_ptr caught_exception()
{
  std::exception_ptr caught = std::current_exception();
  if (!caught)
  {
    throw;
  }
  return caught;
}

/// A message for the user that is not an error.
struct Notice
{
  Notice() = default;

  /// Not an aggregate: GCC 12 destroys a braced `where` twice if making `text` throws.
  Notice(Where of, std::string says, std::string about = {})
    : where(std::move(of))
    , text(std::move(says))
    , topic(std::move(about))
  {
  }

  Where where;
  std::string text;
  std::string topic; ///< a user gets the first notice of a topic per file; empty: each
};

using Notices = std::vector<Notice>;

/// Returns "place: text".
std::string to_string(const Notice& notice);

/// Returns a text for each subject of notices, of which a user gets the first one. What is said of a column, or of all rows, holds
/// for the next frames too. of_files: the notices are of files and the places of their frames, which are new for each line.
std::string subject_of(const Notice& notice, bool of_files);
}
#endif
