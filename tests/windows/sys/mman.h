// SPDX-License-Identifier: BSD-3-Clause
// See ../posix.h: nobody tells which pages are in memory.
#ifndef granular_tests_windows_mman_h
#define granular_tests_windows_mman_h

#include <cstddef>

constexpr int PROT_READ = 0;
constexpr int PROT_WRITE = 0;
constexpr int MAP_PRIVATE = 0;
constexpr int MAP_ANONYMOUS = 0;
constexpr void* MAP_FAILED = nullptr;
constexpr int _SC_PAGESIZE = 0;

inline void* mmap(void*, std::size_t, int, int, int, int)
{
  return nullptr;
}
inline int munmap(void*, std::size_t)
{
  return -1;
}
inline int mincore(void*, std::size_t, unsigned char*)
{
  return -1;
}
inline long sysconf(int)
{
  return 4096;
}
#endif
