// SPDX-License-Identifier: BSD-3-Clause
// Included before each test for Windows: what tests of the core ask of POSIX, as a system that has none of it would say. The cases that
// need more are left out by excluded.cmake.
#ifndef granular_tests_windows_posix_h
#define granular_tests_windows_posix_h

#include <cstdlib>

#include <sys/types.h>

using uid_t = unsigned;

inline int mkfifo(const char*, int)
{
  return -1;
}
inline uid_t geteuid()
{
  return 1;
}
inline int seteuid(uid_t)
{
  return -1;
}
inline int setenv(const char*, const char*, int)
{
  return -1;
}
inline int malloc_trim(std::size_t)
{
  return 0;
}
inline int mallopt(int, int)
{
  return 0;
}
constexpr int M_MMAP_THRESHOLD = 0;

/// test_NAME
inline const char* program_name()
{
  static char name[_MAX_FNAME];
  ::_splitpath(_pgmptr, nullptr, nullptr, name, nullptr);
  return name;
}
#define program_invocation_short_name program_name()
#endif
