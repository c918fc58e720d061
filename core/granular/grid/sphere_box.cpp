// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/sphere_box.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace granular
{
namespace
{
constexpr double pi = std::numbers::pi;

// All for a sphere of radius 1 and planes at distances a, b, c from 0 to 1.

/// The edge where two planes meet inside, and the angles that belong to it.
struct Edge
{
  double product;     ///< a b
  double half_length; ///< from the middle to where it leaves the sphere
  double opening;     ///< there, between the circles that the planes cut
  double arc_a;       ///< half the part beyond b of the circle at a
  double arc_b;       ///< half the part beyond a of the circle at b
};

Edge make_edge(double a, double b)
{
  const double half = std::sqrt(std::max(0.0, 1 - a * a - b * b));
  return { a * b, half, std::atan2(half, a * b), std::atan2(half, b), std::atan2(half, a) };
}

// The volumes beyond are those that the divergence theorem gives: spherical polygons, their areas by Gauss and Bonnet,
// less discs.

/// A cap.
double beyond_plane(double height)
{
  return pi / 3 * height * height * (3 - height);
}

double disc_weight(double a)
{
  return a * (3 - a * a);
}

double beyond_edge(double a, double b, const Edge& edge)
{
  const double arcs = disc_weight(a) * edge.arc_a + disc_weight(b) * edge.arc_b;
  return std::max(0.0, (2 * (edge.opening + edge.product * edge.half_length) - arcs) / 3);
}

/// edges[k] is that of the planes across axes k and k + 1.
double beyond_corner(const Vector3& distances, const std::array<Edge, 3>& edges)
{
  double openings = pi / 2;
  double discs = 0;
  double flats = -3 * distances[0] * distances[1] * distances[2];
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Edge& edge = edges[k];
    const double arc = edge.arc_a + (edges[(k + 2) % 3].arc_b - pi / 2);
    openings += edge.opening - pi / 2;
    discs += disc_weight(distances[k]) * arc / 2;
    flats += edge.product * edge.half_length;
  }
  return std::max(0.0, (openings - discs + flats) / 3);
}

/// For each set of planes what is beyond all of them.
SphereParts beyond_all(double radius, const Vector3& distances)
{
  SphereParts beyond = { 4 * pi / 3 };
  std::array<Edge, 3> edges = {};
  Vector3 units = {};
  Vector3 squares = {};
  const double square =
    radius * radius; // not of units: centred_box_volume decides by the same numbers
  for (std::size_t k = 0; k < 3; ++k)
  {
    units[k] = std::min(1.0, distances[k] / radius);
    squares[k] = distances[k] * distances[k];
    if (squares[k] < square)
    {
      beyond[std::size_t{ 1 } << k] = beyond_plane(std::max(0.0, (radius - distances[k]) / radius));
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t next = (k + 1) % 3;
    if (squares[k] + squares[next] < square)
    {
      edges[k] = make_edge(units[k], units[next]);
      beyond[(std::size_t{ 1 } << k) | (std::size_t{ 1 } << next)] =
        beyond_edge(units[k], units[next], edges[k]);
    }
  }
  if (squares[0] + squares[1] + squares[2] < square)
  {
    beyond[7] = beyond_corner(units, edges);
  }
  return beyond;
}

double square(double x)
{
  return x * x;
}

/// At most one plane an axis: the volume of the part that the box takes of the sphere.
double one_part(double radius, const Vector3& lo, const Vector3& hi)
{
  Vector3 distances = {};
  std::size_t part = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const bool has_lo = lo[k] > -radius;
    const double plane = has_lo ? lo[k] : hi[k];
    const bool is_beyond = has_lo ? plane > 0 : plane <= 0; // the centre is in the upper half
    distances[k] = std::min(radius, std::abs(plane));
    part |= static_cast<std::size_t>(is_beyond) << k;
  }
  return cut_sphere(radius, distances)[part];
}

/// The part between two planes is the part beyond the first plane minus the part beyond the second. Rounding costs some ulps of the
/// sphere, which for a large box is next to nothing.
double sum_of_parts(double radius, const Vector3& lo, const Vector3& hi)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (lo[k] > -radius && hi[k] < radius)
    {
      Vector3 beyond = lo;
      Vector3 open = hi;
      beyond[k] = hi[k];
      open[k] = radius;
      return sum_of_parts(radius, lo, open) - sum_of_parts(radius, beyond, open);
    }
  }
  return one_part(radius, lo, hi);
}

/// The octants that the planes through the centre cut, mirrored into the first.
double sum_of_octants(double radius, const Vector3& lo, const Vector3& hi)
{
  double volume = 0;
  for (std::size_t octant = 0; octant < 8; ++octant)
  {
    Vector3 near = {};
    Vector3 far = {};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const bool is_mirrored = ((octant >> k) & 1) != 0;
      near[k] = std::max(0.0, is_mirrored ? -hi[k] : lo[k]);
      far[k] = std::min(radius, is_mirrored ? -lo[k] : hi[k]);
    }
    if (near[0] < far[0] && near[1] < far[1] && near[2] < far[2])
    {
      volume += octant_volume(radius, near, far);
    }
  }
  return volume;
}

/// Neither wholly inside nor outside.
double cut_volume(double radius, const Vector3& lo, const Vector3& hi)
{
  constexpr double large = 0.05; // cubes of the radius: 1e-12 of it is 400 ulps of the sphere
  double size = 1;
  bool is_one_part = true;
  for (std::size_t k = 0; k < 3; ++k)
  {
    size *= std::min(hi[k] - lo[k], 2 * radius);
    is_one_part = is_one_part && (lo[k] <= -radius || hi[k] >= radius);
  }
  return is_one_part || size >= large * radius * radius * radius
    ? std::max(0.0, sum_of_parts(radius, lo, hi))
    : sum_of_octants(radius, lo, hi);
}
}

SphereParts cut_sphere(double radius, const Vector3& distances) noexcept
{
  SphereParts parts = beyond_all(radius, distances);
  for (std::size_t plane = 1; plane < parts.size(); plane *= 2)
  {
    for (std::size_t part = 0; part < parts.size(); ++part)
    {
      if ((part & plane) == 0)
      {
        parts[part] -= parts[part | plane];
      }
    }
  }
  for (double& part : parts)
  {
    part = std::max(0.0, part) * radius * radius * radius;
  }
  return parts;
}

double sphere_volume(double radius) noexcept
{
  return 4 * pi / 3 * radius * radius * radius;
}

double box_volume(const Vector3& edges) noexcept
{
  Vector3 sorted = edges;
  std::sort(sorted.begin(), sorted.end());
  return sorted[0] > 0 ? sorted[0] * sorted[2] * sorted[1] : 0;
}

double centred_box_volume(
  double radius, const Vector3& lo, const Vector3& hi, const Vector3& edges) noexcept
{
  constexpr double smallest =
    0x1p-250; // the cubes of this and of its inverse, and products that are smaller, are normal
  if (!(radius > 0))
  {
    return 0;
  }
  const bool is_moderate = smallest <= radius && radius <= 1 / smallest;
  const int exponent = is_moderate ? 0 : std::ilogb(radius);
  const auto scaled = [&](double length)
  { return is_moderate ? length : std::scalbn(length, -exponent); };
  const double reach = scaled(radius);
  const Vector3 from = { scaled(lo[0]), scaled(lo[1]), scaled(lo[2]) };
  const Vector3 to = { scaled(hi[0]), scaled(hi[1]), scaled(hi[2]) };
  double nearest2 = 0; // from the centre to the box
  double farthest2 = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    nearest2 += square(std::max({ 0.0, from[k], -to[k] }));
    farthest2 += square(std::max(-from[k], to[k]));
  }
  if (nearest2 >= reach * reach)
  {
    return 0;
  }
  const double box = box_volume(edges);
  if (farthest2 <= reach * reach)
  {
    return box;
  }
  const double volume = cut_volume(reach, from, to);
  return std::min(
    { box, sphere_volume(radius), is_moderate ? volume : std::scalbn(volume, 3 * exponent) });
}
}
