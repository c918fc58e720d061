// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_memory_mapping_h
#define granular_memory_mapping_h

#include <cstddef>
#include <cstdint>

namespace granular
{
/// Address space straight from the system. What was never touched takes no memory.
struct Mapping
{
  void* base = nullptr;     ///< null: there is none
  std::size_t capacity = 0; ///< bytes of address space
  std::size_t resident = 0; ///< at most so many bytes, from the start, take memory
};

/// Address space for at least that many bytes; null base if the system has none.
Mapping map_memory(std::size_t bytes) noexcept;

void unmap_memory(const Mapping& mapping) noexcept;

/// To be called before the first bytes are filled, bytes <= capacity. First touch of fresh memory costs
/// more than what is written into it, a page at a time; large pages make that less.
void expect_bytes(Mapping& mapping, std::size_t bytes) noexcept;

/// Gives back the memory behind the first bytes, but not the address space. Large pages stay whole.
void keep_bytes(Mapping& mapping, std::size_t bytes) noexcept;

/// Nobody needs what is written there: where the system runs short of memory it may take that of large
/// pages, and else leaves it as it is.
void forget_bytes(const Mapping& mapping) noexcept;

/// Bytes of memory that this process can still get without others losing theirs, as the system estimates it and the group
/// that the process belongs to allows; the largest number there is where nobody knows.
std::int64_t available_memory() noexcept;
}
#endif
