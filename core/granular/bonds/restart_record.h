// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_restart_record_h
#define granular_bonds_restart_record_h

#include "granular/bonds/bonded_particles.h"

#include <cstddef>
#include <span>
#include <vector>

namespace granular
{
/// How the record of a particle in a restart file is written; see RecordSlots.
struct RecordForm
{
  WholeNumbers numbers = WholeNumbers::Values; ///< tag, type and mask
  WholeNumbers image =
    WholeNumbers::Values; ///< WITH-BONDS, Flexible_Fibers: as values; PFM: as bits
  int image_bits = 10;    ///< of a count: 10 where ids have 4 bytes, 21 where they have 8
};

/// Doubles of a record, without what fixes add: 13 + 2 b, and 1 + n_h b if n_h > 0. Throws LimitError if there is no such particle.
std::size_t record_doubles(const BondedParticles& particles, std::size_t i);

/// Appends the record of a particle: its length, x, tag, type, mask, image, v, molecule, b, type and partner of each bond, then
/// n_h and the history if n_h > 0, and what fixes have of it. The sign of a bond's type is kept, which the programs lose.
///
/// Throws LimitError, and appends nothing, if there is no such particle, if its type is below 1, which tells a reader the form of
/// the numbers, if a count of the image does not fit, or if what is written as a value is none: molecule and partners are
/// values always, ids up to 2^53, and images if a double can hold them.
void append_record(const BondedParticles& particles, std::size_t i, const RecordForm& form,
  std::span<const double> fixes, std::vector<double>& records);

/// A record that was read.
struct RecordRead
{
  std::size_t size = 0;          ///< doubles, all of it
  std::span<const double> fixes; ///< what fixes have of it
};

/// Adds the particle of the record that begins at a place of a chunk of records; x_mol, v_mol and f are zero. Reads the form of
/// tag, type and mask from the record; form.numbers is not used. fix_doubles is how many doubles fixes have: nothing in a record
/// says so, and without it they can not be told from n_h and the history, which may be missing (see look_at_bonds). With it, a
/// record of other n_h than the object's is refused, but one without bonds may have n_h or not.
/// Throws FormatError that names the particle, by its place in the object, and the double of the chunk where its record begins: a length
/// that is none or ends behind the chunk, what look_at_bonds refuses, a number that is none; then the object is as it was.
RecordRead read_record(std::span<const double> chunk, std::size_t place, const RecordForm& form,
  std::size_t fix_doubles, BondedParticles& particles);
}
#endif
