// SPDX-License-Identifier: BSD-3-Clause
#include "granular/memory/mapping.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <limits>
#include <string>

#include <sys/mman.h>

namespace granular
{
namespace
{
constexpr std::size_t page = std::size_t{ 1 } << 16; // a multiple of every system's
constexpr std::size_t large_page = std::size_t{ 1 } << 21;

constexpr std::size_t round_down(std::size_t bytes, std::size_t unit)
{
  return bytes / unit * unit;
}

constexpr std::size_t round_up(std::size_t bytes, std::size_t unit)
{
  return round_down(bytes + unit - 1, unit);
}

/// Small ones lie side by side in small pages, which costs the system less.
constexpr bool is_large(std::size_t capacity)
{
  return capacity >= 2 * large_page;
}

void give_back(char* from, char* to) noexcept
{
  if (from < to)
  {
    ::munmap(from, static_cast<std::size_t>(to - from));
  }
}

void advise(const Mapping& mapping, std::size_t from, std::size_t to, int advice) noexcept
{
  if (from < to)
  {
    // only advice: it may be refused
    ::madvise(static_cast<char*>(mapping.base) + from, to - from, advice);
  }
}

constexpr std::int64_t unknown = std::numeric_limits<std::int64_t>::max();

/// The number that a file of the system holds, or begins a line with that word.
std::int64_t read_number(const char* path, const std::string& word = "")
{
  std::ifstream file(path);
  std::int64_t number = unknown;
  for (std::string line; !word.empty() && file >> line && line != word;)
  {
  }
  return file >> number ? number : unknown;
}
}

Mapping map_memory(std::size_t bytes) noexcept
{
  const std::size_t capacity = round_up(bytes, page);
  const std::size_t room = is_large(capacity) ? capacity + large_page : capacity;
  void* const found =
    ::mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (found == MAP_FAILED)
  {
    return {};
  }
  char* const first = static_cast<char*>(found);
  char* base = first;
  if (is_large(capacity))
  {
    base += round_up(reinterpret_cast<std::uintptr_t>(first), large_page) -
      reinterpret_cast<std::uintptr_t>(first);
    give_back(first, base);
    give_back(base + capacity, first + room);
  }
  return { base, capacity, 0 };
}

void unmap_memory(const Mapping& mapping) noexcept
{
  char* const base = static_cast<char*>(mapping.base);
  give_back(base, base + mapping.capacity);
}

/// The first touch of fresh memory costs more than writing to it, page by page; large pages reduce that cost.
bool expect_bytes(Mapping& mapping, std::size_t bytes) noexcept
{
#ifdef MADV_HUGEPAGE
  if (is_large(mapping.capacity) && bytes > mapping.resident)
  {
    // not the rest behind the last whole page: it would take a large page for itself
    advise(mapping, 0, round_down(bytes, large_page), MADV_HUGEPAGE);
  }
#endif
  mapping.resident = std::max(mapping.resident, bytes);
  return true;
}

/// Large pages stay whole.
void keep_bytes(Mapping& mapping, std::size_t bytes) noexcept
{
  const std::size_t end = round_up(bytes, is_large(mapping.capacity) ? large_page : page);
  if (end < mapping.resident)
  {
    advise(mapping, end, mapping.capacity, MADV_DONTNEED);
    mapping.resident = end;
  }
}

void forget_bytes([[maybe_unused]] const Mapping& mapping) noexcept
{
#ifdef MADV_FREE
  if (is_large(mapping.capacity))
  {
    advise(mapping, 0, round_down(mapping.resident, large_page), MADV_FREE);
  }
#endif
}

void* allocate_heap(std::size_t bytes) noexcept
{
  void* data = nullptr;
  if (::posix_memalign(&data, is_large(bytes) ? large_page : Block::alignment, bytes) != 0)
  {
    return nullptr;
  }
  Mapping memory = { data, bytes };
  expect_bytes(memory, bytes);
  return data;
}

void free_heap(void* data) noexcept
{
  std::free(data);
}

/// malloc keeps nothing of its own inside.
void keep_heap(void* data, std::size_t bytes, std::size_t all) noexcept
{
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::size_t from = round_up(begin + bytes, page);
  const std::size_t to = round_down(begin + all, page);
  if (from < to)
  {
    advise({ data, all, all }, from - begin, to - begin, MADV_DONTNEED);
  }
}

void* to_malloc(void* data, std::size_t) noexcept
{
  return data;
}

std::int64_t available_memory() noexcept
{
  try
  {
    const std::int64_t kilobytes = read_number("/proc/meminfo", "MemAvailable:");
    const std::int64_t most = read_number("/sys/fs/cgroup/memory.max");
    const std::int64_t used = read_number("/sys/fs/cgroup/memory.current");
    const std::int64_t left = most == unknown || used == unknown ? unknown : most - used;
    return std::min(
      kilobytes == unknown ? unknown : kilobytes * 1024, std::max<std::int64_t>(left, 0));
  }
  catch (const std::exception&)
  {
    return unknown;
  }
}
}
