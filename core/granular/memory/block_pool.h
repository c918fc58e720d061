// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_memory_block_pool_h
#define granular_memory_block_pool_h

#include "granular/memory/mapping.h"

#include <cstddef>
#include <mutex>
#include <vector>

namespace granular
{
/// Keeps the memory of freed blocks for new ones: touching fresh memory costs more than filling it. All methods may be
/// called from any thread. Blocks may outlive their pool.
class BlockPool
{
public:
  /// Keeps at most this many bytes of resident memory; address space does not count.
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
}
#endif
