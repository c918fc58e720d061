// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_fibres_h
#define granular_packing_fibres_h

#include "granular/packing/box_shape.h"
#include "granular/packing/lattice.h"

#include <array>
#include <cstdint>
#include <optional>

namespace granular
{
/// Straight rows of particles along the first box vector, which begin one radius inside the low face: one in the middle of
/// the box, or a bundle in closest packing, whose fibres are nowhere nearer to each other than neighbouring particles. Where
/// rounding could bring neighbours nearer than the distance, they are farther apart by as much, if the box has room.
/// Particles are in the order of fibres, each from low to high.
class Fibres
{
public:
  enum class Kind : std::uint8_t
  {
    One,
    Bundle
  };

  /// distance: of neighbours along a fibre, and of fibres. grains_a_fibre: 0 for as many as the box holds. Throws LimitError
  /// if they do not fit.
  Fibres(
    Kind kind, const BoxShape& box, double distance, double radius, std::int64_t grains_a_fibre);

  /// Returns the number of particles.
  std::int64_t capacity() const noexcept;

  /// Returns the position of a particle in the box of the constructor.
  Vector3 point(std::int64_t row, const BoxShape& box) const noexcept;

  /// Returns a distance that no two particles and images are nearer than, in exact arithmetic.
  double nearest() const noexcept { return nearest_; }

  /// From 0 on.
  std::int64_t fibre(std::int64_t row) const noexcept { return row / grains_a_fibre_; }

  /// Returns true if a row is not the first one of its fibre.
  bool is_inside(std::int64_t row) const noexcept { return row % grains_a_fibre_ != 0; }

  /// Returns the lengths of a box for a number of fibres, with a cross-section as square as whole cells allow. Across
  /// periodic axes images are as far away as particles are from each other.
  static Vector3 lengths_for(Kind kind, const std::array<bool, 3>& periodic, double distance,
    double radius, std::int64_t grains_a_fibre, std::int64_t fibres);

private:
  Vector3 scaled(std::int64_t row) const noexcept;
  void settle(const BoxShape& box, double distance, double radius);

  std::optional<Lattice> across_; ///< of a bundle: a grain a fibre
  std::int64_t grains_a_fibre_;
  double first_; ///< scaled coordinate along the fibre
  double step_;
  double nearest_;
  double exact_first_ =
    0; ///< coordinate along the fibre, where it and those a distance apart are doubles
  double exact_step_ = 0; ///< 0: they are not
};
}
#endif
