// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_minimum_image_h
#define granular_local_minimum_image_h

#include "granular/geometry/box.h"

#include <array>
#include <cstdint>
#include <vector>

namespace granular
{
/// How many of each box vector.
using BoxCounts = std::array<std::int64_t, 3>;

/// Finds the shortest of the periodic images of a vector, in any box, however tilted.
class MinimumImage
{
public:
  /// Axes are periodic where the boundary flags of the box say so and its vector has a length. A tilted box whose periodic
  /// vectors are in one plane or line, to twelve digits, and have no common measure there, has no images.
  explicit MinimumImage(const Box& box);

  /// Whether any axis is.
  bool is_periodic() const noexcept { return periodic_; }

  /// The box vectors to be added to a vector to get the shortest of its images; 0 along axes that are not periodic,
  /// and for a vector that is not finite, or so long that no bit tells its image: 2^50 vectors. Of images of the same
  /// length, within rounding, that with the smallest counts.
  BoxCounts find(const Vector3& vector) const noexcept
  {
    return straight_ ? this->find_straight(vector) : this->find_tilted(vector);
  }

  /// That many box vectors, rounded once.
  Vector3 shift(const BoxCounts& counts) const noexcept { return this->moved({}, counts, {}); }

  /// A point and that many box vectors, less another point, rounded once.
  Vector3 moved(const Vector3& point, const BoxCounts& counts, const Vector3& less) const noexcept;

private:
  /// A sum of box vectors.
  struct Sum
  {
    Vector3 counts = {};
    Vector3 vector = {};
    double square = 0; ///< of its length
  };

  BoxCounts find_straight(const Vector3& vector) const noexcept;
  BoxCounts find_tilted(const Vector3& vector) const noexcept;

  Sum make_sum(const Vector3& counts) const noexcept;
  bool shorten(std::size_t which, double j_times, double k_times) noexcept;
  void reduce() noexcept;
  void make_steps();
  bool descend(const Vector3& vector, double slack, Vector3& counts) const noexcept;
  Vector3 smallest_of_ties(
    const Vector3& vector, double slack, const Vector3& counts) const noexcept;

  std::array<Twofold3, 3> vectors_ = {}; ///< of the box; 0 along axes that are not periodic
  bool periodic_ = false;
  bool straight_ = true;    ///< each vector is along its axis
  Vector3 per_length_ = {}; ///< of straight ones; 0 along axes that are not periodic
  std::vector<Sum>
    reduced_; ///< the shortest vectors that all are sums of: a basis reduced in Minkowski's sense
  std::vector<Vector3> duals_; ///< of these
  std::vector<Sum>
    steps_; ///< what may lie between the shortest image and others that are nearly as short
  double surely_shortest_ =
    0; ///< the square of half the shortest of all: what is below has no shorter image
};
}
#endif
