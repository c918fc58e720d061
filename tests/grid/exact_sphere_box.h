// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_euler_exact_sphere_box_h
#define granular_tests_euler_exact_sphere_box_h

#include "../support/quad.h"
#include "granular/geometry/box.h"

#include <array>
#include <cmath>

// The volume that a sphere and a box have in common with 113 bits: the signed sum of what is beyond the corners, which
// loses about (radius / edge)^2 of them.

inline const Quad quad_pi = static_cast<Quad>(3.141592653589793116) +
  static_cast<Quad>(1.2246467991473532072e-16) + static_cast<Quad>(-2.9947698097183396659e-33);

inline Quad quad_root(Quad a)
{
  if (a <= 0)
  {
    return 0;
  }
  Quad root = static_cast<Quad>(std::sqrt(static_cast<long double>(a)));
  for (int i = 0; i < 2; ++i)
  {
    root = (root + a / root) / 2;
  }
  return root;
}

/// Of y >= 0, in a frame that the nearest double turns by nearly all of the angle.
inline Quad quad_angle(Quad y, Quad x)
{
  const Quad largest = std::max(absolute(x), y);
  if (largest == 0)
  {
    return 0;
  }
  const Quad v = y / largest;
  const Quad u = x / largest;
  const auto angle = static_cast<Quad>(std::atan2(static_cast<double>(v), static_cast<double>(u)));
  Quad term = 1;
  Quad cosine = 0;
  Quad sine = 0;
  for (int n = 0; n < 40; n += 2)
  {
    cosine += n % 4 == 0 ? term : -term;
    term *= angle / (n + 1);
    sine += n % 4 == 0 ? term : -term;
    term *= angle / (n + 2);
  }
  const Quad rest = (v * cosine - u * sine) / (u * cosine + v * sine);
  return angle + rest - rest * rest * rest / 3;
}

/// Volumes of the unit sphere where each coordinate is at least a, b, c, from 0.
inline Quad quad_beyond(Quad a)
{
  return a < 1 ? quad_pi * (1 - a) * (1 - a) * (2 + a) / 3 : static_cast<Quad>(0);
}

inline Quad quad_beyond(Quad a, Quad b)
{
  if (a * a + b * b >= 1)
  {
    return 0;
  }
  const Quad s = quad_root(1 - a * a - b * b);
  return (2 * quad_angle(s, a * b) + 2 * a * b * s - a * (3 - a * a) * quad_angle(s, b) -
           b * (3 - b * b) * quad_angle(s, a)) /
    3;
}

inline Quad quad_beyond(Quad a, Quad b, Quad c)
{
  if (a * a + b * b + c * c >= 1)
  {
    return 0;
  }
  const Quad ab = quad_root(1 - a * a - b * b);
  const Quad bc = quad_root(1 - b * b - c * c);
  const Quad ca = quad_root(1 - c * c - a * a);
  const Quad arcs = a * (3 - a * a) * (quad_angle(ab, b) - quad_angle(c, ca)) +
    b * (3 - b * b) * (quad_angle(bc, c) - quad_angle(a, ab)) +
    c * (3 - c * c) * (quad_angle(ca, a) - quad_angle(b, bc));
  const Quad angles = quad_angle(ab, a * b) + quad_angle(bc, b * c) + quad_angle(ca, c * a);
  return (angles - quad_pi - arcs / 2 + a * b * ab + b * c * bc + c * a * ca - 3 * a * b * c) / 3;
}

/// The same for any numbers: what is beyond a plane at a < 0 is all less what is beyond its mirror image.
inline Quad quad_corner(std::array<Quad, 3> planes)
{
  for (const Quad plane : planes)
  {
    if (plane >= 1)
    {
      return 0;
    }
  }
  std::array<Quad, 3> real = {};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (planes[k] > -1 && planes[k] < 0)
    {
      std::array<Quad, 3> all = planes;
      std::array<Quad, 3> mirrored = planes;
      all[k] = -1;
      mirrored[k] = -planes[k];
      return quad_corner(all) - quad_corner(mirrored);
    }
    if (planes[k] > -1)
    {
      real[count] = planes[k];
      ++count;
    }
  }
  switch (count)
  {
    case 0:
      return 4 * quad_pi / 3;
    case 1:
      return quad_beyond(real[0]);
    case 2:
      return quad_beyond(real[0], real[1]);
    default:
      return quad_beyond(real[0], real[1], real[2]);
  }
}

struct ExactVolume
{
  Quad value = 0;
  Quad tolerance = 0; ///< what centred_box_volume promises
};

inline ExactVolume exact_sphere_box(const granular::Twofold3& centre, double radius,
  const granular::Vector3& lo, const granular::Vector3& hi)
{
  const auto r = static_cast<Quad>(radius);
  const Quad cube = r * r * r;
  std::array<std::array<Quad, 3>, 2> planes = {};
  std::array<Quad, 3> edges = {};
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Quad middle = static_cast<Quad>(centre[k].hi) + static_cast<Quad>(centre[k].lo);
    planes[0][k] = (static_cast<Quad>(lo[k]) - middle) / r;
    planes[1][k] = (static_cast<Quad>(hi[k]) - middle) / r;
    edges[k] = static_cast<Quad>(hi[k]) - static_cast<Quad>(lo[k]);
  }
  Quad farthest = 0;
  Quad nearest = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Quad far = std::max(-planes[0][k], planes[1][k]);
    const Quad near = std::max({ static_cast<Quad>(0), planes[0][k], -planes[1][k] });
    farthest += far * far;
    nearest += near * near;
  }
  const Quad box = edges[0] * edges[1] * edges[2];
  const Quad sphere = 4 * quad_pi / 3 * cube;
  const Quad face = std::max({ edges[0] * edges[1], edges[1] * edges[2], edges[2] * edges[0] });
  const Quad least = std::min(box, sphere);
  ExactVolume exact;
  exact.tolerance = least * static_cast<Quad>(1e-12) + 16 * static_cast<Quad>(0x1p-53) * r * face +
    4 * static_cast<Quad>(std::numeric_limits<double>::denorm_min());
  if (farthest <= 1 || nearest >= 1)
  {
    exact.value = farthest <= 1 ? box : static_cast<Quad>(0);
    return exact;
  }
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    const auto far = [&](std::size_t k) { return (corner >> k) & 1; };
    const Quad beyond = quad_corner({ planes[far(0)][0], planes[far(1)][1], planes[far(2)][2] });
    exact.value += (far(0) + far(1) + far(2)) % 2 == 0 ? beyond * cube : -beyond * cube;
  }
  return exact;
}

inline ExactVolume exact_sphere_box(const granular::Vector3& centre, double radius,
  const granular::Vector3& lo, const granular::Vector3& hi)
{
  const granular::Twofold3 twofold = { { { centre[0], 0 }, { centre[1], 0 }, { centre[2], 0 } } };
  return exact_sphere_box(twofold, radius, lo, hi);
}
#endif
