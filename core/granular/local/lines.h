// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_lines_h
#define granular_local_lines_h

#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/memory/block.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace granular
{
class BlockPool;

/// How lines across periodic faces are drawn.
enum class PeriodicLines : std::uint8_t
{
  MinimumImage, ///< short, from the first end out of the box
  Split,    ///< from both ends to the faces between them: a line more for each face that is crossed
  AsWritten ///< from end to end, wherever these are
};

/// How lines are made.
struct LineRequest
{
  PeriodicLines periodic = PeriodicLines::MinimumImage;
  Vector3 point_origin = {};       ///< subtracted from the points
  int threads = 1;                 ///< >= 1; changes no result
  std::shared_ptr<BlockPool> pool; ///< where the memory comes from; may be null
};

/// Lines from the rows of a table.
struct Lines
{
  std::int64_t count = 0;
  Block points;  ///< count x 2 x 3 doubles: the ends of each line
  Block lengths; ///< a double a row: of the whole line, however many parts it was split into
  std::vector<std::int64_t> rows; ///< of each line, in their order; empty: line i is row i
  std::int64_t moved = 0; ///< rows whose second end is not drawn where it was, or which are split
};

/// Lines from first to second, which hold x y z of the ends of each row, absolute coordinates of any size. box
/// says along which axes ends have images. Ends that are not finite give lines that are not. Throws Cancelled,
/// std::bad_alloc.
Lines make_lines(std::span<const double> first, std::span<const double> second, const Box& box,
  const LineRequest& request, Progress& progress);

/// How many lengths are not what a file says of them, `dist`, both of rows: where all were printed with six digits, as
/// the ends first and second of each, which lose more of them the nearer they are to each other. A length that is no
/// number is not what it says.
std::int64_t count_misfits(std::span<const double> lengths, std::span<const double> dist,
  std::span<const double> first, std::span<const double> second) noexcept;
}
#endif
