// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_memory_block_h
#define granular_memory_block_h

#include <cstddef>
#include <memory>

namespace granular
{
class BlockPool;

/// Raw memory of an output array, given away without a copy: whoever takes the pointer with
/// release() frees it with Block::free, from any thread. Untouched parts cost address space, not
/// memory, so a block may be made for the most there can be and shrunk to what there is.
class Block
{
public:
  static constexpr std::size_t alignment = 64;

  Block() noexcept = default;

  /// bytes of uninitialised memory, aligned for vector instructions. All but small blocks come from the
  /// pool and go back to it, if it is still there then. Throws std::bad_alloc.
  explicit Block(std::size_t bytes, const std::shared_ptr<BlockPool>& pool = nullptr);

  Block(Block&& other) noexcept;
  Block& operator=(Block&& other) noexcept;
  ~Block();

  void* data() const noexcept { return data_; }
  std::size_t bytes() const noexcept { return bytes_; }

  /// Where it came from and another one of its kind should; null: there is none, or it is gone.
  std::shared_ptr<BlockPool> pool() const noexcept;

  /// Keeps the first bytes; bytes <= this->bytes(). Pointers into the block become invalid. Frees what
  /// is worth it: of a large block whole large pages, of a small one half and more.
  void shrink(std::size_t bytes) noexcept;

  /// Hands the memory over; the block is empty afterwards. Never null for a block that was made.
  void* release() noexcept;

  /// Frees what release() handed over, and what malloc gave: an array of VTK that takes new memory from
  /// malloc frees that by the same function.
  static void free(void* data) noexcept;

private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};
}
#endif
