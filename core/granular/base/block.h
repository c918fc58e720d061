// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_block_h
#define granular_base_block_h

#include <cstddef>

namespace granular
{
/// Raw memory of an output array, given away without a copy: whoever takes the pointer with
/// release() frees it with Block::free. Untouched parts cost address space, not memory, so a
/// block may be made for the most there can be and shrunk to what there is.
class Block
{
public:
  Block() noexcept = default;

  /// bytes of uninitialised memory, aligned for any element. Throws std::bad_alloc.
  explicit Block(std::size_t bytes);

  Block(Block&& other) noexcept;
  Block& operator=(Block&& other) noexcept;
  ~Block();

  void* data() const noexcept { return data_; }
  std::size_t bytes() const noexcept { return bytes_; }

  /// Keeps the first bytes; bytes <= this->bytes(). Pointers into the block become invalid.
  void shrink(std::size_t bytes) noexcept;

  /// Hands the memory over; the block is empty afterwards. Never null for a block that was made.
  void* release() noexcept;

  /// Frees what release() handed over.
  static void free(void* data) noexcept;

private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};
}
#endif
