// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_periodic_images_h
#define granular_grid_periodic_images_h

#include "granular/geometry/box.h"
#include "granular/geometry/expansion.h"
#include "granular/grid/euler_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace granular
{
/// Returns an image rounded downwards: on the side of any face on which the image is.
inline Vector3 floors_of(const Twofold3& image) noexcept
{
  return { floor_of(image[0]), floor_of(image[1]), floor_of(image[2]) };
}

/// The images of particles along the periodic axes of a box that reach into a grid.
class PeriodicImages
{
public:
  /// box: null, or a general one: there are none but the particles themselves.
  PeriodicImages(const EulerGrid& grid, const Box* box);

  /// Returns true if centres in the box may have images in the grid.
  bool of_centres() const noexcept { return of_centres_; }

  /// Returns true if a particle surely has no image in the grid but itself.
  bool alone(const double* centre, double radius) const noexcept
  {
    return this->alone(0, centre[0], radius) && this->alone(1, centre[1], radius) &&
      this->alone(2, centre[2], radius);
  }

  /// Returns true if the particle has images along that axis.
  bool repeats(std::size_t axis) const noexcept { return axes_[axis].repeats; }

  /// Calls visit(centre of the image) for each image that may reach into the grid, including the particle itself.
  template <class Visit>
  void each(const double* centre, double radius, const Visit& visit) const
  {
    this->each(centre, Vector3{ radius, radius, radius }, visit);
  }

  /// The same for what reaches that far along each axis. In a tilted box the last vector alone has a part along z, and only
  /// the first has none along y: axis by axis, the last one first, images are as far apart as in a straight box.
  template <class Visit>
  void each(const double* centre, const Vector3& reach, const Visit& visit) const
  {
    std::array<std::int64_t, 3> k = {};
    const auto place = [&](std::size_t axis)
    {
      const bool itself = k[axis] == 0 && (!tilted_ || k == std::array<std::int64_t, 3>{});
      return itself ? Twofold{ centre[axis], 0 } : this->moved(axis, centre[axis], k);
    };
    const auto along = [&](std::size_t axis, const auto& next)
    {
      const auto [first, last] = this->range(axis, place(axis).value(), reach[axis]);
      for (k[axis] = first; k[axis] <= last; ++k[axis])
      {
        next();
      }
      k[axis] = 0;
    };
    along(2,
      [&] {
        along(1, [&] { along(0, [&] { visit(Twofold3{ place(0), place(1), place(2) }); }); });
      });
  }

  /// Checks that particles up to that radius, with centres in the box, have no more images than can be counted; throws
  /// LimitError. Call it before each().
  void check(double radius) const;

  /// Returns the largest number of images of a particle up to that radius in one cell.
  std::int64_t most_in_cell(double radius) const noexcept;

  /// Returns true if a place along an axis is that of a particle whose image one period below is in the grid, too: at the upper
  /// face of a grid that is a period long, or longer. In a tilted box the image may be elsewhere along other axes: a grid with
  /// the lengths of the box has each particle once all the same.
  bool is_twice(std::size_t axis, double x) const noexcept
  {
    return axes_[axis].wraps && x == grid_.hi[axis];
  }

private:
  struct Axis
  {
    bool repeats = false;
    bool wraps = false; ///< the grid is not shorter than a period
    Twofold length;
    double lo = 0; ///< between these a particle has no image in the grid but itself
    double hi = 0;
  };

  bool alone(std::size_t axis, double x, double radius) const noexcept
  {
    const Axis& a = axes_[axis];
    return !a.repeats || (!tilted_ && x - radius > a.lo && x + radius < a.hi);
  }

  /// The first and the last.
  std::array<std::int64_t, 2> range(std::size_t axis, double x, double radius) const noexcept
  {
    return this->alone(axis, x, radius) ? std::array<std::int64_t, 2>{}
                                        : this->find_range(axis, x, radius);
  }
  std::array<std::int64_t, 2> find_range(std::size_t axis, double x, double radius) const noexcept;

  /// The coordinate of the image that is so many of each vector of the box away.
  Twofold moved(std::size_t axis, double x, const std::array<std::int64_t, 3>& k) const noexcept;

  EulerGrid grid_;
  std::array<Axis, 3> axes_;
  bool tilted_ = false;
  std::array<Twofold3, 3> vectors_ = {}; ///< of the box
  bool of_centres_ = false;
};
}
#endif
