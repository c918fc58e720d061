// SPDX-License-Identifier: BSD-3-Clause
// Packings by properties, and as tables.
#include "granular/packing/packing.h"

#include "granular/common/error.h"
#include "granular/packing/packing_plan.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <string>
#include <utility>

namespace granular
{
namespace
{
Table bond_table(const FrameHeader& header, GrainBonds&& bonds)
{
  Table table;
  table.rows = bonds.count;
  table.header = header;
  table.has_lines = true;
  table.lines.count = bonds.count;
  table.lines.points = std::move(bonds.points);
  table.lines.lengths = Block(bonds.equilibrium_length.bytes());
  if (bonds.count > 0)
  {
    std::memcpy(
      table.lines.lengths.data(), bonds.equilibrium_length.data(), table.lines.lengths.bytes());
  }
  add_array(table, "id1", ValueType::Int64, 1, std::move(bonds.id1));
  add_array(table, "id2", ValueType::Int64, 1, std::move(bonds.id2));
  add_array(table, "btype", ValueType::Int32, 1, std::move(bonds.btype));
  add_array(
    table, "equilibrium_length", ValueType::Float64, 1, std::move(bonds.equilibrium_length));
  return table;
}
}

Arrangement arrangement_of(std::int64_t number)
{
  constexpr std::array<std::pair<std::int64_t, Arrangement>, 4> all = {
    { { 0, Arrangement::Random }, { 1, Arrangement::SimpleCubic },
      { 2, Arrangement::FaceCentredCubic }, { 4, Arrangement::Chain } }
  };
  const auto found = std::ranges::find(all, number, &decltype(all)::value_type::first);
  if (found == all.end())
  {
    throw LimitError("expected the Arrangement 0 (Random), 1 (SimpleCubic), 2 (FaceCentredCubic) "
                     "or 4 (Chain), got " +
      std::to_string(number));
  }
  return found->second;
}

RadiusChoice::Kind radii_of(std::int64_t number)
{
  if (number != 0 && number != 1)
  {
    throw LimitError("expected the Radii 0 (One) or 1 (Two), got " + std::to_string(number));
  }
  return number == 0 ? RadiusChoice::Kind::One : RadiusChoice::Kind::Two;
}

std::optional<Box> find_box(const Vector3& origin, const Vector3& lengths, const Vector3& tilts)
{
  const auto& [xy, xz, yz] = tilts;
  if (std::ranges::count(lengths, 0) == 3)
  {
    if (xy != 0 || xz != 0 || yz != 0)
    {
      throw LimitError("expected BoxLengths of the box that BoxTilts are of, got none");
    }
    return {};
  }
  for (const double length : lengths)
  {
    if (!(length > 0))
    {
      throw LimitError("expected BoxLengths greater than 0, got " + std::to_string(length));
    }
  }
  return Box::from_edges(origin,
    { Vector3{ lengths[0], 0, 0 }, Vector3{ xy, lengths[1], 0 }, Vector3{ xz, yz, lengths[2] } });
}

Tables make_packing(const PackingRequest& request, double bond_factor, PartialProgress& progress)
try
{
  Tables made;
  const bool bonded = bond_factor != 0;
  progress.set_part(0, 0.6);
  const PackingPlan plan(request, progress);
  progress.set_part(0.6, bonded ? 0.8 : 1);
  made.rows = make_packing(plan, progress);
  if (bonded)
  {
    progress.set_part(0.8, 1);
    made.bonds = bond_table(made.rows.header, make_bonds(plan, bond_factor, progress));
  }
  return made;
}
catch (const std::bad_alloc&)
{
  throw MemoryError("not enough memory for so many grains and bonds: ask for fewer, "
                    "or use more processes on more machines");
}
}
