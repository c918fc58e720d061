// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_error_h
#define granular_common_error_h

#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace granular
{
/// A place in a file. What is not known stays at its default and is not printed.
struct Where
{
  std::string path = {};
  std::int64_t line = 0;   ///< first line is 1; 0: not known or not a text file
  std::int64_t byte = -1;  ///< first byte is 0; -1: not known
  std::string column = {}; ///< name of the column as the file spells it
};

/// "path:line: column 'name'" or "path@byte: column 'name'", as far as known.
std::string to_string(const Where& where);

/// Base of all errors of the core. what() is "place: text": lower case, says expected and got.
class Error : public std::runtime_error
{
public:
  explicit Error(const std::string& text, Where where = {});
  const Where& where() const noexcept { return where_; }

  /// what() without the place.
  const std::string& text() const noexcept { return text_; }

private:
  std::string text_;
  Where where_;
};

/// The operating system refused: open, read, stat; or the file changed under us.
class IoError : public Error
{
public:
  explicit IoError(const std::string& text, Where where = {}, std::errc code = {});

  /// The system's own word for it; std::errc{} if the file is there, but not what it was.
  std::errc code() const noexcept { return code_; }

private:
  std::errc code_;
};

/// The bytes are not what the format says.
class FormatError : public Error
{
  using Error::Error;
};

/// Larger than a documented limit of the format or of this library.
class LimitError : public Error
{
  using Error::Error;
};

/// Legal, but not something this library does.
class UnsupportedError : public Error
{
  using Error::Error;
};

/// Something a user should know that lost no data.
struct Notice
{
  Where where;
  std::string text;
  std::string
    topic = {}; ///< of notices with the same topic a user gets the first of a file; empty: each
};

using Notices = std::vector<Notice>;

/// "place: text".
std::string to_string(const Notice& notice);
}
#endif
