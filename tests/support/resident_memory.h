// SPDX-License-Identifier: BSD-3-Clause
// What the system says of the memory of this process.
#ifndef granular_tests_support_resident_memory_h
#define granular_tests_support_resident_memory_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

/// Returns a number of /proc/self/status, in bytes where it has a unit.
inline std::int64_t status_of_process(const std::string& name)
{
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind(name + ":", 0) == 0)
    {
      const bool kilo = line.find("kB") != std::string::npos;
      return std::stoll(line.substr(name.size() + 1)) * (kilo ? 1024 : 1);
    }
  }
  return 0;
}

/// Gives back memory that is free, and lets the system look for the peak anew. Returns the memory of the process.
inline std::int64_t restart_peak()
{
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return status_of_process("VmRSS");
}

/// The most memory that the process has had since then; 0 under a sanitizer, which keeps freed memory.
inline std::int64_t peak_bytes()
{
#ifdef GRANULAR_TEST_SANITIZED
  return 0;
#else
  return status_of_process("VmHWM");
#endif
}

/// Bytes of the pages of the range that are in memory; -1 if they are not of this process.
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

/// Bytes of this process that the system may take where it runs short.
inline std::int64_t lent_bytes()
{
  std::ifstream file("/proc/self/smaps");
  std::int64_t bytes = 0;
  for (std::string line; std::getline(file, line);)
  {
    bytes += line.rfind("LazyFree:", 0) == 0 ? 1024 * std::stol(line.substr(9)) : 0;
  }
  return bytes;
}

/// What this system tells of memory, found out by means of its own.
struct SystemTells
{
  bool resident = false;
  bool lent = false;

  SystemTells()
  {
    constexpr std::size_t size = std::size_t{ 1 } << 20;
    void* const memory =
      ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
    {
      return;
    }
    const bool none = resident_bytes(memory, size) == 0;
    std::memset(memory, 1, size);
    resident = none && resident_bytes(memory, size) == static_cast<std::int64_t>(size);
#ifdef MADV_FREE
    lent = ::madvise(memory, size, MADV_FREE) == 0 && lent_bytes() > 0;
#endif
    ::munmap(memory, size);
  }
};
#endif
