// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_memory_block_h
#define granular_memory_block_h

#include <cstddef>
#include <memory>

namespace granular
{
class BlockPool;

/// Raw memory of an output array that can be handed over without a copy: the owner of the pointer from release() frees
/// it with Block::free, from any thread. Untouched parts take address space but no memory, so a block may be allocated
/// for the largest possible size and shrunk to the actual size.
class Block
{
public:
  static constexpr std::size_t alignment = 64;

  Block() noexcept = default;

  /// Allocates uninitialised memory, aligned for vector instructions. All but small blocks come from the pool and go
  /// back to it if it still exists. Throws std::bad_alloc.
  explicit Block(std::size_t bytes, const std::shared_ptr<BlockPool>& pool = nullptr);

  Block(Block&& other) noexcept;
  Block& operator=(Block&& other) noexcept;
  ~Block();

  void* data() const noexcept { return data_; }
  std::size_t bytes() const noexcept { return bytes_; }

  /// Returns the pool of this block; null if there is none or it is gone.
  std::shared_ptr<BlockPool> pool() const noexcept;

  /// Keeps the first bytes; bytes <= this->bytes(). Pointers into the block become invalid. Frees memory where that
  /// pays: from a large block whole large pages, from a small one if at least half is unused.
  void shrink(std::size_t bytes) noexcept;

  /// Returns the memory and leaves the block empty. Never null for a block that was allocated.
  void* release() noexcept;

  /// Frees memory from release(), and from malloc: a VTK array that reallocates with malloc frees both with the same
  /// function.
  static void free(void* data) noexcept;

private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};
}
#endif
