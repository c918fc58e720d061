// SPDX-License-Identifier: BSD-3-Clause
#include "granular/memory/block_pool.h"

#include <algorithm>
#include <new>

namespace granular
{
BlockPool::BlockPool(std::size_t limit) noexcept
  : limit_(limit)
{
}

BlockPool::~BlockPool()
{
  this->free_first(idle_.size());
}

std::size_t BlockPool::idle_bytes() const
{
  const std::lock_guard lock(mutex_);
  return idle_bytes_;
}

void BlockPool::next_frame()
{
  const std::lock_guard lock(mutex_);
  const auto recent = std::find_if(
    idle_.begin(), idle_.end(), [](const Idle& idle) { return !idle.since_last_frame; });
  this->free_first(static_cast<std::size_t>(recent - idle_.begin()));
  for (Idle& idle : idle_)
  {
    idle.since_last_frame = true;
  }
}

void BlockPool::clear()
{
  const std::lock_guard lock(mutex_);
  this->free_first(idle_.size());
}

Mapping BlockPool::take(std::size_t bytes)
{
  const std::lock_guard lock(mutex_);
  // of those that fit the smallest, and of equal ones that which was used last: caches may hold it
  auto best = idle_.end();
  for (auto idle = idle_.begin(); idle != idle_.end(); ++idle)
  {
    const Mapping& mapping = idle->mapping;
    if (mapping.capacity >= bytes && mapping.resident <= bytes + bytes / 2 &&
      (best == idle_.end() || mapping.capacity <= best->mapping.capacity))
    {
      best = idle;
    }
  }
  if (best == idle_.end())
  {
    return {};
  }
  const Mapping found = best->mapping;
  idle_bytes_ -= found.resident;
  idle_.erase(best);
  return found;
}

void BlockPool::give_back(const Mapping& mapping) noexcept
{
  const std::lock_guard lock(mutex_);
  if (mapping.resident > limit_)
  {
    unmap_memory(mapping);
    return;
  }
  std::size_t count = 0;
  for (std::size_t left = idle_bytes_; left > limit_ - mapping.resident; ++count)
  {
    left -= idle_[count].mapping.resident;
  }
  this->free_first(count);
  try
  {
    idle_.push_back({ mapping, false });
    idle_bytes_ += mapping.resident;
    forget_bytes(mapping);
  }
  catch (const std::bad_alloc&)
  {
    unmap_memory(mapping);
  }
}

void BlockPool::free_first(std::size_t count) noexcept
{
  const auto end = idle_.begin() + static_cast<std::ptrdiff_t>(count);
  for (auto idle = idle_.begin(); idle != end; ++idle)
  {
    idle_bytes_ -= idle->mapping.resident;
    unmap_memory(idle->mapping);
  }
  idle_.erase(idle_.begin(), end);
}
}
