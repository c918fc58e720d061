// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_rounding_loss_h
#define granular_particles_rounding_loss_h

#include "granular/common/error.h"
#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace granular
{
/// The effect of rounding on the points and values of a frame, in reading or writing. Losses of threads and ranks add up to
/// the same in any order.
struct RoundingLoss
{
  static constexpr double of_value = 1e-3; ///< largest relative change of a value without a notice

  Vector3 moved = {};       ///< largest movement of a point along each axis
  double changed = 0;       ///< largest change of a value, as a part of itself
  std::size_t column = 0;   ///< of that value
  double radius = HUGE_VAL; ///< the smallest; HUGE_VAL without radii

  /// Adds the movement of a point along an axis. nan is no distance.
  void move(std::size_t axis, double distance) noexcept
  {
    moved[axis] = distance > moved[axis] ? distance : moved[axis];
  }

  /// Adds the change of a value in a column. 0 and non-finite values cannot change.
  void change(std::size_t of_column, double value, double rounded) noexcept;

  /// Adds the radius of a particle; radii that are not above 0 are ignored.
  void add_radius(double other) noexcept { radius = other > 0 && other < radius ? other : radius; }

  void add(const RoundingLoss& other) noexcept;

  /// Returns the losses above the limits: "moves particles by up to 0.25 along x, where the smallest radius is 0.001, and
  /// changes 'radius' by up to 19 % of itself". Empty if there are none. points: the moved things; names: of the columns.
  std::string text(const Box& box, const char* points, std::span<const std::string> names) const;
};

/// Returns the distance by which rounding may move a point along each axis without a notice: 1 % of the smallest radius.
/// Without radii (HUGE_VAL), 1e-4 of the length of the box; without such a length, any distance.
Vector3 largest_movement(const Box& box, double smallest_radius) noexcept;

/// Returns the smallest radius of the rows of a frame; HUGE_VAL without radii.
double smallest_radius(const FrameView& frame);

/// Adds the losses of all ranks, on all. Collective.
RoundingLoss add_ranks(RoundingLoss own, Communicator& ranks);

/// Adds a notice if a text of losses is not empty: the cause, the losses and the remedy. Returns true if it does.
bool note_loss(const std::string& losses, const std::string& cause, const std::string& remedy,
  const Where& where, const std::string& topic, Notices& notices);
}
#endif
