// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_memory_block_h
#define granular_memory_block_h

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace granular
{
/// Address space from the operating system. Untouched parts take no memory.
struct Mapping
{
  void* base = nullptr;     ///< null: there is none
  std::size_t capacity = 0; ///< bytes of address space
  std::size_t resident = 0; ///< at most so many bytes, from the start, take memory
};

/// Returns the bytes of memory that this process can still get without taking it from other processes, as the system
/// estimates, and within the limit of its control group. Returns the largest integer if unknown.
std::int64_t available_memory() noexcept;

/// Keeps the memory of freed blocks for new ones: touching fresh memory costs more than filling it. All methods may be
/// called from any thread. Blocks may outlive their pool.
class BlockPool
{
public:
  /// Keeps at most this many bytes of resident memory; address space does not count. Blocks of a pool that keeps none are of
  /// the heap.
  explicit BlockPool(std::size_t limit) noexcept;

  BlockPool(const BlockPool&) = delete;
  BlockPool& operator=(const BlockPool&) = delete;
  ~BlockPool();

  std::size_t limit() const noexcept { return limit_; }

  /// Returns the bytes of memory that wait for a block.
  std::size_t idle_bytes() const;

  /// Frees memory that has waited since the call before the last one. Call once per frame.
  void next_frame();

  /// Frees all waiting memory.
  void clear();

  /// Returns memory for this many bytes, of which at most half as much again may be resident; a null base if none fits.
  /// For Block.
  Mapping take(std::size_t bytes);

  /// Keeps memory for later use, or frees it. The memory that has waited longest is freed if the limit is passed. For
  /// Block.
  void give_back(const Mapping& mapping) noexcept;

private:
  struct Idle
  {
    Mapping mapping;
    bool since_last_frame; ///< has waited for a call of next_frame
  };

  void free_first(std::size_t count) noexcept;

  const std::size_t limit_;
  mutable std::mutex mutex_;
  std::vector<Idle> idle_; ///< in the order in which they came back
  std::size_t idle_bytes_ = 0;
};

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

  /// As release(), in memory of malloc: a copy if the block is not of the heap. Throws std::bad_alloc, and leaves the block.
  void* release_malloc();

  /// Frees memory from release(), and from malloc: a VTK array that reallocates with malloc frees both with the same
  /// function.
  static void free(void* data) noexcept;

private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};
}
#endif
