// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_rounding_loss_h
#define granular_particles_rounding_loss_h

#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace granular
{
/// The distance by which rounding may move a point along each axis without a notice: 1 % of the smallest radius. Without
/// radii, 1e-4 of the length of the box; without such a length, any distance.
struct RoundingLimit
{
  static constexpr double of_radius = 0.01;
  static constexpr double of_box = 1e-4;
  static constexpr double of_value = 1e-3; ///< largest relative change of a value

  /// smallest_radius: HUGE_VAL without radii.
  RoundingLimit(const Box& box, double smallest_radius) noexcept;

  double radius;
  Vector3 lengths; ///< of the box, along the axes
  Vector3 distance;
};

/// The effect of rounding on the points and values of a frame, in reading or writing. Losses of threads and ranks add up to
/// the same in any order.
class RoundingLoss
{
public:
  /// Adds the movement of a point along an axis. nan is no distance.
  void move(std::size_t axis, double distance) noexcept
  {
    moved_[axis] = distance > moved_[axis] ? distance : moved_[axis];
  }

  /// Adds the change of a value in a column. 0 and non-finite values cannot change.
  void change(std::size_t column, double value, double rounded) noexcept;

  /// Adds the radius of a particle; radii that are not above 0 are ignored.
  void add_radius(double radius) noexcept
  {
    radius_ = radius > 0 && radius < radius_ ? radius : radius_;
  }

  void add(const RoundingLoss& other) noexcept;

  /// Returns the smallest radius, or HUGE_VAL.
  double radius() const noexcept { return radius_; }

  /// Returns the losses above the limit: "move particles by up to 0.25 along x, where the smallest radius is 0.001, and
  /// change 'radius' by up to 19 %". Empty if there are none. points: the moved things; names: of the columns.
  std::string text(
    const RoundingLimit& limit, const char* points, std::span<const std::string> names) const;

private:
  Vector3 moved_ = {};
  double changed_ = 0; ///< part of itself
  std::size_t column_ = 0;
  double radius_ = HUGE_VAL;
};

/// Adds the losses of all ranks, on all. Collective.
RoundingLoss add_ranks(RoundingLoss own, Communicator& ranks);

/// Returns how far rounding to doubles can move a point of the box, minus an origin, along each axis.
Vector3 rounding_of_points(const Box& box, const Vector3& origin) noexcept;

/// Returns the distance between the corners of two boxes, along each axis.
Vector3 distance_of_corners(const Box& one, const Box& other) noexcept;
}
#endif
