// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_byte_sink_h
#define granular_bytes_byte_sink_h

#include <cstdint>
#include <string>
#include <string_view>

namespace granular
{
/// A file that is being written under another name and takes the place of the old one when it is
/// complete. Without finish nothing is left of it, and the old file is as it was.
class OutputFile
{
public:
  OutputFile() = default;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  virtual ~OutputFile() = default;

  /// In any order, also beyond the end: what lies between is zero. From any thread for NewFile. Throws
  /// IoError; what was written of these bytes is not known then.
  virtual void write_at(std::int64_t offset, std::string_view bytes) = 0;

  /// The file gets its name. Nothing may follow. Throws IoError; collective if opened by open_together.
  virtual void finish() = 0;
};

/// One that this process writes. A symbolic link stays and gets a new file behind it; permissions
/// are those of the old file, or what the umask leaves. What is there and no regular file is an error.
class NewFile final : public OutputFile
{
public:
  /// Throws IoError.
  explicit NewFile(const std::string& path);
  ~NewFile() override;

  void write_at(std::int64_t offset, std::string_view bytes) override;
  void finish() override;

  /// What it is called until it is finished, in the same folder.
  const std::string& temporary_name() const noexcept { return name_; }

private:
  void create();

  std::string path_;   ///< as it was given
  std::string target_; ///< behind all links
  std::string name_;   ///< empty when there is no such file any more
  int file_ = -1;
  int permissions_ = -1; ///< of the old file; -1: there is none
};

/// Writes into the file of that name, which is there; beyond its end, too. Throws IoError that names path.
void write_into(
  const std::string& name, std::int64_t offset, std::string_view bytes, const std::string& path);

/// Writes a file whole or not at all: a reader sees the old content or the new one; if this fails, the
/// old file is as it was. Like NewFile. Throws IoError.
void write_file(const std::string& path, std::string_view bytes);
}
#endif
