// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_memory_block_pool_h
#define granular_memory_block_pool_h

#include "granular/memory/mapping.h"

#include <cstddef>
#include <mutex>
#include <vector>

namespace granular
{
/// Memory of Blocks that came back, for the next ones: touching fresh memory costs more than filling
/// it. All methods may be called from any thread. Blocks may outlive their pool.
class BlockPool
{
public:
  /// Keeps at most that many bytes of memory, which counts what may be in memory, not the address space.
  explicit BlockPool(std::size_t limit) noexcept;

  BlockPool(const BlockPool&) = delete;
  BlockPool& operator=(const BlockPool&) = delete;
  ~BlockPool();

  std::size_t limit() const noexcept { return limit_; }

  /// Bytes of memory that wait for a block.
  std::size_t idle_bytes() const;

  /// To be called once a frame: frees what waited since the call before the last.
  void next_frame();

  /// Frees all that waits.
  void clear();

  /// For Block: memory for that many bytes, of which no more than half as much again may be resident;
  /// null base if none of that kind waits.
  Mapping take(std::size_t bytes);

  /// For Block: memory that waits from now on, or is freed. The longest waiting goes where the limit
  /// is passed.
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
