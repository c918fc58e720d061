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
    One,  ///< all have the radius `first`
    Two,  ///< a share of them has `second`, and type 2
    Range ///< evenly from `first` to `second`
  };

  Kind kind = Kind::One;
  double first = 0.5;
  double second = 0.5;
  double share = 0.5; ///< 0 to 1, by number

  double smallest() const noexcept;
  double largest() const noexcept;
  double mean_volume() const noexcept;
};

/// Particles of nearly the same size, which are placed alike.
struct SizeClass
{
  double radius = 0; ///< the largest of them
  std::int64_t grains = 0;
  std::int32_t type = 1;
  std::int64_t first = 0; ///< number of particles in earlier classes
};

/// Throws LimitError for impossible values.
void check(const RadiusChoice& choice);

/// The radii of a number of particles. Sizes are dealt out, not drawn for each: with Two the share is exact to one particle,
/// with Range each of as many equal parts of the range occurs once.
class Radii
{
public:
  Radii(const RadiusChoice& choice, std::int64_t grains, std::uint64_t seed) noexcept;

  const RadiusChoice& choice() const noexcept { return choice_; }
  double radius(std::int64_t grain) const noexcept;
  std::int32_t type(std::int64_t grain) const noexcept;

  /// Returns all particles by size, the largest first; no class is empty. Radii of a class differ by at most 5 %.
  std::vector<SizeClass> classes() const;

  /// Returns the radius of a particle of a class, where radii are dealt out within the classes.
  double radius(const SizeClass& size_class, std::int64_t grain) const noexcept;

private:
  std::int64_t dealt(std::int64_t grain, std::int64_t grains) const noexcept;
  double part(std::int64_t number) const noexcept;
  double by_size(std::int64_t number) const noexcept;

  RadiusChoice choice_;
  std::int64_t grains_;
  std::int64_t seconds_; ///< with Two, the number with `second`
  std::uint64_t seed_;
};
}
#endif
