// SPDX-License-Identifier: BSD-3-Clause
// Particles with bonds made for tests, and all their bits as plain lists.
#ifndef granular_tests_bonds_made_particles_h
#define granular_tests_bonds_made_particles_h

#include "granular/bonds/bonded_particles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace made_particles
{
using granular::BondedParticles;
using granular::Vector3;
using Limits32 = std::numeric_limits<std::int32_t>;
using Limits64 = std::numeric_limits<std::int64_t>;

constexpr std::int32_t image_low = -(1 << 20);
constexpr std::int32_t image_high = (1 << 20) - 1;

/// What has to go through unharmed: both zeros, the smallest and largest numbers, infinities, a quiet and two signalling nans.
inline const std::vector<double> hard_numbers = { 0, -0.0, 1, -1, 0.1,
  std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::min() / 4,
  std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity(),
  -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(),
  std::bit_cast<double>(std::uint64_t{ 0x7ff0000000000001 }),
  std::bit_cast<double>(std::uint64_t{ 0xfff0dead0000beef }) };

inline const std::vector<std::int64_t> hard_ids = { 0, 1, -1, 7, -7, std::int64_t{ 1 } << 31,
  -(std::int64_t{ 1 } << 31) - 1, 5'000'000'000, (std::int64_t{ 1 } << 52) + 1,
  std::int64_t{ 1 } << 53, (std::int64_t{ 1 } << 53) + 1, -(std::int64_t{ 1 } << 53) - 1,
  4607182418800017408, -4616189618054758400, Limits64::max(), Limits64::min(),
  Limits64::min() + 1 };

/// All bits of a particle but the force.
struct Bits
{
  std::vector<std::uint64_t> reals; ///< x v x_mol v_mol history
  std::vector<std::int64_t> integers;

  bool operator==(const Bits&) const = default;
};

inline void append_bits(const Vector3& vector, Bits& bits)
{
  for (const double value : vector)
  {
    bits.reals.push_back(std::bit_cast<std::uint64_t>(value));
  }
}

inline Bits bits_of(const BondedParticles& particles, std::size_t i)
{
  Bits bits;
  append_bits(particles.x()[i], bits);
  append_bits(particles.v()[i], bits);
  append_bits(particles.x_mol()[i], bits);
  append_bits(particles.v_mol()[i], bits);
  for (const double value : particles.history(i))
  {
    bits.reals.push_back(std::bit_cast<std::uint64_t>(value));
  }
  bits.integers = { particles.tag()[i], particles.type()[i], particles.mask()[i],
    particles.image()[i].x, particles.image()[i].y, particles.image()[i].z, particles.molecule()[i],
    particles.bonds()[i] };
  for (std::size_t k = 0; k < particles.partners(i).size(); ++k)
  {
    bits.integers.push_back(particles.bond_types(i)[k]);
    bits.integers.push_back(particles.partners(i)[k]);
  }
  return bits;
}

inline std::vector<Bits> bits_of(const BondedParticles& particles)
{
  std::vector<Bits> all;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    all.push_back(bits_of(particles, i));
    append_bits(particles.f()[i], all.back());
  }
  return all;
}

/// Hard ones and ones of chance, in turns.
class Maker
{
public:
  explicit Maker(std::uint64_t seed)
    : random_(seed)
  {
  }

  double number()
  {
    return random_() % 2 ? hard_numbers[random_() % hard_numbers.size()]
                         : static_cast<double>(random_() % 1000) / 8 - 50;
  }

  Vector3 vector() { return { this->number(), this->number(), this->number() }; }

  std::int64_t id()
  {
    const std::uint64_t kind = random_() % 3;
    return kind == 0 ? hard_ids[random_() % hard_ids.size()]
      : kind == 1    ? static_cast<std::int64_t>(random_() % 100000)
                     : std::bit_cast<std::int64_t>(random_());
  }

  std::int32_t integer()
  {
    const std::array<std::int32_t, 6> hard = { 0, 1, -1, 3, Limits32::max(), Limits32::min() };
    return random_() % 2 ? hard[random_() % hard.size()]
                         : static_cast<std::int32_t>(random_() % 1000) - 500;
  }

  std::int32_t image()
  {
    const std::array<std::int32_t, 4> hard = { 0, -1, image_low, image_high };
    return random_() % 2 ? hard[random_() % hard.size()]
                         : static_cast<std::int32_t>(random_() % 2000) - 1000;
  }

  /// A particle with so many bonds; the first two are with itself, the others all the same one.
  void add(BondedParticles& particles, std::size_t bonds)
  {
    const std::size_t i = particles.add(this->integer(), this->vector());
    particles.v()[i] = this->vector();
    particles.f()[i] = this->vector();
    particles.x_mol()[i] = this->vector();
    particles.v_mol()[i] = this->vector();
    particles.tag()[i] = this->id();
    particles.mask()[i] = this->integer();
    particles.image()[i] = { this->image(), this->image(), this->image() };
    particles.molecule()[i] = this->id();
    std::vector<double> history(static_cast<std::size_t>(particles.history_values()));
    const std::int64_t other = this->id();
    const std::int32_t type = this->integer();
    for (std::size_t k = 0; k < bonds; ++k)
    {
      std::generate(history.begin(), history.end(), [this] { return this->number(); });
      particles.add_bond(i, k < 2 ? -5 : type, k < 2 ? particles.tag()[i] : other, history);
    }
  }

  std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_() % end); }

private:
  std::mt19937_64 random_;
};

inline BondedParticles make(
  std::size_t count, std::int32_t most_bonds, std::int32_t history_values, std::uint64_t seed)
{
  BondedParticles particles(most_bonds, history_values);
  Maker maker(seed);
  const auto most = static_cast<std::size_t>(most_bonds);
  for (std::size_t i = 0; i < count; ++i)
  {
    maker.add(particles, i % 3 == 0 ? most : maker.below(most + 1));
  }
  return particles;
}
}

#endif
