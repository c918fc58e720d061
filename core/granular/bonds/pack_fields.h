// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_pack_fields_h
#define granular_bonds_pack_fields_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// The fields of a particle in a buffer.
enum class PackField : std::uint8_t
{
  X,
  V,
  F,
  XMol,
  VMol,
  Tag,
  Type,
  Mask,
  Image,
  Molecule
};

constexpr bool is_vector(PackField field) noexcept
{
  return field <= PackField::VMol;
}

constexpr std::size_t doubles_of(std::span<const PackField> fields) noexcept
{
  std::size_t doubles = 0;
  for (const PackField field : fields)
  {
    doubles += is_vector(field) ? 3U : 1U;
  }
  return doubles;
}

/// A set of fields, one bit each.
using PackFieldSet = std::uint32_t;

constexpr PackFieldSet set_of(PackField field) noexcept
{
  return PackFieldSet{ 1 } << static_cast<unsigned>(field);
}

constexpr PackFieldSet set_of(std::span<const PackField> fields) noexcept
{
  PackFieldSet set = 0;
  for (const PackField field : fields)
  {
    set |= set_of(field);
  }
  return set;
}

/// The tables of the fields that each routine of the atom style bond/gran sends, in their order: pack_comm,
/// pack_comm_vel, pack_border, pack_border_vel, pack_border_hybrid, pack_reverse and pack_exchange. There are two
/// dialects: PFM, whose particles belong to moving molecules, and `plain`, which WITH-BONDS and Flexible_Fibers use.
/// PFM packs x x_mol v v_mol in one case of a moving periodic box; the tables list what it unpacks.
namespace pack_tables
{
using enum PackField;

inline constexpr std::array comm_pfm{ X, XMol, VMol };
inline constexpr std::array comm_plain{ X };
inline constexpr std::array comm_velocity_pfm{ X, V, XMol, VMol };
inline constexpr std::array comm_velocity_plain{ X, V };
inline constexpr std::array border_pfm{ X, Tag, Type, Mask, Molecule, XMol, VMol };
inline constexpr std::array border_plain{ X, Tag, Type, Mask, Molecule };
inline constexpr std::array border_velocity_pfm{ X, Tag, Type, Mask, Molecule, V, XMol, VMol };
inline constexpr std::array border_velocity_plain{ X, Tag, Type, Mask, Molecule, V };
inline constexpr std::array border_hybrid{ Molecule };
inline constexpr std::array reverse{ F };

/// The fields between the length of the record and the number of bonds.
inline constexpr std::array exchange_pfm{ X, V, Tag, Type, Mask, Image, Molecule, XMol, VMol };
inline constexpr std::array exchange_plain{ X, V, Tag, Type, Mask, Image, Molecule };
}
}
#endif
