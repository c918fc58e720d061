// SPDX-License-Identifier: BSD-3-Clause
// The functions of granular_bonds.h that pack and unpack, for objects that are there.
#ifndef granular_bonds_packing_h
#define granular_bonds_packing_h

#include "fields.h"

namespace granular
{
// messages of a fixed number of doubles for each particle, by a kind of granular_bonds.h

std::size_t packed_doubles(const BondedParticles& particles, int kind, const BondRows& rows);
void pack(const BondedParticles& particles, int kind, const BondRows& rows,
  const granular_bonds_shift* shift, double* buffer);

/// Returns the number of particles.
std::size_t unpack(BondedParticles& particles, int kind, std::size_t first,
  const std::int32_t* list, std::span<const double> buffer);

// records of particles that change their rank

std::size_t exchange_doubles(
  const BondedParticles& particles, const BondMessage& message, const BondRows& rows);
void pack_exchange(const BondedParticles& particles, const BondMessage& message,
  const BondRows& rows, double* buffer);
std::size_t unpack_exchange(
  BondedParticles& particles, const BondMessage& message, std::span<const double> buffer);

// records of restart files

std::size_t record_doubles(const BondedParticles& particles, std::size_t row);
void pack_record(const BondedParticles& particles, std::size_t row, const granular_bonds_form& form,
  std::span<const double> fixes, double* record);

/// Returns the doubles of the record.
std::size_t unpack_record(BondedParticles& particles, const granular_bonds_form& form,
  std::size_t fix_count, std::span<const double> chunk);
}
#endif
