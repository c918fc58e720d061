// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/sphere_box.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace granular
{
namespace
{
double square(double x)
{
  return x * x;
}

/// The root, of what may have been rounded below 0.
double root(double x)
{
  return std::sqrt(std::max(0.0, x));
}

// ---- one slice: a disc and a rectangle ---------------------------------------------------------

/// Returns the area of the part of a disc of radius 1 that is beyond a chord of this half length t, t^2 <= 1/2.
double segment(double t2)
{
  const double t = std::sqrt(t2);
  if (t2 > 1.0 / 64)
  {
    return std::asin(t) - t * std::sqrt(1 - t2);
  }
  const double high = 5.0 / 72 + t2 * (35.0 / 704 + t2 * (63.0 / 1664));
  return t * t2 * (2.0 / 3 + t2 * (1.0 / 5 + t2 * (3.0 / 28 + t2 * high)));
}

/// Slices across y in which the circle enters through the same edge of the rectangle in x and z, and leaves it
/// through the same: it goes from P, left or on top, to Q, right or at the bottom.
struct Slices
{
  double x0, x1, z0, z1;
  double radius2; ///< of the sphere, squared
  bool p_on_top, q_on_right;
  double p_radius2, q_radius2; ///< of the circles along which P and Q go

  double area(double y) const
  {
    const double y2 = y * y;
    const double p = root(p_radius2 - y2);
    const double q = root(q_radius2 - y2);
    const double px = p_on_top ? p : x0;
    const double pz = p_on_top ? z1 : p;
    const double qx = q_on_right ? x1 : q;
    const double qz = q_on_right ? q : z0;
    const double dx = qx - px;
    const double dz = pz - qz;
    const double disc2 = radius2 - y2;
    const double half_chord2 = std::max(0.0, std::min(0.5, (dx * dx + dz * dz) / (4 * disc2)));
    return (px - x0) * (z1 - z0) + dx * ((pz + qz) / 2 - z0) + disc2 * segment(half_chord2);
  }
};

// ---- their sum ---------------------------------------------------------------------------------

struct Node
{
  double place; ///< from the middle, in half lengths
  double weight;
};

constexpr std::array<Node, 23> nodes = { {
  // 4, each of which stands for two
  { 0.86113631159405258, 0.17392742256872693 },
  { 0.33998104358485626, 0.32607257743127307 },
  // 6
  { 0.93246951420315203, 0.085662246189585173 },
  { 0.66120938646626451, 0.1803807865240693 },
  { 0.23861918608319691, 0.23395696728634552 },
  // 8
  { 0.96028985649753623, 0.05061426814518813 },
  { 0.79666647741362674, 0.11119051722668724 },
  { 0.52553240991632899, 0.15685332293894364 },
  { 0.1834346424956498, 0.18134189168918099 },
  // 12
  { 0.98156063424671925, 0.023587668193255914 },
  { 0.90411725637047486, 0.053469662997659215 },
  { 0.76990267419430469, 0.080039164271673113 },
  { 0.58731795428661745, 0.10158371336153296 },
  { 0.36783149899818019, 0.1167462682691774 },
  { 0.12523340851146892, 0.12457352290670139 },
  // 16
  { 0.98940093499164993, 0.013576229705877047 },
  { 0.94457502307323258, 0.031126761969323946 },
  { 0.86563120238783174, 0.047579255841246392 },
  { 0.75540440835500303, 0.062314485627766936 },
  { 0.61787624440264375, 0.074797994408288366 },
  { 0.45801677765722739, 0.084578259697501269 },
  { 0.28160355077925891, 0.091301707522461794 },
  { 0.09501250983763744, 0.094725305227534248 },
} };

/// The half axis of the smallest ellipse in the complex plane around an interval, in its half lengths, that meets a
/// singularity says how fast Gauss' rules converge: these are enough for about 1e-13.
struct Rule
{
  double half_axis; ///< and more
  std::size_t first;
  std::size_t count;
};

constexpr std::array<Rule, 5> rules = { {
  { 130, 0, 2 },
  { 11, 2, 3 },
  { 4.3, 5, 4 },
  { 2, 9, 6 },
  { 0, 15, 8 },
} };
constexpr double enough_for_12 = 2;
constexpr double enough_for_16 = 1.5;

template <typename Function>
double integrate(double begin, double end, double half_axis, const Function& function)
{
  const Rule& rule = *std::find_if(
    rules.begin(), rules.end() - 1, [&](const Rule& r) { return half_axis >= r.half_axis; });
  const double middle = (begin + end) / 2;
  const double half = (end - begin) / 2;
  double sum = 0;
  for (const Node& node : std::span(nodes).subspan(rule.first, rule.count))
  {
    const double step = node.place * half;
    sum += node.weight * (function(middle - step) + function(middle + step));
  }
  return sum * (end - begin);
}

/// Near the end of the smaller of the two circles, slices change like a root. y = radius 2 q / (1 + q^2) makes a
/// fraction of it. The end of the larger circle is where q is on the unit circle, at the angle whose cosine is small / large;
/// where that is too near, intervals are halved.
struct CircleIntegral
{
  const Slices& slices;
  double radius; ///< of the smaller circle
  double cosine, sine2;

  double operator()(double begin, double end, int depth) const
  {
    const double root_axis =
      (std::sqrt(square(cosine - begin) + sine2) + std::sqrt(square(cosine - end) + sine2)) /
      (end - begin);
    const double pole_axis =
      (std::sqrt(1 + square(begin)) + std::sqrt(1 + square(end))) / (end - begin);
    // the poles of the fraction, at +-i, are of higher order than a root, and so slow down more
    const double half_axis = std::min(root_axis, 0.63 * pole_axis);
    if (half_axis < enough_for_16 && depth < 40)
    {
      const double middle = (begin + end) / 2;
      return (*this)(begin, middle, depth + 1) + (*this)(middle, end, depth + 1);
    }
    return integrate(begin, end, half_axis,
      [&](double q)
      {
        const double part = 1 / (1 + q * q);
        return slices.area(radius * 2 * q * part) * radius * 2 * (1 - q * q) * part * part;
      });
  }
};

double integrate_slices(const Slices& slices, double begin, double end)
{
  const auto [small2, large2] = std::minmax(slices.p_radius2, slices.q_radius2);
  const double radius = std::max(end, root(small2));
  const double half_axis = (2 * radius - begin - end) / (end - begin);
  if (half_axis >= enough_for_12)
  {
    return integrate(begin, end, half_axis, [&](double y) { return slices.area(y); });
  }
  const double sine2 =
    large2 > small2 ? 1 - small2 / large2 : 1; // of equal ones neither is a root then
  const CircleIntegral integral = { slices, radius, root(1 - sine2), sine2 };
  const auto to_q = [&](double y) { return y / (radius + root((radius - y) * (radius + y))); };
  const double q_begin = to_q(begin);
  const double q_end = to_q(end);
  return q_begin < q_end ? integral(q_begin, q_end, 0) : 0;
}

// ---- the box -----------------------------------------------------------------------------------

/// The rest of the box: the surface of the sphere in it.
struct Piece
{
  double radius2;
  Vector3 lo, hi;

  /// Cuts off what is wholly outside and wholly inside of the sphere along an axis; the volume of the latter.
  double trim(std::size_t axis)
  {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    const double outer2 = radius2 - square(lo[b]) - square(lo[c]);
    const double inner2 = radius2 - square(hi[b]) - square(hi[c]);
    if (square(hi[axis]) > outer2)
    {
      hi[axis] = std::max(lo[axis], root(outer2));
    }
    if (square(lo[axis]) >= inner2)
    {
      return 0;
    }
    const double begin = lo[axis];
    lo[axis] = std::min(hi[axis], std::sqrt(inner2));
    return (lo[axis] - begin) * (hi[b] - lo[b]) * (hi[c] - lo[c]);
  }

  /// The axis along which slices change least.
  std::size_t axis_of_slices() const
  {
    const auto change = [&](std::size_t axis)
    { return (hi[axis] - lo[axis]) * (hi[axis] + lo[axis]); };
    const std::size_t least = change(1) < change(0) ? 1 : 0;
    return change(2) < change(least) ? 2 : least;
  }

  /// The slices across y where y is near this value.
  Slices slices_at(std::size_t y_axis, double y) const
  {
    const std::size_t x = (y_axis + 1) % 3;
    const std::size_t z = (y_axis + 2) % 3;
    Slices slices = { lo[x], hi[x], lo[z], hi[z], radius2, false, false, 0, 0 };
    const double disc2 = radius2 - y * y;
    slices.p_on_top = square(slices.x0) + square(slices.z1) < disc2;
    slices.q_on_right = square(slices.x1) + square(slices.z0) < disc2;
    slices.p_radius2 = radius2 - square(slices.p_on_top ? slices.z1 : slices.x0);
    slices.q_radius2 = radius2 - square(slices.q_on_right ? slices.x1 : slices.z0);
    return slices;
  }

  /// Slices across this axis; the circle passes two corners of the rectangle on its way.
  double sum_of_slices(std::size_t y) const
  {
    const std::size_t x = (y + 1) % 3;
    const std::size_t z = (y + 2) % 3;
    const auto place = [&](double corner2) { return std::clamp(root(corner2), lo[y], hi[y]); };
    const auto [first, second] = std::minmax({ place(radius2 - square(lo[x]) - square(hi[z])),
      place(radius2 - square(hi[x]) - square(lo[z])) });
    const std::array<double, 4> ends = { lo[y], first, second, hi[y] };
    double volume = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    {
      if (ends[i] < ends[i + 1])
      {
        volume +=
          integrate_slices(this->slices_at(y, (ends[i] + ends[i + 1]) / 2), ends[i], ends[i + 1]);
      }
    }
    return volume;
  }
};
}

double octant_volume(double radius, Vector3 lo, Vector3 hi) noexcept
{
  Piece piece = { radius * radius, lo, hi };
  double inside = piece.trim(0) + piece.trim(1) + piece.trim(2);
  const std::size_t axis = piece.axis_of_slices();
  inside += piece.trim(axis);
  return inside + std::max(0.0, piece.sum_of_slices(axis));
}
}
