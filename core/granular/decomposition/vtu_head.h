// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_vtu_head_h
#define granular_decomposition_vtu_head_h

#include <cstdint>
#include <string_view>

namespace granular
{
/// How many bytes of a .vtu file are looked at: the names of its arrays, mostly not their values.
inline constexpr std::size_t vtu_head_bytes = std::size_t{ 1 } << 16;

/// Whether the head says that the file has unstructured grids.
bool is_unstructured(std::string_view head) noexcept;

/// The sum of NumberOfCells of the pieces, as far as the head goes.
std::int64_t cells_in(std::string_view head) noexcept;

/// Whether the head has an array of cell data of that name.
bool has_cell_array(std::string_view head, std::string_view name) noexcept;
}
#endif
