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
}
