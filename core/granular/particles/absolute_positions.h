// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_absolute_positions_h
#define granular_particles_absolute_positions_h

#include "granular/geometry/box.h"
#include "granular/geometry/expansion.h"
#include "granular/geometry/positions.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/frame_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace granular
{
/// A coordinate as an exact sum, with room for a number of periods.
using ExactCoordinate = Expansion<16>;

/// An axis of an orthogonal box: x and x + length are the same position.
struct PeriodicAxis
{
  double lo = 0;
  double hi = 0;
  Twofold length; ///< hi - lo; finite, above 0

  bool holds(double x) const noexcept { return x >= lo && x < hi; }

  /// Returns the largest double not above the exact image in [lo, hi) of a coordinate: comparisons with doubles give the same
  /// result for both. nearby: the coordinate within some ulps. A coordinate 2^52 lengths away, where no bit gives the
  /// position, stays nearby.
  double wrap(const ExactCoordinate& x, double nearby) const noexcept
  {
    if (!(std::abs(nearby - lo) < 0x1p52 * length.value()))
    {
      return nearby;
    }
    double count = std::floor((nearby - lo) / length.value());
    double image = this->image(x, count);
    // the quotient was rounded: by some at most
    for (int turn = 0; turn < 8 && !this->holds(image); ++turn)
    {
      count += image < lo ? -1 : 1;
      image = this->image(x, count);
    }
    return std::clamp(image, lo, std::nextafter(hi, lo)); // hi - length is lo within rounding
  }

private:
  double image(ExactCoordinate x, double count) const noexcept
  {
    x.add_product(-count, length);
    return x.floor();
  }
};

/// The positions of the particles of a frame in any form of its points: absolute, with the subtracted origin added again, or
/// less an origin of one's own; each coordinate rounded once, to the nearest double.
class AbsolutePositions
{
public:
  static constexpr std::size_t most_rows = 1024; ///< at a time

  /// wrap: into the box along its periodic axes, lo <= x < hi, if the frame has an orthogonal box. A coordinate outside the
  /// faces becomes the largest double not above its exact image, less than an ulp below it: both are on the same side of any
  /// double, such as a face or a cut. A coordinate 2^52 periods away, where no bit gives the position in one, stays there.
  /// Other unwrapped points lose their image counts; without counts they are moved into the box along periodic axes, tilted
  /// or not: see count_crossings. Throws Error if points are scaled or unwrapped and there is no box. The frame must outlive
  /// this. less: subtracted from positions that are not wrapped; those of a frame that has the same origin stay as they are.
  AbsolutePositions(const FrameView& frame, bool wrap, const Vector3& less = {});

  /// Returns x y z of rows [first, first + count), count <= most_rows: in the array of the points itself if it needs no
  /// conversion and all are finite, otherwise in buffer, which has room for most_rows * 3 numbers. May be called from any
  /// thread.
  const double* load(std::int64_t first, std::size_t count, double* buffer) const;

  /// Stores x y z of any number of rows: from the first on, or in any order.
  void store(std::int64_t first, std::size_t count, double* to) const;
  void store(std::span<const std::int64_t> rows, double* to) const;

  /// Returns the rows of an array that load found to need no conversion, without checking again.
  const double* loaded(std::int64_t first) const noexcept
  {
    return static_cast<const double*>(frame_.points->components[0]) + 3 * first;
  }

  /// Returns rows in any order, always in the buffer.
  void load(std::span<const std::int64_t> rows, double* buffer) const;

private:
  void convert(std::span<const std::int64_t> rows, double* buffer) const;
  bool is_wrapped(std::span<const double> points) const noexcept;
  void wrap(std::size_t axis, std::span<const std::int64_t> rows, double* buffer) const;
  ExactCoordinate exact(std::size_t axis, std::int64_t row) const;

  const FrameView& frame_;
  bool same_ = false;  ///< the points are what is wanted, but for wrapping
  bool plain_ = false; ///< and they are an array of rows
  Box box_;            ///< in the coordinates of the points
  PositionPlan plan_;
  Vector3 less_ = {};
  std::array<std::optional<ValueSource>, 3>
    images_ = {};        ///< of unwrapped points, where they are known
  bool crosses_ = false; ///< unwrapped points without counts: these are found
  std::array<std::optional<PeriodicAxis>, 3> wraps_; ///< axes
};

/// Returns the positions of points that are not particles, such as corners of cells: x y z of each. A subtracted origin is added, and
/// scaled points are multiplied by the box. Unwrapped points are unchanged: particles are unwrapped, cells are not.
std::vector<double> absolute_points(FrameView points);
}
#endif
