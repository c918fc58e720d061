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
/// Straight rows of grains along the first box vector, each a radius inside the low face in the beginning:
/// one in the middle of the box, or a bundle in closest packing, whose fibres are nowhere nearer to
/// each other than the distance of grains. Grains are in the order of fibres, each from low to high.
class Fibres
{
public:
  enum class Kind : std::uint8_t
  {
    One,
    Bundle
  };

  /// distance: of neighbours along a fibre, and of fibres. grains_a_fibre: 0 for as many as the box holds.
  /// Throws LimitError where they do not fit.
  Fibres(
    Kind kind, const BoxShape& box, double distance, double radius, std::int64_t grains_a_fibre);

  /// How many grains there are.
  std::int64_t capacity() const noexcept;

  /// The place of a grain in units of the box vectors.
  Vector3 scaled(std::int64_t row) const noexcept;

  /// From 0 on.
  std::int64_t fibre(std::int64_t row) const noexcept { return row / grains_a_fibre_; }

  /// Whether a row is not the first one of its fibre.
  bool is_inside(std::int64_t row) const noexcept { return row % grains_a_fibre_ != 0; }

  /// The lengths of a box that has room for a number of fibres, its cross-section as much like a square as
  /// whole cells allow. Across periodic axes images are as far away as grains are from each other.
  static Vector3 lengths_for(Kind kind, const std::array<bool, 3>& periodic, double distance,
    double radius, std::int64_t grains_a_fibre, std::int64_t fibres);

private:
  std::optional<Lattice> across_; ///< of a bundle: a grain a fibre
  std::int64_t grains_a_fibre_;
  double first_; ///< scaled coordinate along the fibre
  double step_;
};
}
#endif
