// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_atom_rows_h
#define granular_dump_write_atom_rows_h

#include "granular/geometry/box.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// The columns of dump atom. With a tilted box or not, as text or binary, it has 16 forms.
struct AtomForm
{
  bool scaled = true; ///< xs ys zs, else x y z
  bool image = false; ///< and ix iy iz
};

/// Values a row: 5, or 8 with the image.
int atom_row_values(const AtomForm& form) noexcept;

/// "id type xs ys zs", "id type x y z ix iy iz", ...
std::vector<std::string> atom_columns(const AtomForm& form);

/// The atoms of one process, in the arrays of a simulation code.
struct AtomRows
{
  std::int64_t rows = 0;
  const std::int64_t* ids = nullptr;
  const std::int32_t* types = nullptr;
  const double* positions = nullptr;    ///< x y z of each, in the box
  const std::int32_t* images = nullptr; ///< three of each; null: none was crossed
};

/// The frame that they are.
FrameView view_atoms(const AtomRows& atoms, const FrameHeader& header);

/// Packs rows [first, first + count) as dump atom does, atom_row_values doubles each: id, type, c, image, where c
/// is x, or lambda with x = x_lo + H lambda, the columns of H being the vectors of the box: (Lx, 0, 0),
/// (xy, Ly, 0), (xz, yz, Lz), by back substitution. Each lambda is the exact one rounded, as convert_positions
/// has it. Throws Error for a scaled form of a box without volume, LimitError for ids that are no doubles,
/// rows that there are not, and too little room.
void pack_atom_rows(const AtomRows& atoms, const Box& box, const AtomForm& form, std::int64_t first,
  std::int64_t count, std::span<double> to);
}
#endif
