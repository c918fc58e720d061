// SPDX-License-Identifier: BSD-3-Clause
// What the system says of the memory of this process.
#ifndef tests_base_resident_memory_h
#define tests_base_resident_memory_h

#include <cstddef>
#include <cstdint>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

/// Bytes of the pages of the range that are in memory; -1 if the system does not say.
inline std::int64_t resident_bytes(const void* data, std::size_t bytes)
{
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  char* const first = static_cast<char*>(const_cast<void*>(data)) - address % page;
  bytes += address % page;
  std::vector<unsigned char> pages((bytes + page - 1) / page);
  if (::mincore(first, bytes, pages.data()) != 0)
  {
    return -1;
  }
  std::size_t resident = 0;
  for (const unsigned char each : pages)
  {
    resident += (each & 1) != 0 ? page : 0;
  }
  return static_cast<std::int64_t>(resident);
}
#endif
