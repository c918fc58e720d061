// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/row_buffer.h"

#include <algorithm>
#include <limits>
#include <new>

namespace granular
{
char* RowBuffer::room(std::size_t bytes)
{
  if (bytes > capacity_ - size_)
  {
    if (bytes > std::numeric_limits<std::size_t>::max() / 2 - size_)
    {
      throw std::bad_alloc();
    }
    const std::size_t wanted = std::max(size_ + bytes, capacity_ + capacity_ / 2);
    const std::size_t capacity = (wanted + step - 1) / step * step;
    auto data = std::make_unique_for_overwrite<char[]>(capacity);
    std::copy_n(data_.get(), size_, data.get());
    data_ = std::move(data);
    capacity_ = capacity;
  }
  return data_.get() + size_;
}
}
