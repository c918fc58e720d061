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
/// How far rounding may move a point along each axis before a user is told: 1 % of the smallest radius. Without radii,
/// 1e-4 of the length of the box; without such a length, as far as it likes.
struct RoundingLimit
{
  static constexpr double of_radius = 0.01;
  static constexpr double of_box = 1e-4;
  static constexpr double of_value = 1e-3; ///< how much of itself a value may change

  /// smallest_radius: HUGE_VAL without radii.
  RoundingLimit(const Box& box, double smallest_radius) noexcept;

  double radius;
  Vector3 lengths; ///< of the box, along the axes
  Vector3 distance;
};

/// What rounding does to the points and values of a frame, whoever rounds, in reading or writing. Losses of threads and
/// ranks add up to the same in any order.
class RoundingLoss
{
public:
  /// A point has moved so far along an axis. No number is no distance.
  void move(std::size_t axis, double distance) noexcept
  {
    moved_[axis] = distance > moved_[axis] ? distance : moved_[axis];
  }

  /// A value of a column has become another. 0 and what is not finite cannot change.
  void change(std::size_t column, double value, double rounded) noexcept;

  /// Of a particle. What is not above 0 is none.
  void add_radius(double radius) noexcept
  {
    radius_ = radius > 0 && radius < radius_ ? radius : radius_;
  }

  void add(const RoundingLoss& other) noexcept;

  /// The smallest radius, or HUGE_VAL.
  double radius() const noexcept { return radius_; }

  /// What is more than the limit: "move particles by up to 0.25 along x, where the smallest radius is 0.001, and
  /// change 'radius' by up to 19 %". Empty if nothing is. points: what moves; names: of the columns.
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

/// How far rounding to doubles can move a point of the box, less an origin, along each axis.
Vector3 rounding_of_points(const Box& box, const Vector3& origin) noexcept;

/// How far the corners of a box are from those of another, along each axis.
Vector3 distance_of_corners(const Box& one, const Box& other) noexcept;
}
#endif
