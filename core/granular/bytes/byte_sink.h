// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_byte_sink_h
#define granular_bytes_byte_sink_h

#include <cstdint>
#include <string>
#include <string_view>

namespace granular
{
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

  /// Gives the file its name. No other call may follow. Throws IoError; collective if opened by open_together.
  virtual void finish() = 0;
};

/// An output file that one rank writes. A symbolic link stays, and the file that it points to is replaced. Permissions
/// are those of the old file, or what the umask leaves. Something at the path that is not a regular file is an error.
class NewFile final : public OutputFile
{
public:
  /// Opens a temporary file in the folder of path. Throws IoError.
  explicit NewFile(const std::string& path);
  ~NewFile() override;

  void write_at(std::int64_t offset, std::string_view bytes) override;
  void finish() override;

  /// Returns the temporary name, which is in the same folder.
  const std::string& temporary_name() const noexcept { return name_; }

private:
  void create();

  std::string path_;   ///< as it was given
  std::string target_; ///< behind all links
  std::string name_;   ///< empty when there is no such file any more
  int file_ = -1;
  int permissions_ = -1; ///< of the old file; -1: there is none
};

/// Writes into the existing file `name` at an offset, also beyond its end. Throws IoError that names path.
void write_into(
  const std::string& name, std::int64_t offset, std::string_view bytes, const std::string& path);

/// Writes a file completely or not at all, as NewFile does: a reader sees the old content or the new one. After an
/// error the old file is untouched. Throws IoError.
void write_file(const std::string& path, std::string_view bytes);
}
#endif
