// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_lines_minimum_image_h
#define granular_lines_minimum_image_h

#include "granular/geometry/box.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
/// Returns true if a box vector is finite and not zero.
bool has_length(const Twofold3& vector) noexcept;

/// Returns for some of three vectors the part that is perpendicular to the others of them: its product with any vector counts
/// how many times the vector is in it. Zero if there is no such part, to twelve digits, and for vectors that are not chosen.
std::array<Vector3, 3> own_parts(
  const std::array<Vector3, 3>& vectors, const std::array<bool, 3>& chosen) noexcept;

/// Returns the duals of the periodic vectors of a box, given by its flags and any vectors of its lattice: their product with any
/// vector is the number of times that the periodic vector is in it. Zero along axes that are not periodic, or whose vector has
/// no length or no part of its own.
std::array<Vector3, 3> periodic_duals(
  const Box& box, const std::array<Vector3, 3>& vectors) noexcept;

/// The count of each box vector.
using BoxCounts = std::array<std::int64_t, 3>;

template <class Number>
std::array<Number, 3> minus(const std::array<Number, 3>& a, const std::array<Number, 3>& b) noexcept
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/// Finds the shortest periodic image of a vector, in any box, however tilted.
class MinimumImage
{
public:
  /// An axis is periodic if the boundary flags of the box say so and its vector has a length. A tilted box has no images if
  /// its periodic vectors are in one plane or line, to twelve digits, without a common measure there.
  explicit MinimumImage(const Box& box);

  /// Returns true if any axis is periodic.
  bool is_periodic() const noexcept { return periodic_; }

  /// Returns the box vectors to add to a vector to get its shortest image; 0 along axes that are not periodic, for a vector
  /// that is not finite, and for one so long that no bit gives its image: 2^50 vectors. Among images of the same length,
  /// within rounding, the one with the smallest counts is taken.
  BoxCounts find(const Vector3& vector) const noexcept
  {
    return !straight_          ? this->find_tilted(vector)
      : this->is_short(vector) ? BoxCounts{}
                               : this->find_straight(vector);
  }

  /// Returns a number of box vectors, rounded once.
  Vector3 shift(const BoxCounts& counts) const noexcept { return this->moved({}, counts, {}); }

  /// Returns a point plus a number of box vectors minus another point, rounded once.
  Vector3 moved(const Vector3& point, const BoxCounts& counts, const Vector3& less) const noexcept
  {
    if (counts == BoxCounts{})
    {
      // 0 has no sign, as that of a sum
      return { point[0] - less[0] + 0., point[1] - less[1] + 0., point[2] - less[2] + 0. };
    }
    return this->moved_far(point, counts, less);
  }

private:
  /// A sum of box vectors.
  struct Sum
  {
    Vector3 counts = {};
    Vector3 vector = {};
    double square = 0; ///< of its length
  };

  /// Returns true for a finite vector of at most half a box along each axis.
  bool is_short(const Vector3& vector) const noexcept
  {
    return std::abs(vector[0] * per_length_[0]) <= 0.5 &&
      std::abs(vector[1] * per_length_[1]) <= 0.5 && std::abs(vector[2] * per_length_[2]) <= 0.5;
  }

  Vector3 moved_far(
    const Vector3& point, const BoxCounts& counts, const Vector3& less) const noexcept;
  BoxCounts find_straight(const Vector3& vector) const noexcept;
  BoxCounts find_tilted(const Vector3& vector) const noexcept;

  Sum make_sum(const Vector3& counts) const noexcept;
  bool shorten(std::size_t which, double j_times, double k_times) noexcept;
  void reduce() noexcept;
  void make_steps();

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
