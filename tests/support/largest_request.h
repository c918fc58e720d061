// SPDX-License-Identifier: BSD-3-Clause
// How much memory a program asks for at once: replaces its operator new. For one source of a program that is a test of its own.
#ifndef granular_tests_support_largest_request_h
#define granular_tests_support_largest_request_h

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace
{
std::size_t largest_request = 0; ///< of memory, since it was last set to 0
}

// A sanitizer has its own.
#ifndef GRANULAR_TEST_SANITIZED
// NOLINTBEGIN: every allocation of the program is seen
[[gnu::noinline]] void* operator new(std::size_t bytes)
{
  largest_request = std::max(largest_request, bytes);
  if (void* memory = std::malloc(std::max(bytes, std::size_t{ 1 })))
  {
    return memory;
  }
  throw std::bad_alloc();
}

[[gnu::noinline]] void* operator new[](std::size_t bytes)
{
  return operator new(bytes);
}

[[gnu::noinline]] void operator delete(void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete[](void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept
{
  std::free(memory);
}
// NOLINTEND
#endif
#endif
