// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_particle_loader_h
#define granular_averages_particle_loader_h

#include "granular/geometry/reproducible_sum.h"
#include "granular/particles/absolute_positions.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/frame_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace granular
{
/// The names of the averaged arrays; empty: none. Names are those of arrays (`radius`) or of columns of dumps.
struct ParticleArrayNames
{
  std::string velocity = "v";    ///< three components
  std::string radius = "radius"; ///< or a diameter under that name
  std::string mass = "mass";     ///< else density and radius
  std::string
    stress = {}; ///< volume times stress, xx yy zz xy xz yz (compute stress/atom); empty: none
};

/// The values of a frame. Ranks may have different rows, but not different arrays.
struct ParticleSources
{
  std::array<std::optional<ValueSource>, 3> velocity;
  std::optional<ValueSource> radius;
  std::optional<ValueSource> mass;
  std::optional<ValueSource> density;
  std::array<std::optional<ValueSource>, 6> stress;
};

/// Throws Error if an array has a wrong number of components, or texts, and if a named stress array is missing.
ParticleSources find_particle_sources(const FrameView& frame, const ParticleArrayNames& names);

/// Magnitudes of nonzero numbers, as their bits, which are in the order of the numbers.
class Magnitudes
{
public:
  void add(const double* values, std::size_t count) noexcept
  {
    std::uint64_t largest = largest_;
    std::uint64_t less_one = less_one_;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(values[i]) << 1 >> 1;
      largest = std::max(largest, magnitude);
      less_one = std::min(less_one, magnitude - 1); // of 0 it is the largest there is
    }
    largest_ = largest;
    less_one_ = less_one;
  }

  void add(const Magnitudes& other) noexcept
  {
    largest_ = std::max(largest_, other.largest_);
    less_one_ = std::min(less_one_, other.less_one_);
  }

  double largest() const noexcept { return std::bit_cast<double>(largest_); } ///< or nan
  double smallest() const noexcept { return std::bit_cast<double>(less_one_ + 1); }

  /// All such numbers, and their products with factors in (0, 1] that are multiples of 2^quantum.
  SumScale::Range range(int quantum) const noexcept;

private:
  std::uint64_t largest_ = 0;
  std::uint64_t less_one_ = ~std::uint64_t{ 0 };
};

/// Values of some particles.
struct ParticleBlock
{
  static constexpr std::size_t most_rows = 256;

  std::size_t rows = 0;
  const double* positions = nullptr;     ///< x y z of each, absolute
  const double* velocities = nullptr;    ///< three of each; 0 if unknown
  const double* radius = nullptr;        ///< 0 if unknown
  const double* mass = nullptr;          ///< 1 if unknown
  const double* stresses = nullptr;      ///< six of each, or null
  const unsigned char* usable = nullptr; ///< 0: the particle is left out; null: all are usable

  bool uses(std::size_t i) const noexcept { return !usable || usable[i] != 0; }

  /// Returns the largest component of the velocity, or the speed with which a mass would have the stress, if that is larger.
  double speed(std::size_t i, double heaviest) const noexcept
  {
    double stress = 0;
    for (std::size_t k = 6 * i; stresses && k < 6 * i + 6; ++k)
    {
      stress = std::max(stress, std::abs(stresses[k]));
    }
    const double* const v = velocities + 3 * i;
    return std::max({ std::abs(v[0]), std::abs(v[1]), std::abs(v[2]),
      stress > 0 ? std::sqrt(stress) / std::sqrt(heaviest) : 0 });
  }

  // what is not in memory of others as it should be
  std::array<double, 3 * most_rows> positions_buffer;
  std::array<double, 3 * most_rows> velocities_buffer;
  std::array<double, most_rows> radius_buffer;
  std::array<double, most_rows> mass_buffer;
  std::array<double, 6 * most_rows> stresses_buffer;
  std::array<unsigned char, most_rows> usable_buffer;
};

/// Loads particles of a frame.
class ParticleLoader
{
public:
  /// The known magnitudes of the particles' numbers.
  struct Scan
  {
    Magnitudes mass;
    Magnitudes speed; ///< of components
    Magnitudes radius;
    Magnitudes stress;
    std::int64_t broken = 0; ///< particles left out, except duplicates
    std::int64_t moved = 0;  ///< particles whose positions are not those of an array in memory

    void add(const Scan& other) noexcept;
  };

  /// frame and sources must stay.
  ParticleLoader(const FrameView& frame, const ParticleSources& sources);

  bool has_stress() const noexcept { return sources_.stress[0].has_value(); }

  /// Loads rows in increasing order, at most most_rows. Not usable are ghost duplicates, particles with a number that is not
  /// finite or too large to add (2^290), and those with a radius or mass below 0. May be called from any thread.
  void load(std::span<const std::int64_t> rows, ParticleBlock& block) const;

  /// Loads rows and includes the numbers of usable particles in the known magnitudes.
  void scan(std::span<const std::int64_t> rows, ParticleBlock& block, Scan& scan) const;

  /// From now on load need not look at what the scan of all particles has found.
  void trust(const Scan& scan) noexcept;

private:
  void load_values(std::span<const std::int64_t> rows, ParticleBlock& block) const;
  void find_usable(std::span<const std::int64_t> rows, ParticleBlock& block) const;

  const FrameView& frame_;
  const ParticleSources& sources_;
  AbsolutePositions positions_;
  bool all_usable_ = false;
  bool none_moved_ = false;
};
}
#endif
