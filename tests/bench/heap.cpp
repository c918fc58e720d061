// SPDX-License-Identifier: BSD-3-Clause
#include "heap.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace
{
// of this thread alone: no benchmark has others
thread_local bool counting = false;
thread_local std::int64_t live_bytes = 0;
thread_local std::int64_t peak_bytes = 0;

void* taken(void* memory)
{
  if (!memory)
  {
    throw std::bad_alloc();
  }
  if (counting)
  {
    live_bytes += static_cast<std::int64_t>(::malloc_usable_size(memory));
    peak_bytes = std::max(peak_bytes, live_bytes);
  }
  return memory;
}

void give_back(void* memory) noexcept
{
  if (counting && memory)
  {
    live_bytes -= static_cast<std::int64_t>(::malloc_usable_size(memory));
  }
  std::free(memory);
}
}

// The other forms of the standard library call these.
void* operator new(std::size_t bytes)
{
  return taken(std::malloc(std::max(bytes, std::size_t{ 1 })));
}

void* operator new(std::size_t bytes, std::align_val_t alignment)
{
  const auto unit = static_cast<std::size_t>(alignment);
  return taken(std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit));
}

void operator delete(void* memory) noexcept
{
  give_back(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  give_back(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept
{
  give_back(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  give_back(memory);
}

namespace bench
{
HeapCount::HeapCount()
{
  live_bytes = 0;
  peak_bytes = 0;
  counting = true;
}

HeapCount::~HeapCount()
{
  counting = false;
}

std::int64_t HeapCount::live() const
{
  return live_bytes;
}

std::int64_t HeapCount::peak() const
{
  return peak_bytes;
}
}
