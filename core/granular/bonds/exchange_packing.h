// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_exchange_packing_h
#define granular_bonds_exchange_packing_h

#include "granular/bonds/bonded_particles.h"
#include "granular/bonds/pack_fields.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

namespace granular
{
/// The program whose atom style bond/gran is at the other end of a buffer.
enum class PackDialect : std::uint8_t
{
  Pfm,
  WithBonds ///< also Flexible_Fibers, SEAICE
};

/// The data sent for particles of which a neighbour has copies, with the doubles per particle.
enum class PackRoutine : std::uint8_t
{
  Comm,           ///< positions: 9, or 3 of WithBonds
  CommVelocity,   ///< also velocities: 12, 6
  Border,         ///< all that a new copy needs: 13, 7
  BorderVelocity, ///< 16, 10
  BorderHybrid,   ///< the part of this style in a hybrid: the molecule, 1
  Reverse         ///< the force on a copy, returned to the particle: 3; unpacking adds it
};

/// Returns the doubles per particle.
std::size_t packed_doubles(PackRoutine routine, PackDialect dialect) noexcept;

/// Consecutive rows.
struct ParticleRange
{
  std::size_t first = 0;
  std::size_t count = 0;

  std::size_t size() const noexcept { return count; }
  std::size_t operator[](std::size_t i) const noexcept { return first + i; }
};

/// Rows in any order, possibly repeated.
using ParticleList = std::span<const std::size_t>;

using ParticleRows = std::variant<ParticleRange, ParticleList>;

/// The movement of particle copies across periodic faces during packing. By default they do not move, and all values are
/// copied bit by bit. x moves, x_mol never, as in the programs.
struct PeriodicShift
{
  /// The number of boxes along x, y and z, and the parts that tilts add from yz, xz and xy, as in Domain and Comm of LAMMPS
  /// (pbc).
  std::array<int, 6> counts = {};
  Vector3 lengths = {}; ///< of the box
  double yz = 0;
  double xz = 0;
  double xy = 0;
  bool triclinic = false; ///< tilts count; borders are in units of the box: x is moved by counts

  /// A changing box: the rates of its lengths and tilts, in the order of counts, and the bits of the groups whose velocities
  /// move with it; 0: no particle. v_mol does not.
  std::array<double, 6> rates = {};
  std::int32_t moving_groups = 0;

  bool is_none() const noexcept { return counts == std::array<int, 6>{}; }
};

/// Packs particles into a buffer of exactly the needed doubles: ids by id_to_number, types and masks as values. Throws
/// LimitError if a particle does not exist, or if the buffer has another size; then nothing is packed.
void pack(const BondedParticles& particles, PackRoutine routine, PackDialect dialect,
  const ParticleRows& rows, const PeriodicShift& shift, std::span<double> buffer);

/// Unpacks a buffer of exactly so many particles into rows from `first` on, at most size(); the object grows once if they end
/// behind the last one. Data that are not sent stay unchanged, and are as after add() in new particles. Throws LimitError if
/// a row does not exist, and the errors of BondedParticles::reserve; FormatError that names the particle, from 0, and the
/// double of the buffer; then the object is unchanged, except for room.
void unpack(BondedParticles& particles, PackRoutine routine, PackDialect dialect,
  ParticleRange rows, std::span<const double> buffer);

/// Adds returned forces to the particles of the copies. Throws like unpack and pack.
void unpack_reverse(BondedParticles& particles, ParticleList rows, std::span<const double> buffer);

/// Returns the doubles of pack_exchange: 22 + 2 b + n_h b per particle, or 16 + 2 b + n_h b of WithBonds. Throws LimitError
/// if a particle does not exist.
std::size_t exchange_doubles(
  const BondedParticles& particles, PackDialect dialect, const ParticleRows& rows);

/// Packs all data of particles, except f, for their new rank: length, fields, bonds, history, and the absence of
/// special-neighbour lists. Throws LimitError if a particle does not exist, if the buffer has another size, or if an image
/// count is outside -2^20 to 2^20 - 1.
void pack_exchange(const BondedParticles& particles, PackDialect dialect, const ParticleRows& rows,
  std::span<double> buffer);

/// Adds the particles of a buffer and returns their number. Their B may differ; their n_h must be the same, because it is not
/// sent. Throws FormatError that names the particle, from 0, and the double of the buffer, for a wrong length, number of
/// bonds, integer or image; UnsupportedError for special-neighbour lists; then the object is unchanged.
std::size_t unpack_exchange(
  BondedParticles& particles, PackDialect dialect, std::span<const double> buffer);
}
#endif
