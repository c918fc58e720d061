// SPDX-License-Identifier: BSD-3-Clause
#include "granular/memory/mapping.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include <malloc.h>
#include <windows.h>

namespace granular
{
namespace
{
constexpr std::size_t page = std::size_t{ 1 } << 16;

constexpr std::size_t round_up(std::size_t bytes)
{
  return (bytes + page - 1) / page * page;
}
}

Mapping map_memory(std::size_t bytes) noexcept
{
  const std::size_t capacity = round_up(bytes);
  void* const base = ::VirtualAlloc(nullptr, capacity, MEM_RESERVE, PAGE_READWRITE);
  return { base, base ? capacity : 0, 0 };
}

void unmap_memory(const Mapping& mapping) noexcept
{
  ::VirtualFree(mapping.base, 0, MEM_RELEASE);
}

/// The system counts what it has promised, so it promises no more than that.
bool expect_bytes(Mapping& mapping, std::size_t bytes) noexcept
{
  if (bytes > mapping.resident)
  {
    if (!::VirtualAlloc(mapping.base, bytes, MEM_COMMIT, PAGE_READWRITE))
    {
      return false;
    }
    mapping.resident = bytes;
  }
  return true;
}

void keep_bytes(Mapping& mapping, std::size_t bytes) noexcept
{
  const std::size_t end = round_up(bytes);
  if (end < mapping.resident)
  {
    ::VirtualFree(static_cast<char*>(mapping.base) + end, mapping.capacity - end, MEM_DECOMMIT);
    mapping.resident = end;
  }
}

void forget_bytes(const Mapping& mapping) noexcept
{
  ::VirtualAlloc(mapping.base, mapping.resident, MEM_RESET, PAGE_READWRITE);
}

void* allocate_heap(std::size_t bytes) noexcept
{
  return ::_aligned_malloc(bytes, Block::alignment);
}

void free_heap(void* data) noexcept
{
  ::_aligned_free(data);
}

void keep_heap(void*, std::size_t, std::size_t) noexcept
{
  // the heap has no such function
}

void* to_malloc(void* data, std::size_t bytes) noexcept
{
  void* const copy = std::malloc(std::max<std::size_t>(bytes, 1));
  if (copy)
  {
    std::memcpy(copy, data, bytes);
    ::_aligned_free(data);
  }
  return copy;
}

std::int64_t available_memory() noexcept
{
  MEMORYSTATUSEX status = {};
  status.dwLength = sizeof status;
  ::GlobalMemoryStatusEx(&status);
  return static_cast<std::int64_t>(std::min(status.ullAvailPhys, status.ullAvailPageFile));
}
}
