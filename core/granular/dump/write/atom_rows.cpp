// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/atom_rows.h"

namespace granular
{
std::vector<std::string> atom_columns(const AtomForm& form)
{
  std::vector<std::string> names = form.scaled
    ? std::vector<std::string>{ "id", "type", "xs", "ys", "zs" }
    : std::vector<std::string>{ "id", "type", "x", "y", "z" };
  if (form.image)
  {
    names.insert(names.end(), { "ix", "iy", "iz" });
  }
  return names;
}

FrameView view_atoms(const AtomRows& atoms, const FrameHeader& header)
{
  FrameView frame;
  frame.header = header;
  frame.rows = atoms.rows;
  frame.points = view_rows("points", ValueType::Float64, atoms.positions, 3);
  frame.arrays.push_back(view_rows("id", ValueType::Int64, atoms.ids));
  frame.arrays.push_back(view_rows("type", ValueType::Int32, atoms.types));
  if (atoms.images)
  {
    frame.arrays.push_back(view_rows("image", ValueType::Int32, atoms.images, 3));
  }
  return frame;
}
}
