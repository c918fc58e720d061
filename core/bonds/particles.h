// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_particles_h
#define granular_bonds_particles_h

#include "granular_bonds.h"

#include "granular/common/error.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>

namespace granular
{
/// The caller of the C interface gave something that cannot be used.
class BadBondArgument : public Error
{
  using Error::Error;
};

/// The arrays of particles in the order of their memory: those of 8 bytes, then those of 4.
enum class BondField : std::uint8_t
{
  X,
  V,
  F,
  XMol,
  VMol,
  Tag,
  Molecule,
  Partners,
  History,
  Type,
  Mask,
  Image,
  Bonds, ///< how many
  BondTypes
};

/// The arrays by BondField.
inline constexpr std::tuple bond_arrays = { &granular_bonds_arrays::x, &granular_bonds_arrays::v,
  &granular_bonds_arrays::f, &granular_bonds_arrays::x_mol, &granular_bonds_arrays::v_mol,
  &granular_bonds_arrays::tag, &granular_bonds_arrays::molecule, &granular_bonds_arrays::partners,
  &granular_bonds_arrays::history, &granular_bonds_arrays::type, &granular_bonds_arrays::mask,
  &granular_bonds_arrays::image, &granular_bonds_arrays::bonds,
  &granular_bonds_arrays::bond_types };

/// A bit for each of some fields.
template <class... Fields>
constexpr std::uint32_t set_of(Fields... fields) noexcept
{
  return (... | (std::uint32_t{ 1 } << static_cast<unsigned>(fields)));
}

/// Particles with bonds in the layout of the atom style bond/gran: see granular_bonds.h. An error leaves the object as it was.
class BondedParticles
{
public:
  BondedParticles(std::int32_t most_bonds, std::int32_t history_values);

  std::size_t most_bonds() const noexcept { return static_cast<std::size_t>(arrays_.most_bonds); }
  std::size_t history_values() const noexcept
  {
    return static_cast<std::size_t>(arrays_.history_values);
  }
  std::size_t size() const noexcept { return arrays_.size; }
  const granular_bonds_arrays& arrays() const noexcept { return arrays_; }

  void grow(std::size_t capacity);

  /// `written` is the set of fields that the caller will write in new rows: these may then have any value.
  void resize(std::size_t size, std::uint32_t written = 0);
  std::size_t add(std::int32_t type, const double* x);
  void add_bond(std::size_t row, std::int32_t type, std::int64_t partner, const double* history);
  void set_bonds(std::size_t row, std::size_t count);
  void remove(std::size_t row);

  /// Throws if there is no such row.
  void expect_row(std::size_t row) const;

  std::size_t bonds(std::size_t row) const noexcept
  {
    return static_cast<std::size_t>(arrays_.bonds[row]);
  }

  /// The bonds of a particle: B types, B partners, and n_h values of each.
  std::int32_t* bond_types(std::size_t row) const noexcept
  {
    return arrays_.bond_types + row * this->most_bonds();
  }
  std::int64_t* partners(std::size_t row) const noexcept
  {
    return arrays_.partners + row * this->most_bonds();
  }
  double* history(std::size_t row) const noexcept
  {
    return arrays_.history + row * this->most_bonds() * this->history_values();
  }

private:
  /// Calls visit(array, elements a row) for each array in the order of BondField.
  template <class Visit>
  void for_arrays(const Visit& visit) const;

  std::size_t row_bytes() const noexcept;
  std::size_t most_particles() const noexcept;

  granular_bonds_arrays arrays_ = {};
  std::unique_ptr<std::byte[]> memory_; ///< of all arrays
};
}
#endif
