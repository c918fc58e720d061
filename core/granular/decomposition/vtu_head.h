// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_vtu_head_h
#define granular_decomposition_vtu_head_h

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace granular
{
/// The bytes of a .vtu file that are looked at: the names of its arrays, mostly not their values.
inline constexpr std::size_t vtu_head_bytes = std::size_t{ 1 } << 16;

/// The tags at the beginning of a file.
struct VtuHead
{
  bool unstructured = false;  ///< it is a .vtu file
  std::int64_t cells = 0;     ///< the sum of NumberOfCells of the pieces
  bool fits = true;           ///< all pieces have points, at most eight a cell
  bool has_particles = false; ///< there is an array nlocal of cells
  bool has_ranks = false;     ///< there is an array proc or procID of cells
};

/// Reads the tags as long as the text goes and they are right.
VtuHead look_at(std::string_view text);
}
#endif
