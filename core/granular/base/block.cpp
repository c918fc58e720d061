// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/block.h"

#include "granular/base/block_pool.h"

#include <cstring>
#include <limits>
#include <new>
#include <utility>

namespace granular
{
namespace
{
/// Stands before the data: Block::free knows nothing else.
struct alignas(Block::alignment) Header
{
  Mapping mapping; ///< that this is the start of; without base: of operator new
  std::weak_ptr<BlockPool> pool;
};

static_assert(sizeof(Header) == Block::alignment);

/// Smaller ones are what malloc is good at.
constexpr std::size_t least_mapping = std::size_t{ 1 } << 18;

Header* header_of(void* data) noexcept
{
  return static_cast<Header*>(data) - 1;
}

Header* allocate_small(std::size_t size) noexcept
{
  void* const memory = ::operator new (size, std::align_val_t{ alignof(Header) }, std::nothrow);
  return memory ? new (memory) Header : nullptr;
}

Header* allocate_mapping(std::size_t size, const std::shared_ptr<BlockPool>& pool)
{
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
  expect_bytes(mapping, size);
  return new (mapping.base) Header{ mapping, pool };
}

/// Null if there is no memory.
void* allocate(std::size_t bytes, const std::shared_ptr<BlockPool>& pool)
{
  if (bytes > std::numeric_limits<std::size_t>::max() / 2)
  {
    return nullptr;
  }
  const std::size_t size = sizeof(Header) + bytes;
  Header* const header = size < least_mapping ? allocate_small(size) : allocate_mapping(size, pool);
  return header ? header + 1 : nullptr;
}
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

void Block::shrink(std::size_t bytes) noexcept
{
  if (bytes >= bytes_)
  {
    return;
  }
  const std::size_t size = sizeof(Header) + bytes;
  Header* const small =
    size < least_mapping && bytes <= bytes_ / 2 ? allocate_small(size) : nullptr;
  if (small)
  {
    void* const larger = std::exchange(data_, small + 1);
    std::memcpy(data_, larger, bytes);
    Block::free(larger);
  }
  else if (header_of(data_)->mapping.base)
  {
    keep_bytes(header_of(data_)->mapping, size);
  }
  bytes_ = bytes;
}

void* Block::release() noexcept
{
  bytes_ = 0;
  return std::exchange(data_, nullptr);
}

void Block::free(void* data) noexcept
{
  if (!data)
  {
    return;
  }
  Header* const header = header_of(data);
  const Mapping mapping = header->mapping;
  const std::shared_ptr<BlockPool> pool = header->pool.lock();
  header->~Header();
  if (!mapping.base)
  {
    ::operator delete (header, std::align_val_t{ alignof(Header) });
  }
  else if (pool)
  {
    pool->give_back(mapping);
  }
  else
  {
    unmap_memory(mapping);
  }
}
}
