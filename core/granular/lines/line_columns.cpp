// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/line_columns.h"

#include "granular/common/error.h"
#include "granular/common/words.h"

#include <algorithm>
#include <iterator>

namespace granular
{
namespace
{
constexpr ValueType I32 = ValueType::Int32;
constexpr ValueType I64 = ValueType::Int64;
constexpr ValueType F64 = ValueType::Float64;
constexpr ColumnRole Other = ColumnRole::Other;

constexpr KnownColumn table[] = {
  // clang-format off
  // name                  type role            array                i  n  unit  meaning
  { "id1",                 I64, ColumnRole::Id, "",                  0, 1, "-",   "id of the particle at the first end" },
  { "id2",                 I64, ColumnRole::Id, "",                  1, 1, "-",   "id of the particle at the second end" },
  { "bond_id",             I64, Other,          "",                  0, 1, "-",   "number of the bond in a data file" },
  { "index",               I64, Other,          "",                  0, 1, "-",   "number of the row, from 1" },
  { "btype",               I32, Other,          "",                  0, 1, "-",   "type of the bond, from 1; negative where it is breaking" },
  { "type1",               I32, Other,          "",                  0, 1, "-",   "type of the particle at the first end" },
  { "type2",               I32, Other,          "",                  0, 1, "-",   "type of the particle at the second end" },
  { "periodic",            I32, Other,          "",                  0, 1, "-",   "1: a face of the box lies between the ends, 0: none does" },
  { "mesh",                I64, Other,          "",                  0, 1, "-",   "number of the mesh that is touched" },
  { "triangle",            I64, Other,          "",                  0, 1, "-",   "number of the triangle that is touched" },
  { "x1",                  F64, Other,          "position1",         0, 3, "m",   "first end" },
  { "y1",                  F64, Other,          "position1",         1, 3, "m",   "first end" },
  { "z1",                  F64, Other,          "position1",         2, 3, "m",   "first end" },
  { "x2",                  F64, Other,          "position2",         0, 3, "m",   "second end" },
  { "y2",                  F64, Other,          "position2",         1, 3, "m",   "second end" },
  { "z2",                  F64, Other,          "position2",         2, 3, "m",   "second end" },
  { "vx1",                 F64, Other,          "v1",                0, 3, "m/s", "velocity at the first end" },
  { "vy1",                 F64, Other,          "v1",                1, 3, "m/s", "velocity at the first end" },
  { "vz1",                 F64, Other,          "v1",                2, 3, "m/s", "velocity at the first end" },
  { "vx2",                 F64, Other,          "v2",                0, 3, "m/s", "velocity at the second end" },
  { "vy2",                 F64, Other,          "v2",                1, 3, "m/s", "velocity at the second end" },
  { "vz2",                 F64, Other,          "v2",                2, 3, "m/s", "velocity at the second end" },
  { "forcex",              F64, Other,          "force",             0, 3, "N",   "force on the first particle" },
  { "forcey",              F64, Other,          "force",             1, 3, "N",   "force on the first particle" },
  { "forcez",              F64, Other,          "force",             2, 3, "N",   "force on the first particle" },
  { "force_normalx",       F64, Other,          "force_normal",      0, 3, "N",   "its part along the line" },
  { "force_normaly",       F64, Other,          "force_normal",      1, 3, "N",   "its part along the line" },
  { "force_normalz",       F64, Other,          "force_normal",      2, 3, "N",   "its part along the line" },
  { "force_tangentialx",   F64, Other,          "force_tangential",  0, 3, "N",   "its part across the line" },
  { "force_tangentialy",   F64, Other,          "force_tangential",  1, 3, "N",   "its part across the line" },
  { "force_tangentialz",   F64, Other,          "force_tangential",  2, 3, "N",   "its part across the line" },
  { "torquex",             F64, Other,          "torque",            0, 3, "N m", "torque on the first particle" },
  { "torquey",             F64, Other,          "torque",            1, 3, "N m", "torque on the first particle" },
  { "torquez",             F64, Other,          "torque",            2, 3, "N m", "torque on the first particle" },
  { "torque_normalx",      F64, Other,          "torque_normal",     0, 3, "N m", "its part along the line: torsion" },
  { "torque_normaly",      F64, Other,          "torque_normal",     1, 3, "N m", "its part along the line: torsion" },
  { "torque_normalz",      F64, Other,          "torque_normal",     2, 3, "N m", "its part along the line: torsion" },
  { "torque_tangentialx",  F64, Other,          "torque_tangential", 0, 3, "N m", "its part across the line: bending" },
  { "torque_tangentialy",  F64, Other,          "torque_tangential", 1, 3, "N m", "its part across the line: bending" },
  { "torque_tangentialz",  F64, Other,          "torque_tangential", 2, 3, "N m", "its part across the line: bending" },
  { "contact_pointx",      F64, Other,          "contact_point",     0, 3, "m",   "where the particles touch" },
  { "contact_pointy",      F64, Other,          "contact_point",     1, 3, "m",   "where the particles touch" },
  { "contact_pointz",      F64, Other,          "contact_point",     2, 3, "m",   "where the particles touch" },
  { "contact_area",        F64, Other,          "",                  0, 1, "m2",  "area of the contact" },
  { "delta",               F64, Other,          "",                  0, 1, "m",   "overlap" },
  { "heat_flux",           F64, Other,          "",                  0, 1, "W",   "heat through the contact" },
  { "ms_id1",              I64, Other,          "",                  0, 1, "-",   "multisphere body of the first particle" },
  { "ms_id2",              I64, Other,          "",                  0, 1, "-",   "multisphere body of the second particle" },
  { "dist",                F64, Other,          "",                  0, 1, "m",   "distance of the ends, as the simulation has it" },
  { "initial_length",      F64, Other,          "",                  0, 1, "m",   "length of the bond when it was made" },
  { "equilibrium_length",  F64, Other,          "",                  0, 1, "m",   "length of the bond without force" },
  { "damage",              F64, Other,          "",                  0, 1, "-",   "1: the bond is whole, 0: it has failed" },
  { "broken",              F64, Other,          "",                  0, 1, "-",   "1: the bond is broken" },
  { "engpot",              F64, Other,          "",                  0, 1, "J",   "energy of the bond" },
  { "force_magnitude",     F64, Other,          "",                  0, 1, "N",   "force along the bond" },
  // clang-format on
};

/// Other spellings of columns: by property/local, bond/local and pair/local of LIGGGHTS, LAMMPS and their forks, by
/// scripts that name them, and by the manual of OVITO.
constexpr std::string_view spellings[][2] = {
  { "batom1", "id1" },
  { "batom2", "id2" },
  { "natom1", "id1" },
  { "natom2", "id2" },
  { "patom1", "id1" },
  { "patom2", "id2" },
  { "tag1", "id1" },
  { "tag2", "id2" },
  { "atom1", "id1" },
  { "atom2", "id2" },
  { "ParticleIdentifiers.A", "id1" },
  { "ParticleIdentifiers.B", "id2" },
  { "BondType", "btype" },
  { "bond_type", "btype" },
  { "ntype1", "type1" },
  { "ntype2", "type2" },
  { "ptype1", "type1" },
  { "ptype2", "type2" },
  { "batom1x", "x1" },
  { "batom1y", "y1" },
  { "batom1z", "z1" },
  { "batom2x", "x2" },
  { "batom2y", "y2" },
  { "batom2z", "z2" },
  { "bforceX", "forcex" },
  { "bforceY", "forcey" },
  { "bforceZ", "forcez" },
  { "btorqueX", "torquex" },
  { "btorqueY", "torquey" },
  { "btorqueZ", "torquez" },
  { "beqdist", "equilibrium_length" },
  { "bbondbroken", "broken" },
  { "fx", "forcex" },
  { "fy", "forcey" },
  { "fz", "forcez" },
  { "distance", "dist" },
  { "contactArea", "contact_area" },
  { "heatFlux", "heat_flux" },
};

/// Values that the computes of contacts print for a keyword, in this order; nothing is known of history.
constexpr std::string_view keywords[][2] = {
  { "pos", "x1 y1 z1 x2 y2 z2" },
  { "vel", "vx1 vy1 vz1 vx2 vy2 vz2" },
  { "id", "id1 id2 periodic" },
  { "wall_id", "mesh triangle id2" },
  { "force", "forcex forcey forcez" },
  { "force_normal", "force_normalx force_normaly force_normalz" },
  { "force_tangential", "force_tangentialx force_tangentialy force_tangentialz" },
  { "torque", "torquex torquey torquez" },
  { "torque_normal", "torque_normalx torque_normaly torque_normalz" },
  { "torque_tangential", "torque_tangentialx torque_tangentialy torque_tangentialz" },
  { "history", "" },
  { "contactArea", "contact_area" },
  { "delta", "delta" },
  { "contactPoint", "contact_pointx contact_pointy contact_pointz" },
  { "ms_id", "ms_id1 ms_id2" },
  { "heatFlux", "heat_flux" },
};

template <std::size_t Size>
std::string_view find(const std::string_view (&pairs)[Size][2], std::string_view name) noexcept
{
  const auto* const found = std::find_if(
    std::begin(pairs), std::end(pairs), [&](const auto& pair) { return pair[0] == name; });
  return found == std::end(pairs) ? std::string_view() : (*found)[1];
}
}

std::span<const KnownColumn> local_known_columns() noexcept
{
  return table;
}

std::string_view local_name(std::string_view name) noexcept
{
  const std::string_view known = find(spellings, name);
  return known.empty() ? name : known;
}

std::vector<std::string> expand_keywords(std::vector<std::string> words, std::size_t columns)
{
  const auto place = [](const std::string& word)
  {
    return std::ranges::find_if(keywords, [&](const auto& entry) { return entry[0] == word; }) -
      std::begin(keywords);
  };
  const auto is_keyword = [&](const std::string& word)
  { return place(word) < static_cast<std::ptrdiff_t>(std::size(keywords)); };
  const auto before = [&](const std::string& a, const std::string& b)
  { return place(a) < place(b); };
  if (std::ranges::all_of(words, is_keyword))
  {
    std::ranges::stable_sort(words, before);
  }
  else if (words.size() == columns) // force may be the number that LAMMPS calls so
  {
    std::ranges::transform(
      words, words.begin(), [](const auto& word) { return std::string(local_name(word)); });
    return words;
  }
  for (std::size_t i = 1; i < words.size(); ++i)
  {
    if (is_keyword(words[i - 1]) && is_keyword(words[i]) && before(words[i], words[i - 1]))
    {
      throw FormatError("expected keywords in the order in which the compute prints them, '" +
        words[i] + "' before '" + words[i - 1] + "', or names of single columns (forcex)");
    }
  }
  std::vector<std::string> names;
  std::ptrdiff_t history = -1;
  for (const std::string& word : words)
  {
    const std::vector<std::string_view> printed = split_words(find(keywords, word));
    names.insert(names.end(), printed.begin(), printed.end());
    if (word == "history")
    {
      history = static_cast<std::ptrdiff_t>(names.size());
    }
    else if (printed.empty())
    {
      names.emplace_back(local_name(word));
    }
  }
  std::vector<std::string> rest; // what is left, of the last history
  while (history >= 0 && names.size() + rest.size() < columns)
  {
    rest.push_back("history" + std::to_string(rest.size() + 1));
  }
  names.insert(names.begin() + std::max<std::ptrdiff_t>(history, 0), rest.begin(), rest.end());
  return names;
}

ColumnSchema make_local_schema(const std::vector<std::string>& names)
{
  return ColumnSchema(names, table);
}

std::vector<std::string> local_component_names(std::string_view array, int components)
{
  std::vector<std::string> names;
  for (const KnownColumn& column : table)
  {
    if (!column.array.empty() && column.array == array && column.components == components)
    {
      names.emplace_back(column.name);
    }
  }
  return names;
}

bool has_ends(const ColumnSchema& schema)
{
  const auto is_end = [&](std::string_view name)
  {
    const int found = schema.find_array(name); // or a column that has the name of the array
    const ArrayInfo* const array =
      found < 0 ? nullptr : &schema.arrays()[static_cast<std::size_t>(found)];
    return array && array->components() == 3 && array->type == ValueType::Float64;
  };
  return is_end("position1") && is_end("position2");
}

bool has_ids(const ColumnSchema& schema)
{
  return schema.find(ColumnRole::Id, 0) >= 0 && schema.find(ColumnRole::Id, 1) >= 0;
}
}
