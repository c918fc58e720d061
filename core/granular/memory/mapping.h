// SPDX-License-Identifier: BSD-3-Clause
// Private to the files of this room. Memory of the system, once for POSIX and once for Windows.
#ifndef granular_memory_mapping_h
#define granular_memory_mapping_h

#include "granular/memory/block.h"

#include <cstddef>

namespace granular
{
/// Returns address space for at least this many bytes; a null base if the system has none.
Mapping map_memory(std::size_t bytes) noexcept;

void unmap_memory(const Mapping& mapping) noexcept;

/// Prepares for filling the first bytes, bytes <= capacity. Returns false if the system has no memory for them.
bool expect_bytes(Mapping& mapping, std::size_t bytes) noexcept;

/// Returns the memory behind the first bytes to the system, but keeps the address space.
void keep_bytes(Mapping& mapping, std::size_t bytes) noexcept;

/// Declares the contents unneeded: if memory is short, the system may take it; otherwise it leaves it in place.
void forget_bytes(const Mapping& mapping) noexcept;

/// Returns memory of the heap with the alignment of a block, at least one byte; null: there is none.
void* allocate_heap(std::size_t bytes) noexcept;

/// Frees it, and on POSIX also memory from malloc.
void free_heap(void* data) noexcept;

/// Gives the system what is behind the first bytes of memory of the heap that has `all` of them, where whole pages are free.
void keep_heap(void* data, std::size_t bytes, std::size_t all) noexcept;

/// Returns `data` as memory for free(): `data` itself on POSIX, a copy on Windows. Null: there is no memory for the copy.
void* to_malloc(void* data, std::size_t bytes) noexcept;
}
#endif
