// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_restart_record_h
#define granular_bonds_restart_record_h

#include "granular/bonds/bonded_particles.h"

#include <cstddef>
#include <span>
#include <vector>

namespace granular
{
/// The format of a particle's record in a restart file; see RecordSlots.
struct RecordForm
{
  WholeNumbers numbers = WholeNumbers::Values; ///< tag, type and mask
  WholeNumbers image =
    WholeNumbers::Values; ///< WITH-BONDS, Flexible_Fibers: as values; PFM: as bits
  int image_bits = 10;    ///< of a count: 10 where ids have 4 bytes, 21 where they have 8
};

/// Returns the doubles of a record, without those of fixes: 13 + 2 b, and 1 + n_h b if n_h > 0. Throws LimitError if the
/// particle does not exist.
std::size_t record_doubles(const BondedParticles& particles, std::size_t i);

/// Appends the record of a particle: its length, x, tag, type, mask, image, v, molecule, b, type and partner of each bond,
/// then n_h and the history if n_h > 0, and the data of fixes. The sign of a bond's type is kept, although the programs lose
/// it.
///
/// Throws LimitError, and appends nothing, if the particle does not exist; if its type is below 1, which tells a reader the
/// form of the numbers; if an image count does not fit; or if a number written as a value is not exact: molecule and partners
/// are always values, ids up to 2^53, and images if a double can hold them.
void append_record(const BondedParticles& particles, std::size_t i, const RecordForm& form,
  std::span<const double> fixes, std::vector<double>& records);

/// A record that was read.
struct RecordRead
{
  std::size_t size = 0;          ///< doubles in total
  std::span<const double> fixes; ///< data of fixes
};

/// Adds the particle of the record at a position in a chunk of records; x_mol, v_mol and f are zero. The record gives the
/// form of tag, type and mask; form.numbers is not used. fix_doubles is the number of doubles of fixes. The record does not
/// hold it, and without it they cannot be told from n_h and the history, which may be missing (see look_at_bonds). With it, a
/// record with another n_h than the object's is refused, but one without bonds may have n_h or not. Throws FormatError that
/// names the particle, by its place in the object, and the double of the chunk where its record begins, for a wrong length or
/// number, a record that ends behind the chunk, and the errors of look_at_bonds; then the object is unchanged.
RecordRead read_record(std::span<const double> chunk, std::size_t place, const RecordForm& form,
  std::size_t fix_doubles, BondedParticles& particles);
}
#endif
