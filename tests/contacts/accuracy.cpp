// SPDX-License-Identifier: BSD-3-Clause
// Sums of contacts of any numbers in any boxes, held against 113 bits, and against the laws of mechanics.
#include "../support/hard_case.h"
#include "../support/quad.h"
#include "made_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

using granular::Box;
using made::ContactSumsRequest;
using made::Found;
using made::LeverArm;
using made::Scene;
using made::Touch;
using made::Vector3;
using Quad3 = std::array<Quad, 3>;
using Quad6 = std::array<Quad, 6>;

namespace
{
constexpr std::array<std::array<std::size_t, 2>, 6> axes = { { { 0, 0 }, { 1, 1 }, { 2, 2 },
  { 0, 1 }, { 0, 2 }, { 1, 2 } } };

double unit(std::mt19937_64& random)
{
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

Vector3 random_vector(std::mt19937_64& random, double size)
{
  return { size * (2 * unit(random) - 1), size * (2 * unit(random) - 1),
    size * (2 * unit(random) - 1) };
}

/// Particles all over a box, and rows between neighbours, which a face or several may divide.
Scene scene_in(const Box& box, double reach, unsigned seed)
{
  std::mt19937_64 random(seed);
  Scene scene;
  scene.box = box;
  scene.known.ends = false;
  const auto inside = [&](const Vector3& counts)
  {
    Vector3 x = { box.origin[0].value(), box.origin[1].value(), box.origin[2].value() };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        x[axis] += counts[i] * box.vectors[i][axis].value();
      }
    }
    return x;
  };
  for (int i = 0; i < 100; ++i)
  {
    const Vector3 at = { unit(random), unit(random), unit(random) };
    // its neighbour is on the other side now and then
    Vector3 next = at;
    for (double& count : next)
    {
      count += reach * (2 * unit(random) - 1);
      count -= std::floor(count);
    }
    scene.particles.push_back({ 2 * i, inside(at), 0.1 + unit(random) });
    scene.particles.push_back({ 2 * i + 1, inside(next), 0.1 + unit(random) });
    scene.pairs.push_back({ 2 * i, 2 * i + 1, {}, {}, random_vector(random, 5) });
    scene.pairs.push_back({ 2 * i + 1, 2 * i, {}, {}, random_vector(random, 5) });
  }
  return scene;
}

/// The shortest of all images that are at most three vectors away.
Quad3 shortest(const Box& box, const Vector3& from, const Vector3& to)
{
  Quad3 best = {};
  Quad least = -1;
  for (int n = 0; n < 7 * 7 * 7; ++n)
  {
    const std::array<int, 3> counts = { n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3 };
    Quad3 image;
    Quad square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      image[axis] = static_cast<Quad>(to[axis]) - static_cast<Quad>(from[axis]);
      for (std::size_t i = 0; i < 3; ++i)
      {
        const granular::Twofold& part = box.vectors[i][axis];
        image[axis] +=
          static_cast<Quad>(counts[i]) * (static_cast<Quad>(part.hi) + static_cast<Quad>(part.lo));
      }
      square += image[axis] * image[axis];
    }
    bool periodic = true;
    for (std::size_t i = 0; i < 3; ++i)
    {
      periodic = periodic && (counts[i] == 0 || box.boundary[3 * i] == 'p');
    }
    if (periodic && (least < 0 || square < least))
    {
      best = image;
      least = square;
    }
  }
  return best;
}

/// The largest error of the stresses, in units of 2^-53 times the sum of the magnitudes of their terms.
double stress_error(const Scene& scene, const ContactSumsRequest& request)
{
  const Found found = sum_all(scene, request);
  std::vector<Quad6> sums(scene.particles.size());
  std::vector<Quad6> terms(scene.particles.size());
  for (const Touch& touch : scene.pairs)
  {
    const auto first = static_cast<std::size_t>(touch.id1);
    const auto second = static_cast<std::size_t>(touch.id2);
    const Quad3 branch = shortest(*scene.box, scene.particles[first].x, scene.particles[second].x);
    const Quad radius = scene.particles[first].radius;
    const Quad part = request.options.arm == LeverArm::Half
      ? static_cast<Quad>(0.5)
      : radius / (radius + static_cast<Quad>(scene.particles[second].radius));
    for (std::size_t n = 0; n < 6; ++n)
    {
      // the arms of both ends are along the branch, with opposite forces at opposite sides
      const auto [a, b] = axes[n];
      const Quad whole = branch[a] * static_cast<Quad>(touch.force[b]);
      sums[first][n] += part * whole;
      sums[second][n] += (1 - part) * whole;
      terms[first][n] += absolute(part * whole);
      terms[second][n] += absolute((1 - part) * whole);
    }
  }
  double worst = 0;
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    for (std::size_t n = 0; n < 6; ++n)
    {
      const Quad error = absolute(static_cast<Quad>(found.particles[i].stress[n]) - sums[i][n]);
      worst = std::max(worst, static_cast<double>(error / terms[i][n]) * 0x1p53);
    }
  }
  return worst;
}

std::vector<Box> all_boxes()
{
  std::vector<Box> boxes = { made::periodic_box({ -1, 2, 0 }, { 3, 9, 0.7 }),
    made::periodic_box({ 0, 0, 0 }, { 1, 1, 1 }, "pp ff pp"),
    made::periodic_box({ 0.1, 0.1, 0.1 }, { 0.3, 0.7, 1000.1 }, "pp pp ff"),
    Box::from_tilted_bounds({ 0, 0, 0 }, { 1.4, 1.3, 1 }, 0.4, -0.3, 0.3),
    Box::from_tilted_bounds({ -5, 0, 0 }, { 15, 12, 8 }, 4.9, -5, 3.9),
    Box::from_vectors({ 1, 1, 1 }, { Vector3{ 3, 1, 0.5 }, { -1, 4, 0.25 }, { 0.3, 0.2, 5 } }) };
  for (std::size_t i = 3; i < 6; ++i)
  {
    boxes[i].boundary = i == 4 ? "pp pp ff" : "pp pp pp";
  }
  return boxes;
}
}

TEST(Accuracy, AcrossPeriodicFaces)
{
  HardCase hard("stresses",
    "contacts: contact_stress of rows without lines across faces of straight, tilted, flat and "
    "general boxes: error",
    "2^-53 of the terms", 8);
  unsigned seed = 0;
  for (const Box& box : all_boxes())
  {
    for (const LeverArm arm : { LeverArm::ContactPoint, LeverArm::Half })
    {
      ContactSumsRequest request;
      request.options.arm = arm;
      // where many images are nearly as long as each other the nearest still is the nearest
      for (const double reach : { 0.05, 0.2, 0.45 })
      {
        hard.add(stress_error(scene_in(box, reach, ++seed), request), 200 * 6);
      }
    }
  }
}

TEST(Accuracy, Fabric)
{
  HardCase hard(
    "stresses", "contacts: fabric against 113 bits: error, and that of the trace", "2^-53", 8);
  std::mt19937_64 random(5);
  for (const double size : { 1.0, 1e-6, 1e60 })
  {
    Scene scene;
    scene.particles = { { 1, {}, 1 } };
    Quad6 sums = {};
    for (int i = 1; i <= 150; ++i)
    {
      const Vector3 from = random_vector(random, size);
      const Vector3 to = random_vector(random, size);
      scene.pairs.push_back({ 1, 2, from, to, {} }); // the other one is not there
      Quad3 branch;
      Quad square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        branch[axis] = static_cast<Quad>(to[axis]) - static_cast<Quad>(from[axis]);
        square += branch[axis] * branch[axis];
      }
      for (std::size_t n = 0; n < 6; ++n)
      {
        sums[n] += branch[axes[n][0]] * branch[axes[n][1]] / square;
      }
      const made::Six fabric = sum_all(scene).particles[0].fabric;
      for (std::size_t n = 0; n < 6; ++n)
      {
        const Quad error = absolute(static_cast<Quad>(fabric[n]) - sums[n] / i);
        hard.add(static_cast<double>(error) * 0x1p53);
      }
      hard.add(std::abs(fabric[0] + fabric[1] + fabric[2] - 1) * 0x1p53);
    }
  }
}

namespace
{
/// Particles anywhere and lines between them, with torques and contact points that are anything.
Scene open_scene(unsigned seed)
{
  std::mt19937_64 random(seed);
  Scene scene;
  for (int i = 0; i < 60; ++i)
  {
    scene.particles.push_back({ i, random_vector(random, 10), 0.1 + unit(random) });
  }
  for (int i = 0; i < 400; ++i)
  {
    const auto first = static_cast<std::size_t>(random() % 60);
    const auto second = static_cast<std::size_t>(random() % 60);
    scene.pairs.push_back({ static_cast<made::Id>(first), static_cast<made::Id>(second),
      scene.particles[first].x, scene.particles[second].x, random_vector(random, 3), {},
      random_vector(random, 3), random_vector(random, 10) });
  }
  return scene;
}
}

/// Where forces act is a matter of each particle: all of them together have the stress of forces along branches.
TEST(Accuracy, TotalStressDependsOnNoArm)
{
  HardCase hard("stresses",
    "contacts: sum of contact_stress over all particles against the sum of branch times force, for "
    "any arms: error",
    "2^-53 of the terms", 4);
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    Scene scene = open_scene(seed);
    Quad6 expected = {};
    for (const Touch& touch : scene.pairs)
    {
      for (std::size_t n = 0; n < 6; ++n)
      {
        const auto [a, b] = axes[n];
        expected[n] += (static_cast<Quad>(touch.to[a]) - static_cast<Quad>(touch.from[a])) *
          static_cast<Quad>(touch.force[b]);
      }
    }
    for (int kind = 0; kind < 4; ++kind)
    {
      scene.known.point = kind == 0;
      scene.radii = kind != 1;
      ContactSumsRequest request;
      request.options.arm = kind == 2 ? LeverArm::Half : LeverArm::ContactPoint;
      Quad6 sums = {};
      Quad6 terms = {};
      for (const made::Sums& particle : sum_all(scene, request).particles)
      {
        for (std::size_t n = 0; n < 6; ++n)
        {
          sums[n] += static_cast<Quad>(particle.stress[n]);
          terms[n] += absolute(static_cast<Quad>(particle.stress[n]));
        }
      }
      for (std::size_t n = 0; n < 6; ++n)
      {
        hard.add(static_cast<double>(absolute(sums[n] - expected[n]) / terms[n]) * 0x1p53);
      }
    }
  }
}

/// Contacts between particles push and turn the whole of them not at all.
TEST(Accuracy, NoForceAndNoMomentOfAll)
{
  HardCase hard("sums",
    "contacts: total force and total moment, of given torques, of contact points and of radii: "
    "error",
    "2^-53 of the terms", 4);
  for (unsigned seed = 21; seed <= 40; ++seed)
  {
    Scene scene = open_scene(seed);
    for (int kind = 0; kind < 4; ++kind)
    {
      scene.known.torque = kind % 2 == 0;
      scene.known.point = kind < 2;
      const Found found = sum_all(scene);
      Quad3 force = {};
      Quad3 moment = {};
      Quad3 forces = {};
      Quad3 moments = {};
      for (std::size_t i = 0; i < scene.particles.size(); ++i)
      {
        const Vector3& x = scene.particles[i].x;
        const made::Sums& sums = found.particles[i];
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const std::size_t next = (axis + 1) % 3;
          const std::size_t last = (axis + 2) % 3;
          const Quad one = static_cast<Quad>(x[next]) * static_cast<Quad>(sums.force[last]);
          const Quad other = static_cast<Quad>(x[last]) * static_cast<Quad>(sums.force[next]);
          force[axis] += static_cast<Quad>(sums.force[axis]);
          moment[axis] += static_cast<Quad>(sums.torque[axis]) + one - other;
          forces[axis] += absolute(static_cast<Quad>(sums.force[axis]));
          moments[axis] +=
            absolute(static_cast<Quad>(sums.torque[axis])) + absolute(one) + absolute(other);
        }
      }
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        hard.add(static_cast<double>(absolute(force[axis]) / forces[axis]) * 0x1p53);
        hard.add(static_cast<double>(absolute(moment[axis]) / moments[axis]) * 0x1p53);
      }
    }
  }
}
