// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_header_fields_h
#define granular_formats_restart_header_fields_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace granular
{
enum class FieldKind : std::uint8_t
{
  Text,
  Int,   ///< 4 bytes
  Count, ///< 4 or 8, as the header says
  Real
};

/// The header fields, indexed by the flags in the file (write_restart.cpp of LIGGGHTS-PUBLIC 3; the last one comes from
/// LIGGGHTS-INL).
struct HeaderField
{
  const char* name;
  FieldKind kind;
  bool needed = false;
  std::int64_t low = 0; ///< of whole numbers
  std::int64_t high = std::numeric_limits<std::int64_t>::max();
};

inline constexpr std::int64_t most_restart_processes = 10'000'000;
inline constexpr std::int64_t most_restart_types = 1'000'000;

namespace flag
{
inline constexpr std::size_t version = 0;
inline constexpr std::size_t tag_bytes = 2;
inline constexpr std::size_t count_bytes = 3;
inline constexpr std::size_t units = 4;
inline constexpr std::size_t timestep = 5;
inline constexpr std::size_t dimension = 6;
inline constexpr std::size_t processes = 7;
inline constexpr std::size_t grid = 8; ///< 3
inline constexpr std::size_t newton_bond = 12;
inline constexpr std::size_t periodic = 13; ///< 3
inline constexpr std::size_t boundary = 16; ///< 6
inline constexpr std::size_t atom_style = 22;
inline constexpr std::size_t atoms = 23;
inline constexpr std::size_t types = 24;
inline constexpr std::size_t bonds = 25;
inline constexpr std::size_t box = 37;   ///< 6: lower and upper bound of x, of y, of z
inline constexpr std::size_t tilts = 49; ///< 3: xy xz yz
inline constexpr std::size_t time = 52;
}

inline constexpr std::array<HeaderField, 53> header_fields = { {
  { "the version of the program", FieldKind::Text, true },
  { "the bytes of an integer", FieldKind::Int, true, 4, 4 },
  { "the bytes of an id", FieldKind::Int, true, 4, 8 },
  { "the bytes of a count", FieldKind::Int, true, 4, 8 },
  { "the units", FieldKind::Text, true },
  { "the timestep", FieldKind::Count, true },
  { "the dimension", FieldKind::Int, true, 2, 3 },
  { "the number of processes", FieldKind::Int, true, 1, most_restart_processes },
  { "the processes along x", FieldKind::Int, true, 1, most_restart_processes },
  { "the processes along y", FieldKind::Int, true, 1, most_restart_processes },
  { "the processes along z", FieldKind::Int, true, 1, most_restart_processes },
  { "newton for pairs", FieldKind::Int, false, 0, 1 },
  { "newton for bonds", FieldKind::Int, true, 0, 1 },
  { "whether x is periodic", FieldKind::Int, true, 0, 1 },
  { "whether y is periodic", FieldKind::Int, true, 0, 1 },
  { "whether z is periodic", FieldKind::Int, true, 0, 1 },
  { "the lower boundary of x", FieldKind::Int, true, 0, 3 },
  { "the upper boundary of x", FieldKind::Int, true, 0, 3 },
  { "the lower boundary of y", FieldKind::Int, true, 0, 3 },
  { "the upper boundary of y", FieldKind::Int, true, 0, 3 },
  { "the lower boundary of z", FieldKind::Int, true, 0, 3 },
  { "the upper boundary of z", FieldKind::Int, true, 0, 3 },
  { "the atom style", FieldKind::Text, true },
  { "the number of particles", FieldKind::Count, true },
  { "the number of types", FieldKind::Int, true, 0, most_restart_types },
  { "the number of bonds", FieldKind::Count },
  { "the number of bond types", FieldKind::Int },
  { "the bonds per particle", FieldKind::Int },
  { "the number of angles", FieldKind::Count },
  { "the number of angle types", FieldKind::Int },
  { "the angles per particle", FieldKind::Int },
  { "the number of dihedrals", FieldKind::Count },
  { "the number of dihedral types", FieldKind::Int },
  { "the dihedrals per particle", FieldKind::Int },
  { "the number of impropers", FieldKind::Count },
  { "the number of improper types", FieldKind::Int },
  { "the impropers per particle", FieldKind::Int },
  { "the lower bound of x", FieldKind::Real, true },
  { "the upper bound of x", FieldKind::Real, true },
  { "the lower bound of y", FieldKind::Real, true },
  { "the upper bound of y", FieldKind::Real, true },
  { "the lower bound of z", FieldKind::Real, true },
  { "the upper bound of z", FieldKind::Real, true },
  { "the first weight of special_bonds lj", FieldKind::Real },
  { "the second weight of special_bonds lj", FieldKind::Real },
  { "the third weight of special_bonds lj", FieldKind::Real },
  { "the first weight of special_bonds coul", FieldKind::Real },
  { "the second weight of special_bonds coul", FieldKind::Real },
  { "the third weight of special_bonds coul", FieldKind::Real },
  { "the tilt xy", FieldKind::Real },
  { "the tilt xz", FieldKind::Real },
  { "the tilt yz", FieldKind::Real },
  { "the time", FieldKind::Real },
} };
}
#endif
