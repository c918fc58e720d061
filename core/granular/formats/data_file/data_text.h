// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_data_file_data_text_h
#define granular_formats_data_file_data_text_h

#include "granular/bytes/byte_source.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace granular
{
/// The text of a data file: its last line ends with a line feed, also where the file has none, as LAMMPS and LIGGGHTS read it.
/// Truncated compressed data stay as they are. The underlying source must outlive it.
class DataText final : public ByteSource
{
public:
  /// blanks_comments: each comment, from # to the end of the line, is blank; then no byte before `begin`, the start of a line,
  /// is read.
  explicit DataText(
    const ByteSource& source, bool blanks_comments = false, std::int64_t begin = 0) noexcept
    : source_(source)
    , blanks_comments_(blanks_comments)
    , begin_(begin)
  {
  }

  const std::string& path() const override { return source_.path(); }
  FileStamp stamp() const override { return source_.stamp(); }
  double fraction(std::int64_t offset) const override { return source_.fraction(offset); }
  bool compressed() const override { return source_.compressed(); }
  bool concurrent() const override { return source_.concurrent(); }
  std::string unchecked() const override { return source_.unchecked(); }
  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override;

private:
  bool is_comment(std::int64_t offset) const;
  bool lacks_feed(std::int64_t offset, const char* buffer, std::size_t got) const;

  const ByteSource& source_;
  bool blanks_comments_;
  std::int64_t begin_;
};
}
#endif
