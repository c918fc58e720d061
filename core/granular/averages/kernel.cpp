// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/smooth_cells.h"

#include "granular/common/error.h"
#include "granular/geometry/expansion.h"
#include "granular/numbers/number_print.h"

#include <cstddef>
#include <numbers>

namespace granular
{
namespace
{
/// Nodes and weights of Gauss-Legendre quadrature with eight points in [-1, 1]: the positive ones.
constexpr double nodes[4] = { 0.18343464249564980494, 0.52553240991632898582,
  0.79666647741362673959, 0.96028985649753623168 };
constexpr double weights[4] = { 0.36268378337836198297, 0.31370664587788728734,
  0.22238103445337447054, 0.10122853629037625915 };

/// So near to 0, compared with the terms, rounded sums are not trusted.
constexpr double near = 1e-3;

/// Branches shorter than that part of the width are points.
constexpr double shortest = 0x1p-900;

Vector3 scaled(const Vector3& vector, int power) noexcept
{
  return { std::ldexp(vector[0], power), std::ldexp(vector[1], power),
    std::ldexp(vector[2], power) };
}

double largest_of(const Vector3& vector) noexcept
{
  return std::max({ std::abs(vector[0]), std::abs(vector[1]), std::abs(vector[2]) });
}

/// |x|^2 - n w^2, exact where it nearly cancels.
double square_minus(const Vector3& x, double n, double width) noexcept
{
  const double square = dot(x, x);
  const double less = n * (width * width);
  if (std::abs(square - less) > near * less)
  {
    return square - less;
  }
  Expansion<16> sum;
  for (const double each : x)
  {
    sum.add_product(each, each);
  }
  const double product = width * width;
  sum.add_product(-n, Twofold{ product, std::fma(width, width, -product) });
  return sum.twofold().value();
}

/// n w^2 |b|^2 - |x cross b|^2, exact where it nearly cancels.
double chord_square(const Vector3& x, const Vector3& b, double n, double width) noexcept
{
  const double reach = n * (width * width) * dot(b, b);
  const Vector3 across = cross(x, b);
  const double square = dot(across, across);
  if (std::abs(reach - square) > near * reach)
  {
    return reach - square;
  }
  Expansion<256> sum;
  const auto subtract_square = [&](double a, double d, double c, double e)
  {
    Expansion<4> part; // a d - c e
    part.add_product(a, d);
    part.add_product(-c, e);
    for (const double one : part.parts())
    {
      for (const double other : part.parts())
      {
        sum.add_product(-one, other);
      }
    }
  };
  subtract_square(x[1], b[2], x[2], b[1]);
  subtract_square(x[2], b[0], x[0], b[2]);
  subtract_square(x[0], b[1], x[1], b[0]);
  Expansion<4> squares; // n w^2
  const double product = width * width;
  squares.add_product(n, Twofold{ product, std::fma(width, width, -product) });
  for (const double each : b)
  {
    const double of_branch = each * each;
    const double rest = std::fma(each, each, -of_branch);
    for (const double one : squares.parts())
    {
      sum.add_product(one, Twofold{ of_branch, rest });
    }
  }
  return sum.twofold().value();
}

/// Returns a dot product that is right for terms that nearly cancel, too.
double accurate_dot(const Vector3& a, const Vector3& b) noexcept
{
  CompensatedSum sum;
  for (std::size_t i = 0; i < 3; ++i)
  {
    sum.add_product(a[i], b[i]);
  }
  return sum.value();
}

/// The integral of the kernel of Lucy from 0 to t, at the height d above the line, both in units of the support.
double lucy_from_foot(double t, double d) noexcept
{
  const double d2 = d * d;
  const double t2 = t * t;
  const double r = std::sqrt(d2 + t2);
  double cubes = t * r * (r * r / 4 + 3 * d2 / 8);
  if (d > 1e-60)
  {
    cubes += 3 * d2 * d2 / 8 * std::asinh(t / d);
  }
  return t * (1 - 6 * (d2 + t2 / 3) - 3 * (d2 * d2 + t2 * (2 * d2 / 3 + t2 / 5))) + 8 * cubes;
}
}

/// The part of a branch within the support, in a unit in which the branch ends at `end`.
struct Kernel::Chord
{
  double from;
  double to;
  double end;
  double foot;   ///< where the branch comes nearest to the centre, perhaps beyond its ends
  double length; ///< of a unit
  double height; ///< of the centre above the line
};

void check_width(double width)
{
  if (!(width >= 1e-60 && width <= 1e60))
  {
    throw Error("expected a KernelWidth from 1e-60 to 1e60, got " + to_text(width));
  }
}

Kernel::Kernel(KernelShape shape, double width) noexcept
  : shape_(shape)
  , width_(width)
  , widths_(shape == KernelShape::Gaussian ? 3
        : shape == KernelShape::Lucy       ? 2
                                           : 1)
  , support_square_(widths_ * widths_ * width * width)
  , per_support_(1 / (widths_ * width))
  , gauss_(-0.5 / (width * width))
{
}

double Kernel::volume() const noexcept
{
  using std::numbers::pi;
  const double cube = width_ * width_ * width_;
  switch (shape_)
  {
    case KernelShape::Gaussian:
      return std::pow(2 * pi, 1.5) * cube *
        (std::erf(3 / std::numbers::sqrt2) - 3 * std::sqrt(2 / pi) * std::exp(-4.5));
    case KernelShape::Lucy:
      return 128 * pi / 105 * cube;
    case KernelShape::Heaviside:
      break;
  }
  return 4 * pi / 3 * cube;
}

/// The value where an exact decision about the edge says that it is inside.
double Kernel::point_value(const Vector3& to_point, bool inside) const noexcept
{
  return inside
    ? this->value(std::min(dot(to_point, to_point), std::nextafter(support_square_, 0.0)))
    : 0;
}

double Kernel::line_mean(const Vector3& to_point, const Vector3& branch) const noexcept
{
  const double longest = largest_of(branch);
  const double farthest = largest_of(to_point);
  const double squares = widths_ * widths_;
  if (longest == 0 || longest < shortest * width_)
  {
    const double beyond = square_minus(to_point, squares, width_);
    return this->point_value(
      to_point, beyond < 0 || (beyond == 0 && accurate_dot(to_point, scaled(branch, 900)) > 0));
  }
  if (farthest > 2 * longest + 2 * this->support())
  {
    return 0;
  }
  // the branch in a unit in which nothing over- or underflows
  const int power = -std::ilogb(longest / width_);
  const Vector3 b = scaled(branch, power);
  const double end = std::ldexp(1.0, -power);
  const double chord = chord_square(to_point, b, squares, width_);
  if (!(chord > 0))
  {
    return 0;
  }
  const double square = dot(b, b);
  const double half = accurate_dot(to_point, b);
  const double beyond = square_minus(to_point, squares, width_);
  const double root = half >= 0 ? half + std::sqrt(chord) : half - std::sqrt(chord);
  const double near_root = beyond / root; // the product of both is beyond / square
  const double far_root = root / square;
  const Vector3 across = cross(to_point, b);
  Chord part;
  part.from = std::max(half >= 0 ? near_root : far_root, 0.0);
  part.to = std::min(half >= 0 ? far_root : near_root, end);
  part.end = end;
  part.foot = half / square;
  part.length = std::sqrt(square);
  part.height = length_of(across) / part.length;
  return part.from < part.to ? std::clamp(this->integrate(part, to_point, b) / end, 0.0, 1.0) : 0;
}

/// Returns the integral of take(r^2) along a part of the branch.
template <class Take>
double Kernel::quadrature(double from, double to, const Vector3& to_point, const Vector3& branch,
  const Take& take) const noexcept
{
  const auto at = [&](double s)
  {
    const Vector3 r = { to_point[0] - s * branch[0], to_point[1] - s * branch[1],
      to_point[2] - s * branch[2] };
    return take(dot(r, r));
  };
  const double middle = from + (to - from) / 2;
  const double half = (to - from) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    sum += weights[i] * (at(middle - half * nodes[i]) + at(middle + half * nodes[i]));
  }
  return half * sum;
}

double Kernel::integrate(
  const Chord& chord, const Vector3& to_point, const Vector3& branch) const noexcept
{
  if (shape_ == KernelShape::Heaviside)
  {
    return chord.to - chord.from;
  }
  if (shape_ == KernelShape::Lucy)
  {
    return this->integrate_lucy(chord, to_point, branch);
  }
  if ((chord.to - chord.from) * chord.length < width_ / 2)
  {
    return this->quadrature(chord.from, chord.to, to_point, branch,
      [&](double square) { return std::exp(square * gauss_); });
  }
  const double scale = chord.length / (width_ * std::numbers::sqrt2);
  const double difference =
    std::erf((chord.to - chord.foot) * scale) - std::erf((chord.from - chord.foot) * scale);
  return std::exp(chord.height * chord.height * gauss_) * difference /
    (scale * std::numbers::inv_sqrtpi * 2);
}

/// On each side of the foot the closed form loses no digits but for short parts far from it, where quadrature does well.
double Kernel::integrate_lucy(
  const Chord& chord, const Vector3& to_point, const Vector3& branch) const noexcept
{
  const auto side = [&](double from, double to)
  {
    if (!(from < to))
    {
      return 0.0;
    }
    const double first = std::abs(from - chord.foot);
    const double last = std::abs(to - chord.foot);
    if (to - from < std::min(first, last) / 2)
    {
      return this->quadrature(from, to, to_point, branch,
        [&](double square)
        {
          const double q = std::min(std::sqrt(square) * per_support_, 1.0);
          const double rest = 1 - q;
          return (1 + 3 * q) * rest * rest * rest;
        });
    }
    const double scale = chord.length * per_support_;
    const double height = chord.height * per_support_;
    // on a line that begins 10^16 widths away an ulp is longer than the support
    const auto part = [&](double t) { return lucy_from_foot(std::min(t * scale, 1.0), height); };
    return std::abs(part(last) - part(first)) / scale;
  };
  const double foot = std::clamp(chord.foot, chord.from, chord.to);
  return side(chord.from, foot) + side(foot, chord.to);
}
}
