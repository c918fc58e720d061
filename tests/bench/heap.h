// SPDX-License-Identifier: BSD-3-Clause
// Memory that a program takes from operator new: a program that links heap.cpp has its own.
#ifndef tests_bench_heap_h
#define tests_bench_heap_h

#include <cstdint>

namespace bench
{
/// Bytes that are taken and not given back while this lives, as malloc rounds them.
class HeapCount
{
public:
  HeapCount();
  HeapCount(const HeapCount&) = delete;
  HeapCount& operator=(const HeapCount&) = delete;
  ~HeapCount();

  std::int64_t live() const; ///< now, without what was there before
  std::int64_t peak() const; ///< the most there ever were
};
}
#endif
