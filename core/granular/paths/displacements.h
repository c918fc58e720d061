// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_displacements_h
#define granular_paths_displacements_h

#include "granular/geometry/box.h"
#include "granular/local/minimum_image.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <optional>

namespace granular
{
/// A point, and how often it has crossed the box along each of its vectors.
struct CountedPoint
{
  Vector3 point = {};
  Vector3 images = {};
};

/// Finds displacements of particles from a reference frame to the current frame.
class Displacements
{
public:
  /// The boxes, and the origins that were subtracted from points that are not scaled, are those of the frames. unwrapped:
  /// points and their images give the unwrapped positions; otherwise displacements are the shortest periodic images. See
  /// compare_particles.
  Displacements(const FrameView& current, const FrameView& reference, bool unwrapped);

  /// Returns the displacement, rounded once.
  Vector3 find(const CountedPoint& current, const CountedPoint& reference) const noexcept;

  /// Returns true if a shortest image is longer than a quarter of the box along a periodic box vector: the particle may have
  /// moved by another image.
  bool is_far(const Vector3& displacement) const noexcept;

private:
  Vector3 subtract(const CountedPoint& current, const CountedPoint& reference) const noexcept;

  std::array<Vector3, 2> origins_ = {}; ///< added to the current points, and to those before
  std::array<std::array<Twofold3, 3>, 2> vectors_ = {}; ///< of the boxes
  std::optional<MinimumImage>
    images_; ///< in which box the shortest is taken; of unwrapped points none
  std::array<Vector3, 3> duals_ = {}; ///< of the periodic box vectors
};
}
#endif
