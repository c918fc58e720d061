// SPDX-License-Identifier: BSD-3-Clause
// Particles that go once around all ranks.
#ifndef granular_tests_bonds_ring_checks_h
#define granular_tests_bonds_ring_checks_h

#include "granular/bonds/exchange_packing.h"
#include "granular/parallel/communicator.h"

#include "made_particles.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ring_checks
{
/// Hands doubles to the next rank and takes those of the one before.
inline std::vector<double> pass_on(granular::Communicator& ranks, const std::vector<double>& buffer)
{
  const int size = ranks.size();
  const int next = (ranks.rank() + 1) % size;
  const int before = (ranks.rank() + size - 1) % size;
  std::vector<std::int64_t> bytes(static_cast<std::size_t>(size));
  std::vector<std::int64_t> one(bytes.size(), 8);
  bytes[static_cast<std::size_t>(next)] = static_cast<std::int64_t>(buffer.size() * sizeof(double));
  std::vector<std::int64_t> coming(bytes.size());
  ranks.exchange(
    reinterpret_cast<const char*>(bytes.data()), one, reinterpret_cast<char*>(coming.data()), one);
  std::vector<double> came(
    static_cast<std::size_t>(coming[static_cast<std::size_t>(before)]) / sizeof(double));
  ranks.exchange(reinterpret_cast<const char*>(buffer.data()), bytes,
    reinterpret_cast<char*>(came.data()), coming);
  return came;
}

/// On each rank its particles are the same, bit by bit, when they come home; and on the way they were those of others.
inline void check_ring(granular::Communicator& ranks)
{
  for (const granular::PackDialect dialect :
    { granular::PackDialect::Pfm, granular::PackDialect::WithBonds })
  {
    const auto count = static_cast<std::size_t>(ranks.rank() == 1 ? 0 : 100 + 7 * ranks.rank());
    granular::BondedParticles particles =
      made_particles::make(count, 4, 13, static_cast<std::uint64_t>(100 + ranks.rank()));
    for (std::size_t i = 0; i < count && dialect == granular::PackDialect::WithBonds; ++i)
    {
      particles.x_mol()[i] = particles.v_mol()[i] = {};
    }
    std::vector<made_particles::Bits> home;
    for (std::size_t i = 0; i < count; ++i)
    {
      home.push_back(made_particles::bits_of(particles, i));
    }
    for (int step = 0; step < ranks.size(); ++step)
    {
      const granular::ParticleRange all{ 0, particles.size() };
      std::vector<double> buffer(granular::exchange_doubles(particles, dialect, all));
      granular::pack_exchange(particles, dialect, all, buffer);
      particles.clear();
      granular::unpack_exchange(particles, dialect, pass_on(ranks, buffer));
      const int from = (ranks.rank() + ranks.size() - step - 1) % ranks.size();
      ASSERT_EQ(particles.size(), static_cast<std::size_t>(from == 1 ? 0 : 100 + 7 * from));
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      ASSERT_EQ(made_particles::bits_of(particles, i), home[i]) << i;
    }
  }
}
}

#endif
