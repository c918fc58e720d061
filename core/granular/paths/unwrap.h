// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_unwrap_h
#define granular_paths_unwrap_h

#include "granular/geometry/box.h"
#include "granular/lines/minimum_image.h"
#include "granular/paths/path_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
/// A box and its periodic images.
struct BoxImages
{
  explicit BoxImages(const Box& of);

  /// Returns true if a vector is longer than a quarter of the box along a periodic box vector.
  bool is_far(const Vector3& vector) const noexcept;

  Box box;
  MinimumImage images;
  std::array<Vector3, 3> duals; ///< of the periodic vectors; zero along other axes
};

/// The way from the box of one frame to that of another, for particles whose image counts are not known.
///
/// A periodic box that changes its size or tilt carries its particles along, as fix deform and barostats do: between two
/// frames a particle moves from where it was carried to. Before, a box that was flipped (LAMMPS flips one whose tilt
/// exceeds half a period) is replaced by the one of the same lattice that resembles the new one most.
class BoxChange
{
public:
  /// Makes the way between two equal boxes.
  BoxChange() = default;

  BoxChange(const Box& from, const Box& to);

  /// Returns where the box carries a point.
  Vector3 carry(const Vector3& point) const noexcept;

  /// Returns the same sum of box vectors in the vectors of the new box.
  BoxCounts convert(const BoxCounts& counts) const noexcept;

  /// Returns how much a sum of vectors of the new box grows.
  Vector3 growth_of(const BoxCounts& counts) const noexcept;

private:
  struct Axis
  {
    Vector3 dual = {};   ///< its product with an offset counts the vector in it
    Vector3 growth = {}; ///< of the vector; zero along axes that are not periodic
  };

  bool equal_ = true;
  Vector3 origin_ = {};
  Vector3 shift_ = {}; ///< of the corner, along periodic axes
  std::array<Axis, 3> axes_;
  std::int64_t flip_xy_ = 0; ///< a in b, a in c, b in c, that were taken away
  std::int64_t flip_xz_ = 0;
  std::int64_t flip_yz_ = 0;
};

/// Last known place of a particle.
struct PathState
{
  Vector3 point = {};    ///< as its frame had it
  BoxCounts counts = {}; ///< box vectors that were added to it
  bool based = false;    ///< a frame had image counts
  BoxCounts base = {}; ///< less these: those of the first place; box vectors that are added to none
  Vector3 drift = {};  ///< how much the box vectors of the base have grown since then
  std::int64_t frame = -1; ///< -1: it was in none
};

/// Follows particles through the images of the box, frame by frame.
class Unwrapper
{
public:
  /// Starts the next frame.
  void add_box(const Box& box);

  /// Returns the number of frames so far.
  std::int64_t frames() const noexcept
  {
    return static_cast<std::int64_t>(kinds_of_frames_.size());
  }

  /// The step of a particle to the frame that was added last.
  struct Step
  {
    BoxCounts
      counts = {}; ///< box vectors that bring it, as the frame has it, next to its place before
    bool is_long = false; ///< found without image counts, and longer than a quarter of a period
  };

  /// Advances a particle to the frame that was added last, in which it is the i-th: its unwrapped place is the point plus
  /// the counts of box vectors plus the drift.
  Step advance(PathState& state, const PathFrame& frame, std::size_t i) const;

private:
  /// A box that differs from that of the frame before.
  struct Kind
  {
    BoxImages images;
    BoxChange change; ///< from the kind before
  };

  void carry(PathState& state) const;
  Step find_step(const Vector3& from, const Vector3& to) const;

  std::vector<std::size_t> kinds_of_frames_;
  std::vector<Kind> kinds_;
};
}
#endif
