// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_restart_bytes_h
#define granular_restart_restart_bytes_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// A number out of bytes, of this machine's order or the other one.
template <class Number>
Number load_number(const char* bytes, bool swapped) noexcept
{
  std::array<char, sizeof(Number)> own;
  std::memcpy(own.data(), bytes, own.size());
  if (swapped)
  {
    std::ranges::reverse(own);
  }
  return std::bit_cast<Number>(own);
}

/// Numbers and strings at any byte of a file, in either byte order, through a window on it. The source must outlive it.
class RestartBytes
{
public:
  /// The most bytes of a string, with the zero behind it.
  static constexpr std::int64_t most_text = 1024;

  /// Of a compressed source the size is not known: it passes for endless.
  explicit RestartBytes(const ByteSource& source, bool swapped = false);

  const ByteSource& source() const noexcept { return source_; }
  std::int64_t size() const noexcept { return size_; }

  /// Whether the file has not this machine's byte order.
  bool swapped() const noexcept { return swapped_; }
  void set_swapped(bool swapped) noexcept { swapped_ = swapped; }

  Where where(std::int64_t offset) const { return { source_.path(), 0, offset }; }

  /// Throw FormatError that expected `what`, with the byte, where the file ends before.
  std::int32_t int32_at(std::int64_t offset, std::string_view what);
  std::int64_t int64_at(std::int64_t offset, std::string_view what);
  double double_at(std::int64_t offset, std::string_view what);

  /// A string: how many bytes it has with the zero behind it, then these. Throws FormatError also where it is none: the count is not
  /// in 2 .. most_text, a byte is not printable, there is no zero at the end, or one before.
  std::string text_at(std::int64_t offset, std::string_view what);

  /// The byte behind such a string; -1 where there is none.
  std::int64_t text_end(std::int64_t offset);

  /// Whether there are so many bytes; false of none, also for an offset outside of the file.
  bool has(std::int64_t offset, std::size_t bytes) { return this->find(offset, bytes) != nullptr; }

  /// The bytes from offset on that are in the window, which is moved there if it has fewer than so many: at least these, or all up
  /// to the end of the file. Valid until the next call.
  std::string_view view(std::int64_t offset, std::size_t at_least);

  /// How many bytes were read from the source: what going to and fro costs.
  std::int64_t read_bytes() const noexcept { return read_bytes_; }

  /// Numbers out of a view.
  std::int32_t int32_in(const char* bytes) const noexcept
  {
    return load_number<std::int32_t>(bytes, swapped_);
  }
  std::int64_t int64_in(const char* bytes) const noexcept
  {
    return load_number<std::int64_t>(bytes, swapped_);
  }
  double double_in(const char* bytes) const noexcept
  {
    return load_number<double>(bytes, swapped_);
  }

private:
  /// The bytes, or null if the file ends before.
  const char* find(std::int64_t offset, std::size_t bytes);
  const char* need(std::int64_t offset, std::size_t bytes, std::string_view what);
  void move_to(std::int64_t offset, std::size_t at_least);

  const ByteSource& source_;
  std::int64_t size_;
  bool swapped_;
  std::vector<char> window_;
  std::int64_t begin_ = 0;    ///< of the window in the file
  std::size_t length_ = 0;    ///< bytes in it
  std::size_t next_read_ = 0; ///< grows while one window follows the other
  std::int64_t read_bytes_ = 0;
};
}
#endif
