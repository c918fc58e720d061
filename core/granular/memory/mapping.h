// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_memory_mapping_h
#define granular_memory_mapping_h

#include <cstddef>
#include <cstdint>

namespace granular
{
/// Address space from the operating system. Untouched parts take no memory.
struct Mapping
{
  void* base = nullptr;     ///< null: there is none
  std::size_t capacity = 0; ///< bytes of address space
  std::size_t resident = 0; ///< at most so many bytes, from the start, take memory
};

/// Returns address space for at least this many bytes; a null base if the system has none.
Mapping map_memory(std::size_t bytes) noexcept;

void unmap_memory(const Mapping& mapping) noexcept;

/// Prepares for filling the first bytes, bytes <= capacity. The first touch of fresh memory costs more than writing to
/// it, page by page; large pages reduce that cost.
void expect_bytes(Mapping& mapping, std::size_t bytes) noexcept;

/// Returns the memory behind the first bytes to the system, but keeps the address space. Large pages stay whole.
void keep_bytes(Mapping& mapping, std::size_t bytes) noexcept;

/// Declares the contents unneeded: if memory is short, the system may take that of large pages; otherwise it leaves it
/// in place.
void forget_bytes(const Mapping& mapping) noexcept;

/// Returns the bytes of memory that this process can still get without taking it from other processes, as the system
/// estimates, and within the limit of its control group. Returns the largest integer if unknown.
std::int64_t available_memory() noexcept;
}
#endif
