// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_radii_h
#define granular_packing_radii_h

#include <cstdint>
#include <vector>

namespace granular
{
/// How large grains are to be, in the unit of the box.
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

/// Grains that are placed alike: of nearly the same size.
struct SizeClass
{
  double radius = 0; ///< the largest of them
  std::int64_t grains = 0;
  std::int32_t type = 1;
  std::int64_t first = 0; ///< how many grains are in classes before
};

/// Throws LimitError for what cannot be.
void check(const RadiusChoice& choice);

/// The radius of each of a number of grains. Sizes are dealt out, not thrown for each: of Two the share
/// is exact to one grain, of Range each of as many equal parts of the range occurs once.
class Radii
{
public:
  Radii(const RadiusChoice& choice, std::int64_t grains, std::uint64_t seed) noexcept;

  const RadiusChoice& choice() const noexcept { return choice_; }
  double radius(std::int64_t grain) const noexcept;
  std::int32_t type(std::int64_t grain) const noexcept;

  /// All grains by size, the largest first; none are empty. Radii of a class differ by a twentieth at most.
  std::vector<SizeClass> classes() const;

  /// The radius of a grain of a class, where radii are dealt out in each of the classes.
  double radius(const SizeClass& size_class, std::int64_t grain) const noexcept;

private:
  std::int64_t dealt(std::int64_t grain, std::int64_t grains) const noexcept;
  double part(std::int64_t number) const noexcept;
  double by_size(std::int64_t number) const noexcept;

  RadiusChoice choice_;
  std::int64_t grains_;
  std::int64_t seconds_; ///< of Two, how many have `second`
  std::uint64_t seed_;
};
}
#endif
