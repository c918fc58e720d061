// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/atom_rows.h"

#include "granular/dump/write/frame_plan.h"
#include "granular/dump/write/row_encoder.h"

#include <algorithm>

namespace granular
{
int atom_row_values(const AtomForm& form) noexcept
{
  return form.image ? 8 : 5;
}

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

void pack_atom_rows(const AtomRows& atoms, const Box& box, const AtomForm& form, std::int64_t first,
  std::int64_t count, std::span<double> to)
{
  if (first < 0 || count < 0 || count > atoms.rows - first ||
    static_cast<std::size_t>(count) > to.size() / static_cast<std::size_t>(atom_row_values(form)))
  {
    throw LimitError("expected rows among " + std::to_string(atoms.rows) + " and room for " +
      std::to_string(to.size()) + " values, got " + std::to_string(count) + " rows from " +
      std::to_string(first) + " on");
  }
  if (form.scaled)
  {
    check_volume(box);
  }
  const FrameView frame = view_atoms(atoms, {});
  Notices none; // images that are not there are 0
  const ColumnPlan plan = plan_columns(atom_columns(form), frame, true, none);
  RowValues values;
  constexpr auto most = static_cast<std::int64_t>(RowValues::most_rows);
  for (std::int64_t done = 0; done < count; done += most)
  {
    values.load(frame, plan, box, first + done, std::min(most, count - done), first + done);
    pack_rows(values, plan, 0, values.rows(),
      reinterpret_cast<char*>(to.data() + static_cast<std::size_t>(done * atom_row_values(form))));
  }
}
}
