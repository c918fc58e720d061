// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/block.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <utility>

#include <sys/mman.h>

namespace granular
{
namespace
{
/// First touch of fresh memory costs as much as decoding into it, a page at a time; large pages make
/// that a small part. Only advice: it may be refused, and memory that is never touched stays free.
void* allocate(std::size_t bytes) noexcept
{
  constexpr std::size_t large_page = std::size_t{ 1 } << 21;
  if (bytes < 2 * large_page)
  {
    return std::malloc(std::max<std::size_t>(bytes, 1));
  }
  void* data = nullptr;
  if (::posix_memalign(&data, large_page, bytes) != 0)
  {
    return nullptr;
  }
#ifdef MADV_HUGEPAGE
  // not the rest behind the last whole page: it would take a large page for itself
  ::madvise(data, bytes / large_page * large_page, MADV_HUGEPAGE);
#endif
  return data;
}
}

Block::Block(std::size_t bytes)
  : data_(allocate(bytes))
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
  if (bytes < bytes_)
  {
    // a shrinking realloc that fails leaves the larger block as it was, which serves as well
    if (void* smaller = std::realloc(data_, std::max<std::size_t>(bytes, 1)))
    {
      data_ = smaller;
    }
    bytes_ = bytes;
  }
}

void* Block::release() noexcept
{
  bytes_ = 0;
  return std::exchange(data_, nullptr);
}

void Block::free(void* data) noexcept
{
  std::free(data);
}
}
