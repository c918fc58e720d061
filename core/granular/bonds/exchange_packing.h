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
/// Whose atom style bond/gran is at the other end of a buffer.
enum class PackDialect : std::uint8_t
{
  Pfm,
  WithBonds ///< and Flexible_Fibers, SEAICE
};

/// What is sent of particles that a neighbour has copies of: of each as many doubles.
enum class PackRoutine : std::uint8_t
{
  Comm,           ///< where they are: 9, or 3 of WithBonds
  CommVelocity,   ///< and how they move: 12, 6
  Border,         ///< what a new copy needs: 13, 7
  BorderVelocity, ///< 16, 10
  BorderHybrid,   ///< what this style adds to those of a hybrid: the molecule, 1
  Reverse         ///< the force on a copy, back to the particle: 3; unpacking adds it
};

/// Doubles of a particle.
std::size_t packed_doubles(PackRoutine routine, PackDialect dialect) noexcept;

/// Rows one after the other.
struct ParticleRange
{
  std::size_t first = 0;
  std::size_t count = 0;

  std::size_t size() const noexcept { return count; }
  std::size_t operator[](std::size_t i) const noexcept { return first + i; }
};

/// Rows in any order, also repeated.
using ParticleList = std::span<const std::size_t>;

using ParticleRows = std::variant<ParticleRange, ParticleList>;

/// How copies of particles are moved while they are packed, as they go across periodic faces. By default they are not, and all
/// values are copied bit by bit. x is moved, x_mol never, as the programs do.
struct PeriodicShift
{
  /// How many boxes: along x, y and z, and what tilts add of yz, xz and xy; those of Domain and Comm of LAMMPS (pbc).
  std::array<int, 6> counts = {};
  Vector3 lengths = {}; ///< of the box
  double yz = 0;
  double xz = 0;
  double xy = 0;
  bool triclinic = false; ///< tilts count; borders are in units of the box: x is moved by counts

  /// A box that changes: how fast its lengths and tilts do, in the order of counts, and the bits of the groups whose
  /// velocities are moved by that; 0: of no particle. v_mol is not.
  std::array<double, 6> rates = {};
  std::int32_t moving_groups = 0;

  bool is_none() const noexcept { return counts == std::array<int, 6>{}; }
};

/// Packs particles into a buffer of exactly as many doubles as they need: ids as id_to_number has them, types and masks as
/// values. Throws LimitError if there is no such particle, or if the buffer is of another size; then nothing is packed.
void pack(const BondedParticles& particles, PackRoutine routine, PackDialect dialect,
  const ParticleRows& rows, const PeriodicShift& shift, std::span<double> buffer);

/// Unpacks a buffer of exactly so many particles into rows from `first` on, which is at most size(); where they end behind the
/// last one the object grows, once. What is not sent stays as it is, and is as add() makes it in new particles.
/// Throws LimitError if there is no such row, and as BondedParticles::reserve does; FormatError that names the particle, from 0,
/// and the double of the buffer; then the object is as it was, but may have more room.
void unpack(BondedParticles& particles, PackRoutine routine, PackDialect dialect,
  ParticleRange rows, std::span<const double> buffer);

/// Adds forces that came back to those of the particles whose copies they are of. Throws as unpack and pack do.
void unpack_reverse(BondedParticles& particles, ParticleList rows, std::span<const double> buffer);

/// How many doubles pack_exchange makes: 22 + 2 b + n_h b of each particle, or 16 + 2 b + n_h b of WithBonds.
/// Throws LimitError if there is no such particle.
std::size_t exchange_doubles(
  const BondedParticles& particles, PackDialect dialect, const ParticleRows& rows);

/// Packs all there is of particles, but f, for a process that will have them: length, fields, bonds, history, and that there
/// are no lists of special neighbours. Throws LimitError if there is no such particle, if the buffer is of another size, or if an
/// image count is not from -2^20 to 2^20 - 1.
void pack_exchange(const BondedParticles& particles, PackDialect dialect, const ParticleRows& rows,
  std::span<double> buffer);

/// Adds the particles of a buffer, and says how many. Their B may be another, their n_h must be the same: it is not sent.
/// Throws FormatError that names the particle, from 0, and the double of the buffer, where a length, a number of bonds, a whole number or
/// an image is none; UnsupportedError of lists of special neighbours; then the object is as it was.
std::size_t unpack_exchange(
  BondedParticles& particles, PackDialect dialect, std::span<const double> buffer);
}
#endif
