// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_atom_rows_h
#define granular_dump_write_atom_rows_h

#include "granular/particles/frame_view.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// The columns of dump atom. With tilted or orthogonal boxes, as text or binary, it has 16 forms.
struct AtomForm
{
  bool scaled = true; ///< xs ys zs; false: x y z
  bool image = false; ///< also ix iy iz
};

/// Returns "id type xs ys zs", "id type x y z ix iy iz", ...
std::vector<std::string> atom_columns(const AtomForm& form);

/// The atoms of one rank, in the arrays of a simulation code.
struct AtomRows
{
  std::int64_t rows = 0;
  const std::int64_t* ids = nullptr;
  const std::int32_t* types = nullptr;
  const double* positions = nullptr;    ///< x y z of each atom, in the box
  const std::int32_t* images = nullptr; ///< three for each atom; null: all are 0
};

/// Returns the frame of these atoms.
FrameView view_atoms(const AtomRows& atoms, const FrameHeader& header);
}
#endif
