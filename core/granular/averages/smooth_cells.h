// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_smooth_cells_h
#define granular_averages_smooth_cells_h

#include "granular/geometry/box.h"
#include "granular/grid/cell_finder.h"
#include "granular/grid/euler_grid.h"
#include "granular/grid/periodic_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
/// The shapes of smoothing kernels (I. Goldhirsch, "Stress, stress asymmetry and couple stress: from discrete particles to
/// continuous fields", Granular Matter 12, 2010; T. Weinhart, C. Labra, S. Luding, J. Y. Ooi, "Influence of coarse-graining
/// parameters on the analysis of DEM simulations of silo flow", Powder Technology 293, 2016).
enum class KernelShape : std::uint8_t
{
  Gaussian, ///< exp(-r^2 / (2 w^2)), cut at 3 w
  Lucy,     ///< (1 + 3 q)(1 - q)^3 with q = r / (2 w)
  Heaviside ///< 1 within w
};

/// Throws Error if a width is not above 0, or so small or large that its fourth power is no number of all digits (1e-60 to
/// 1e60).
void check_width(double width);

/// A smoothing kernel of a width w: 1 at its centre, and 0 from its support on. Not normalised.
class Kernel
{
public:
  /// width: see check_width.
  Kernel(KernelShape shape, double width) noexcept;

  KernelShape shape() const noexcept { return shape_; }
  double width() const noexcept { return width_; }

  /// Returns the radius from which on the kernel is 0: 3, 2 or 1 width.
  double support() const noexcept { return widths_ * width_; }

  /// Returns the integral over all space, in closed form.
  double volume() const noexcept;

  /// Returns the value at a distance, whose square is given. The square decides as it is rounded whether that is within the
  /// support.
  double value(double square) const noexcept
  {
    if (!(square < support_square_))
    {
      return 0;
    }
    switch (shape_)
    {
      case KernelShape::Gaussian:
        return std::exp(square * gauss_);
      case KernelShape::Lucy:
      {
        const double q = std::sqrt(square) * per_support_;
        const double rest = std::max(1 - q, 0.0);
        return (1 + 3 * q) * rest * rest * rest;
      }
      case KernelShape::Heaviside:
        break;
    }
    return 1;
  }

  /// Returns the mean of the kernel over a line that begins at -to_point, seen from the kernel's centre, and has the direction
  /// and length of branch: the integral of value(|to_point - s branch|) over s from 0 to 1. A branch without length gives the
  /// value at its place. The error is at most 1e-14, for any finite numbers: whether the line touches the support, and where,
  /// is computed with as many digits as that takes.
  double line_mean(const Vector3& to_point, const Vector3& branch) const noexcept;

private:
  struct Chord;

  double point_value(const Vector3& to_point, bool inside) const noexcept;
  double integrate(
    const Chord& chord, const Vector3& to_point, const Vector3& branch) const noexcept;
  double integrate_lucy(
    const Chord& chord, const Vector3& to_point, const Vector3& branch) const noexcept;
  template <class Take>
  double quadrature(double from, double to, const Vector3& to_point, const Vector3& branch,
    const Take& take) const noexcept;

  KernelShape shape_;
  double width_;
  double widths_; ///< of the support
  double support_square_;
  double per_support_;
  double gauss_; ///< -1 / (2 w^2)
};

/// Ways in which a kernel that a face of the grid cuts is normalised.
enum class KernelBounds : std::uint8_t
{
  None,  ///< over all space: what is beyond the faces is lost
  Inside ///< inside the grid, along axes that are not periodic: all is inside
};

/// The division of a particle among cells.
enum class CellWeights : std::uint8_t
{
  Centre,  ///< the whole particle in the cell of its centre, as in LIGGGHTS
  Overlap, ///< each cell has the volume of the particle inside it
  Kernel   ///< each cell has what a smoothing kernel around its centre gives: see SmoothCells
};

/// Ways to divide particles and contacts.
struct WeightOptions
{
  CellWeights weights = CellWeights::Overlap;
  KernelShape kernel = KernelShape::Gaussian;
  double width = 0; ///< of the kernel, above 0
  KernelBounds bounds = KernelBounds::None;
};

/// Divides points and lines among the cells of a grid by a kernel around the centre of each cell. The parts are normalised:
/// the cells of the grid, continued over all space, have one whole together. Along an axis with a single cell there is no
/// smoothing: the cell has all that is between its faces.
class SmoothCells
{
public:
  SmoothCells(
    const EulerGrid& grid, const Kernel& kernel, KernelBounds bounds, const PeriodicImages& images);

  /// Working memory of a thread.
  struct Room
  {
    struct Weight
    {
      std::int64_t cell;
      double weight;
    };
    std::array<std::vector<double>, 3> places; ///< of cells along each axis, seen from the start
    std::array<std::vector<double>, 3> values; ///< of what belongs to them
    std::vector<Weight> weights;
  };

  /// Throws LimitError if the kernel has too many cells, for lines that long along any axis.
  void check(double length) const;

  /// Returns how far a line reaches along each axis from its middle.
  Vector3 reach(const Vector3& branch) const noexcept;

  /// Returns the cells that a line may belong to: an image, with its start, the middle of which is at most reach() away from
  /// the grid. middle: which side of faces it is on; a rounded start does not tell of images.
  CellRange range(
    const Vector3& start, const Vector3& branch, const Vector3& middle) const noexcept;

  /// Calls add(cell in the range, part) for the cells of a range that a line belongs to. A branch of 0 is a point. Returns
  /// false if the kernel is so narrow that it has no cell: the line then belongs to the cells in which it is. May be called
  /// from any thread.
  template <class Add>
  bool each(const Vector3& start, const Vector3& branch, const Vector3& middle,
    const CellRange& within, Room& room, const Add& add) const
  {
    double all = 0;
    if (!this->is_inside(middle))
    {
      return true;
    }
    this->find(start, branch, within, room, all);
    for (const Room::Weight& each : room.weights)
    {
      add(each.cell, each.weight / all);
    }
    return all > 0;
  }

private:
  bool is_inside(const Vector3& middle) const noexcept;
  std::array<std::int64_t, 2> cells_near(std::size_t axis, double lo, double hi) const noexcept;
  void find(const Vector3& start, const Vector3& branch, const CellRange& within, Room& room,
    double& all) const;
  void find_point(const CellRange& near, const CellRange& within, Room& room, double& all) const;
  void find_line(const Vector3& branch, const CellRange& near, const CellRange& within, Room& room,
    double& all) const;

  EulerGrid grid_;
  Kernel kernel_;
  const PeriodicImages& images_;
  CellFinder finder_;
  std::array<bool, 3> smooth_ = {};  ///< axes with several cells
  std::array<bool, 3> bounded_ = {}; ///< axes along which the kernel ends at the faces
  Vector3 spacing_ = {};
};
}
#endif
