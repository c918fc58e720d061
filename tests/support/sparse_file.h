// SPDX-License-Identifier: BSD-3-Clause
// Files larger than any disk, whose holes read as zeros.
#ifndef granular_tests_support_sparse_file_h
#define granular_tests_support_sparse_file_h

#include "binary_dumps.h"

#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

/// A file of mostly holes, deleted at the end.
class SparseFile
{
public:
  explicit SparseFile(std::string path)
    : path_(std::move(path))
    , file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666))
  {
  }

  SparseFile(const SparseFile&) = delete;
  SparseFile& operator=(const SparseFile&) = delete;

  ~SparseFile()
  {
    ::close(file_);
    ::unlink(path_.c_str());
  }

  const std::string& path() const { return path_; }
  std::int64_t size() const { return size_; }

  void append(const std::string& bytes)
  {
    good_ = good_ &&
      ::pwrite(file_, bytes.data(), bytes.size(), size_) == static_cast<ssize_t>(bytes.size());
    size_ += static_cast<std::int64_t>(bytes.size());
  }

  void append_hole(std::int64_t bytes)
  {
    size_ += bytes;
    good_ = good_ && ::ftruncate(file_, size_) == 0;
  }

  /// Returns true if the file system holds such a file, and its holes take no room on the disk.
  bool good() const
  {
    struct stat stat = {};
    return good_ && ::fstat(file_, &stat) == 0 && stat.st_size == size_ &&
      stat.st_blocks * std::int64_t{ 512 } < std::int64_t{ 1 } << 24;
  }

private:
  std::string path_;
  int file_;
  std::int64_t size_ = 0;
  bool good_ = true;
};

/// A frame of so many rows in its chunks, the last row given, all others zeros.
inline std::int64_t append_large(SparseFile& file, const binary::Form& form, binary::Frame frame,
  const std::vector<std::int64_t>& chunk_rows)
{
  const std::vector<double> last = frame.chunks.at(0);
  frame.chunks.assign(chunk_rows.size(), {});
  binary::Bytes header = binary::write(form, { frame });
  const std::int64_t rows =
    std::accumulate(chunk_rows.begin(), chunk_rows.end(), std::int64_t{ 0 });
  const binary::Field atoms = header.field("atoms");
  header.bytes = binary::with_field(header, form, atoms, rows);
  file.append(header.bytes.substr(0, header.field("n").offset));
  for (std::size_t chunk = 0; chunk < chunk_rows.size(); ++chunk)
  {
    const std::int64_t values = chunk_rows[chunk] * frame.size_one;
    header.bytes = binary::with_field(header, form, header.field("n"), values);
    file.append(header.bytes.substr(header.field("n").offset, 4));
    const bool at_end = chunk + 1 == chunk_rows.size();
    file.append_hole(8 * (values - (at_end ? frame.size_one : 0)));
    if (at_end)
    {
      frame.chunks = { last };
      const binary::Bytes row = binary::write(form, { frame });
      file.append(row.bytes.substr(row.first_value));
    }
  }
  return rows;
}

#endif
