// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_row_buffer_h
#define granular_dump_write_row_buffer_h

#include <cstddef>
#include <memory>
#include <string_view>

namespace granular
{
/// Bytes of rows being written. Grows in steps of at least 2^20 bytes, like the buffers of dump atom, but with 64-bit sizes.
class RowBuffer
{
public:
  static constexpr std::size_t step = std::size_t{ 1 } << 20;

  /// Makes room for more bytes. They count once add() is called. Throws std::bad_alloc and is unchanged then.
  char* room(std::size_t bytes);

  /// Counts the next bytes of the room as written.
  void add(std::size_t bytes) noexcept { size_ += bytes; }

  void clear() noexcept { size_ = 0; }
  std::size_t size() const noexcept { return size_; }
  std::size_t capacity() const noexcept { return capacity_; }
  std::string_view bytes() const noexcept { return { data_.get(), size_ }; }

private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};
}
#endif
