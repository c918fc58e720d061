// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_radii_h
#define granular_packing_radii_h

#include <cstdint>

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

private:
  std::int64_t dealt(std::int64_t grain) const noexcept;

  RadiusChoice choice_;
  std::int64_t grains_;
  std::int64_t seconds_; ///< of Two, how many have `second`
  std::uint64_t seed_;
  int half_bits_; ///< half of those that the number of a grain needs
};
}
#endif
