// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_radii_h
#define granular_packing_radii_h

#include <cstdint>
#include <vector>

namespace granular
{
/// The sizes of particles, in the unit of the box.
struct RadiusChoice
{
  enum class Kind : std::uint8_t
  {
    One, ///< all have the radius `first`
    Two  ///< a share of them has `second`, and type 2
  };

  Kind kind = Kind::One;
  double first = 0.5;
  double second = 0.5;
  double share = 0.5; ///< 0 to 1, by number

  double smallest() const noexcept;
  double largest() const noexcept;
  double mean_volume() const noexcept;
};

/// Particles of one size.
struct SizeClass
{
  double radius = 0;
  std::int64_t particles = 0;
  std::int32_t type = 1;
};

/// Throws LimitError for impossible values.
void check(const RadiusChoice& choice);

/// The radii of a number of particles. They are dealt out, not drawn for each: the share is exact to one particle.
class Radii
{
public:
  Radii(const RadiusChoice& choice, std::int64_t particles, std::uint64_t seed) noexcept;

  std::int64_t particles() const noexcept { return particles_; }
  double radius(std::int64_t row) const noexcept;
  std::int32_t type(std::int64_t row) const noexcept;

  /// Returns the sizes that have particles, the largest first.
  std::vector<SizeClass> by_size() const;

private:
  std::int64_t dealt(std::int64_t row) const noexcept;

  RadiusChoice choice_;
  std::int64_t particles_;
  std::int64_t seconds_; ///< the number with `second`
  std::uint64_t seed_;
};
}
#endif
