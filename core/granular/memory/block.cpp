// SPDX-License-Identifier: BSD-3-Clause
#include "granular/memory/block.h"

#include "granular/memory/mapping.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

namespace granular
{
namespace
{
/// Start of a mapping; the data are behind it. Small blocks are malloc's, without more.
struct alignas(Block::alignment) Header
{
  std::uint64_t mark; ///< that this is a header, and that of this address
  std::uintptr_t self;
  Mapping mapping;
  std::weak_ptr<BlockPool> pool;
};

static_assert(sizeof(Header) == Block::alignment);

constexpr std::uint64_t header_mark = 0x6b636f6c42c0ffee;
constexpr std::uintptr_t least_page = 4096;

/// Smaller blocks are what malloc is good at: it keeps some memory itself, but gives back, and fetches
/// again, more than a pool does.
constexpr std::size_t least_pooled = std::size_t{ 1 } << 16;
constexpr std::size_t least_mapped = std::size_t{ 1 } << 22;

/// Null if the data are malloc's. What is read then may be of others, but lies in the same page.
__attribute__((no_sanitize("address", "thread"))) Header* header_of(void* data) noexcept
{
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  if (address % least_page != sizeof(Header))
  {
    return nullptr;
  }
  Header* const header = static_cast<Header*>(data) - 1;
  const volatile Header& seen = *header;
  const bool found =
    seen.mark == header_mark && seen.self == reinterpret_cast<std::uintptr_t>(header);
  return found ? header : nullptr;
}

void* allocate_mapping(std::size_t bytes, const std::shared_ptr<BlockPool>& pool)
{
  const std::size_t size = sizeof(Header) + bytes;
  Mapping mapping = pool ? pool->take(size) : map_memory(size);
  if (pool && !mapping.base)
  {
    // room to grow, so that it serves the next frames of a run that gains particles, too
    mapping = map_memory(size + size / 4);
  }
  if (!mapping.base)
  {
    return nullptr;
  }
  if (!expect_bytes(mapping, size))
  {
    unmap_memory(mapping);
    return nullptr;
  }
  const auto self = reinterpret_cast<std::uintptr_t>(mapping.base);
  return new (mapping.base) Header{ header_mark, self, mapping, pool } + 1;
}

/// Null if there is no memory.
void* allocate(std::size_t bytes, const std::shared_ptr<BlockPool>& pool)
{
  if (bytes > std::numeric_limits<std::size_t>::max() / 2)
  {
    return nullptr;
  }
  const bool keeps_none = pool && pool->limit() == 0;
  return bytes < (pool ? least_pooled : least_mapped) || keeps_none
    ? allocate_heap(std::max<std::size_t>(bytes, 1))
    : allocate_mapping(bytes, pool);
}
}

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

Block::Block(std::size_t bytes, const std::shared_ptr<BlockPool>& pool)
  : data_(allocate(bytes, pool))
  , bytes_(bytes)
{
  if (!data_)
  {
    throw std::bad_alloc();
  }
}

Block::Block(Block&& other) noexcept
  : data_(std::exchange(other.data_, nullptr))
  , bytes_(std::exchange(other.bytes_, 0))
{
}

Block& Block::operator=(Block&& other) noexcept
{
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

Block::~Block()
{
  Block::free(data_);
}

std::shared_ptr<BlockPool> Block::pool() const noexcept
{
  const Header* const header = header_of(data_);
  return header ? header->pool.lock() : nullptr;
}

void Block::shrink(std::size_t bytes) noexcept
{
  if (bytes >= bytes_)
  {
    return;
  }
  Header* const header = header_of(data_);
  const bool little = bytes < least_mapped && bytes <= bytes_ / 2;
  if (void* const smaller = little ? allocate(bytes, this->pool()) : nullptr)
  {
    std::memcpy(smaller, data_, bytes);
    Block::free(std::exchange(data_, smaller));
  }
  else if (header)
  {
    keep_bytes(header->mapping, sizeof(Header) + bytes);
  }
  else if (bytes_ >= least_mapped)
  {
    keep_heap(data_, bytes, bytes_);
  }
  bytes_ = bytes;
}

void* Block::release_malloc()
{
  if (header_of(data_))
  {
    Block copy(bytes_, std::make_shared<BlockPool>(0));
    std::memcpy(copy.data_, data_, bytes_);
    std::swap(data_, copy.data_);
  }
  void* const made = to_malloc(data_, bytes_);
  if (!made)
  {
    throw std::bad_alloc();
  }
  this->release();
  return made;
}

void* Block::release() noexcept
{
  bytes_ = 0;
  return std::exchange(data_, nullptr);
}

void Block::free(void* data) noexcept
{
  Header* const header = header_of(data);
  if (!header)
  {
    free_heap(data);
    return;
  }
  const Mapping mapping = header->mapping;
  const std::shared_ptr<BlockPool> pool = header->pool.lock();
  header->~Header();
  if (pool)
  {
    pool->give_back(mapping);
  }
  else
  {
    unmap_memory(mapping);
  }
}
}
