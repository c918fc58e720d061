// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_split_line_h
#define granular_local_split_line_h

#include "granular/geometry/box.h"
#include "granular/local/minimum_image.h"

#include <array>
#include <cstddef>

namespace granular
{
/// A part of a line, between two faces of the box or its ends.
struct LinePart
{
  Vector3 begin;
  Vector3 end;
};

/// Splits lines where they leave the box.
class LineSplitter
{
public:
  static constexpr std::size_t most_parts = 4;

  /// images: those of the box; must outlive this.
  LineSplitter(const Box& box, const MinimumImage& images, const Vector3& point_origin);

  /// The line from first to the image of second that is that many box vectors away: along each axis with a count it goes
  /// through one face, the upper one if the count is positive, and goes on from the opposite one, or as many vectors back as
  /// the count says. Where that place is outside of the line, as ends are outside of the box, it is the nearer end.
  /// Returns how many parts there are, at least 1. Parts shorter than rounding are left out, as long as there is another.
  /// The first begins at first and the last ends at second, or at an image of it where it was left out.
  std::size_t split(const Vector3& first, const Vector3& second, const BoxCounts& counts,
    std::array<LinePart, most_parts>& parts) const noexcept;

private:
  struct Crossing
  {
    double place = 0;    ///< of the line, in [0, 1]
    double rounding = 0; ///< of the place
    std::size_t axis = 0;
  };

  Crossing find_crossing(std::size_t axis, bool upper, const Vector3& first, const Vector3& second,
    const Vector3& whole) const noexcept;

  const Box& box_;
  const MinimumImage& images_;
  Vector3 point_origin_;
  std::array<Vector3, 3> normals_ = {}; ///< of the faces that box vectors end at
};
}
#endif
