// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_kernel_h
#define granular_averages_kernel_h

#include "granular/geometry/box.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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
}
#endif
