// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_lines_lines_h
#define granular_lines_lines_h

#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/lines/minimum_image.h"
#include "granular/particles/request.h"
#include "granular/particles/table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace granular
{
/// A part of a line, between two faces of the box or ends of the line.
struct LinePart
{
  Vector3 begin;
  Vector3 end;
};

/// Splits lines at the faces of the box.
class LineSplitter
{
public:
  static constexpr std::size_t most_parts = 4;

  /// images: the images of the box; must outlive this object.
  LineSplitter(const Box& box, const MinimumImage& images, const Vector3& point_origin);

  /// Splits the line from `first` to the image of `second` that is `counts` box vectors away. Along each axis with a
  /// count, the line leaves through one face, the upper one if the count is positive, and enters at the opposite face,
  /// or that many vectors back. If the crossing is outside the line, because an end is outside the box, the nearer end
  /// is used. Returns the number of parts, at least 1. Parts shorter than rounding are left out if another part
  /// remains. The first part begins at `first`; the last ends at `second`, or at an image of `second` if the last part
  /// was left out.
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

/// Makes lines from first to second, which hold x y z of the ends of each row, absolute coordinates of any size. box gives
/// the axes along which ends have images; request: periodic_lines, point_origin, threads and pool. Ends that are not finite give lines that are not. Throws Cancelled, std::bad_alloc.
Lines make_lines(std::span<const double> first, std::span<const double> second, const Box& box,
  const Request& request, Progress& progress);

/// Counts the lengths that differ from `dist` of a file, both per row. Both were printed with six digits, like the ends
/// `first` and `second`, whose difference loses more digits the nearer they are. A nan length differs.
std::int64_t count_misfits(std::span<const double> lengths, std::span<const double> dist,
  std::span<const double> first, std::span<const double> second) noexcept;
}
#endif
