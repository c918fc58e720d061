// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/block.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <utility>

namespace granular
{
Block::Block(std::size_t bytes)
  : data_(std::malloc(std::max<std::size_t>(bytes, 1)))
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
