// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_bonded_particles_h
#define granular_bonds_bonded_particles_h

#include "granular/bonds/bond_record.h"
#include "granular/bonds/pack_fields.h"
#include "granular/geometry/box.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace granular
{
/// The memory of particles, in bytes.
struct BondedMemory
{
  std::size_t described = 0; ///< n_max (5 x 24 + 4 (4 + B) + 8 B n_h), as bond/gran estimates it
  std::size_t allocated = 0; ///< by this object, in total
};

/// Particles with bonds, in the layout of the atom style bond/gran of LIGGGHTS' forks: one array per quantity, with a row for
/// each particle. Spans are valid until the object grows and cover the particles, not the capacity.
///
/// A particle holds at most B bonds: each has a type, the global id of its partner, and n_h history values (see
/// history_layouts). A bond is usually stored with both of its particles. Types and ids may have any value; duplicate bonds
/// and bonds of a particle with itself are kept.
class BondedParticles
{
public:
  /// The growth of grow(0), and the least growth of reserve.
  static constexpr std::size_t growth = 10000;

  /// Sets B and n_h. Throws LimitError if B < 1, n_h < 0 or B n_h > 2^40.
  BondedParticles(std::int32_t most_bonds, std::int32_t history_values);

  /// A moved-from object keeps B and n_h, and has neither particles nor room.
  BondedParticles(BondedParticles&& other) noexcept;
  BondedParticles& operator=(BondedParticles&& other) noexcept;
  BondedParticles(const BondedParticles&) = delete;
  BondedParticles& operator=(const BondedParticles&) = delete;
  ~BondedParticles() = default;

  std::int32_t most_bonds() const noexcept { return most_bonds_; }
  std::int32_t history_values() const noexcept { return history_values_; }
  std::size_t size() const noexcept { return size_; }
  std::size_t capacity() const noexcept { return capacity_; }

  /// Makes room for so many particles; 0: for 10,000 more. Keeps the particles. Throws LimitError if there are more
  /// particles, or if no memory could be as large; std::bad_alloc; then nothing has changed. The style grows in such steps,
  /// each of which copies all particles; to add many one by one call reserve, as resize and add do.
  void grow(std::size_t capacity = 0);

  /// Makes room for so many particles if there is less: for half as many again as before, and at least 10,000 more, so each
  /// particle is copied only a few times. Throws like grow.
  void reserve(std::size_t size);

  /// Sets the number of particles, with room as in reserve. New particles are like those of add, of type 0 at the origin.
  /// Throws like grow. A caller who writes all fields of new particles may say so; they may then have any value.
  void resize(std::size_t size, PackFieldSet written = 0);

  /// Adds a particle without bonds and returns its row: tag 0, mask 1, molecule 0, image 0; v, f, x_mol and v_mol are zero.
  std::size_t add(std::int32_t type, const Vector3& x);

  /// Adds a bond to a particle. Throws LimitError if there is no such particle, if it holds B bonds, or if there are not
  /// n_h values.
  void add_bond(
    std::size_t i, std::int32_t type, std::int64_t partner, std::span<const double> history);

  /// Sets the number of bonds of a particle. New bonds have type, partner and history 0. Throws LimitError.
  void set_bonds(std::size_t i, std::size_t count);

  /// Removes a particle: the last one takes its row. Throws LimitError if there is no such particle.
  void remove(std::size_t i);

  /// Removes all particles; the room stays.
  void clear() noexcept { size_ = 0; }

  std::span<Vector3> x() noexcept { return { arrays_.x.get(), size_ }; }
  std::span<const Vector3> x() const noexcept { return { arrays_.x.get(), size_ }; }
  std::span<Vector3> v() noexcept { return { arrays_.v.get(), size_ }; }
  std::span<const Vector3> v() const noexcept { return { arrays_.v.get(), size_ }; }
  std::span<Vector3> f() noexcept { return { arrays_.f.get(), size_ }; }
  std::span<const Vector3> f() const noexcept { return { arrays_.f.get(), size_ }; }

  /// The molecule that a particle belongs to.
  std::span<Vector3> x_mol() noexcept { return { arrays_.x_mol.get(), size_ }; }
  std::span<const Vector3> x_mol() const noexcept { return { arrays_.x_mol.get(), size_ }; }
  std::span<Vector3> v_mol() noexcept { return { arrays_.v_mol.get(), size_ }; }
  std::span<const Vector3> v_mol() const noexcept { return { arrays_.v_mol.get(), size_ }; }

  std::span<std::int64_t> tag() noexcept { return { arrays_.tag.get(), size_ }; }
  std::span<const std::int64_t> tag() const noexcept { return { arrays_.tag.get(), size_ }; }
  std::span<std::int64_t> molecule() noexcept { return { arrays_.molecule.get(), size_ }; }
  std::span<const std::int64_t> molecule() const noexcept
  {
    return { arrays_.molecule.get(), size_ };
  }
  std::span<std::int32_t> type() noexcept { return { arrays_.type.get(), size_ }; }
  std::span<const std::int32_t> type() const noexcept { return { arrays_.type.get(), size_ }; }

  /// A bit for each group of a particle.
  std::span<std::int32_t> mask() noexcept { return { arrays_.mask.get(), size_ }; }
  std::span<const std::int32_t> mask() const noexcept { return { arrays_.mask.get(), size_ }; }

  /// The crossings of the periodic box by a particle.
  std::span<ImageCounts> image() noexcept { return { arrays_.image.get(), size_ }; }
  std::span<const ImageCounts> image() const noexcept { return { arrays_.image.get(), size_ }; }

  /// The number of bonds of each particle: b, 0 to B.
  std::span<const std::int32_t> bonds() const noexcept { return { arrays_.bonds.get(), size_ }; }

  /// The bonds of a particle, which must exist: b types, b partners, and n_h values of the first, of the second, ...
  std::span<std::int32_t> bond_types(std::size_t i) noexcept
  {
    return { arrays_.bond_types.get() + i * this->width(), this->count(i) };
  }
  std::span<const std::int32_t> bond_types(std::size_t i) const noexcept
  {
    return { arrays_.bond_types.get() + i * this->width(), this->count(i) };
  }
  std::span<std::int64_t> partners(std::size_t i) noexcept
  {
    return { arrays_.partners.get() + i * this->width(), this->count(i) };
  }
  std::span<const std::int64_t> partners(std::size_t i) const noexcept
  {
    return { arrays_.partners.get() + i * this->width(), this->count(i) };
  }
  std::span<double> history(std::size_t i) noexcept
  {
    return { arrays_.history.get() + i * this->history_width(), this->count(i) * this->values() };
  }
  std::span<const double> history(std::size_t i) const noexcept
  {
    return { arrays_.history.get() + i * this->history_width(), this->count(i) * this->values() };
  }

  BondedMemory memory() const noexcept;

private:
  struct Arrays
  {
    std::unique_ptr<Vector3[]> x, v, f, x_mol, v_mol;
    std::unique_ptr<std::int64_t[]> tag, molecule;
    std::unique_ptr<std::int32_t[]> type, mask;
    std::unique_ptr<ImageCounts[]> image;
    std::unique_ptr<std::int32_t[]> bonds;
    std::unique_ptr<std::int32_t[]> bond_types;
    std::unique_ptr<std::int64_t[]> partners;
    std::unique_ptr<double[]> history;
  };

  std::size_t count(std::size_t i) const noexcept
  {
    return static_cast<std::size_t>(arrays_.bonds[i]);
  }
  std::size_t values() const noexcept { return static_cast<std::size_t>(history_values_); }
  std::size_t width() const noexcept { return static_cast<std::size_t>(most_bonds_); }
  std::size_t history_width() const noexcept { return this->width() * this->values(); }

  /// Calls visit(array, elements per particle) for each array.
  template <class Visit>
  void for_arrays(const Visit& visit) const;

  void set_defaults(std::size_t first, std::size_t end, PackFieldSet written) noexcept;
  std::size_t row_bytes() const noexcept;
  std::size_t most_particles() const noexcept;
  void expect_particle(std::size_t i) const;

  std::int32_t most_bonds_;
  std::int32_t history_values_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
  Arrays arrays_;
};
}
#endif
