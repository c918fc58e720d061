// SPDX-License-Identifier: BSD-3-Clause
// Sums that are known by hand: two particles, a chain, a lattice, a wall. Numbers are such that nothing is rounded.
#include "made_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

using made::everything;
using made::Found;
using made::Particle;
using made::Scene;
using made::Six;
using made::sum_all;
using made::Sums;
using made::Touch;
using made::Vector3;

namespace
{
double volume_of(double radius)
{
  return 4 * std::numbers::pi / 3 * radius * radius * radius;
}

/// Two particles of radii 1 and 3 along x, 4 apart, pressed together by 8 N and sheared by 2 N in y.
Scene two_particles()
{
  Scene scene;
  scene.particles = { { 7, { 10, 20, 30 }, 1 }, { -4, { 14, 20, 30 }, 3 } };
  scene.pairs = { { 7, -4, { 10, 20, 30 }, { 14, 20, 30 }, { -8, 2, 0 } } };
  return scene;
}
}

TEST(TwoParticles, TheForceActsWhereRadiiMeet)
{
  const Found found = sum_all(two_particles());
  const Sums& first = found.particles[0];
  const Sums& second = found.particles[1];
  EXPECT_EQ(first.coordination, 1);
  EXPECT_EQ(first.force, (Vector3{ -8, 2, 0 }));
  EXPECT_EQ(second.force, (Vector3{ 8, -2, 0 }));
  // arms: 1 to the right, 3 to the left
  EXPECT_EQ(first.stress, (Six{ -8, 0, 0, 2, 0, 0 }));
  EXPECT_EQ(second.stress, (Six{ -24, 0, 0, 6, 0, 0 }));
  EXPECT_EQ(first.torque, (Vector3{ 0, 0, 2 }));
  EXPECT_EQ(second.torque, (Vector3{ 0, 0, 6 }));
  EXPECT_EQ(first.fabric, (Six{ 1, 0, 0, 0, 0, 0 }));
  EXPECT_EQ(second.fabric, first.fabric);
  // in a plane: the mean of xx and yy, and the root of the rest, over the volume
  const double volume = 4 * std::numbers::pi / 3;
  const double root = std::hypot(4, 2);
  EXPECT_DOUBLE_EQ(first.principal[0] * volume, -4 + root);
  EXPECT_EQ(first.principal[1], 0);
  EXPECT_DOUBLE_EQ(first.principal[2] * volume, -4 - root);
  EXPECT_DOUBLE_EQ(first.von_mises * volume, std::sqrt(64 + 3 * 4));
  EXPECT_DOUBLE_EQ(second.von_mises * 27 * volume, 3 * std::sqrt(64 + 3 * 4));
  EXPECT_EQ(found.friction[0], (std::vector<double>{ 0.25 }));
}

TEST(TwoParticles, HalfTheBranch)
{
  made::ContactSumsRequest request = everything();
  request.options.arm = made::LeverArm::Half;
  const Found half = sum_all(two_particles(), request);
  EXPECT_EQ(half.particles[0].stress, (Six{ -16, 0, 0, 4, 0, 0 }));
  EXPECT_EQ(half.particles[1].stress, half.particles[0].stress);
  EXPECT_EQ(half.particles[0].torque, (Vector3{ 0, 0, 4 }));
  // nor does anything else tell where they touch
  Scene scene = two_particles();
  scene.radii = false;
  request = everything();
  request.principal_stress = request.von_mises = false;
  EXPECT_EQ(sum_all(scene, request).particles[0].stress, half.particles[0].stress);
  scene.radii = true;
  scene.particles[0].radius = scene.particles[1].radius = 0;
  EXPECT_EQ(sum_all(scene, request).particles[1].stress, half.particles[1].stress);
}

TEST(TwoParticles, AContactPointBesideTheLine)
{
  Scene scene = two_particles();
  scene.known.point = true;
  scene.pairs[0].point = { 11, 21, 30 };
  const Found found = sum_all(scene);
  // arms: (1, 1, 0) and (-3, 1, 0)
  EXPECT_EQ(found.particles[0].stress, (Six{ -8, 2, 0, 2, 0, 0 }));
  EXPECT_EQ(found.particles[1].stress, (Six{ -24, -2, 0, 6, 0, 0 }));
  EXPECT_EQ(found.particles[0].torque, (Vector3{ 0, 0, 2 + 8 }));
  EXPECT_EQ(found.particles[1].torque, (Vector3{ 0, 0, 6 - 8 }));
  EXPECT_EQ(found.particles[0].fabric, (Six{ 1, 0, 0, 0, 0, 0 })); // the normal is along the line
}

/// The given torque is that on the first; the other gets the rest of the moment of both forces: branch x force - torque.
TEST(TwoParticles, GivenTorques)
{
  Scene scene = two_particles();
  scene.known.torque = true;
  scene.pairs[0].torque = { 0.5, -0.25, 3 };
  for (const bool point : { false, true }) // which does not matter then
  {
    scene.known.point = point;
    scene.pairs[0].point = { 11, 21, 30 };
    const Found found = sum_all(scene);
    EXPECT_EQ(found.particles[0].torque, (Vector3{ 0.5, -0.25, 3 }));
    EXPECT_EQ(found.particles[1].torque, (Vector3{ -0.5, 0.25, 8 - 3 }));
  }
}

/// n particles in a line, pulled at both ends: each feels nothing but for the outermost, and has the stress of the pull.
TEST(Chain, UnderTension)
{
  const Vector3 step = { 1, 2, 2 }; // of length 3
  const Vector3 pull = { 2, 4, 4 };
  Scene scene;
  for (int i = 0; i < 8; ++i)
  {
    scene.particles.push_back({ i, { i * step[0], i * step[1], i * step[2] }, 1.5 });
    if (i > 0)
    {
      scene.pairs.push_back({ i - 1, i, scene.particles[static_cast<std::size_t>(i) - 1].x,
        scene.particles[static_cast<std::size_t>(i)].x, pull });
    }
  }
  const Found found = sum_all(scene);
  for (std::size_t i = 0; i < 8; ++i)
  {
    const bool outermost = i == 0 || i == 7;
    const double part = outermost ? 0.5 : 1;
    const Sums& sums = found.particles[i];
    EXPECT_EQ(sums.coordination, outermost ? 1 : 2);
    EXPECT_EQ(sums.force, i == 0 ? pull : i == 7 ? (Vector3{ -2, -4, -4 }) : Vector3{});
    EXPECT_EQ(sums.torque, Vector3{});
    EXPECT_EQ(sums.stress,
      (Six{ part * 2, part * 8, part * 8, part * 4, part * 4, part * 8 })); // tension is positive
    for (std::size_t n = 0; n < 6; ++n)
    {
      constexpr Six fabric = { 1, 4, 4, 2, 2, 4 };
      EXPECT_DOUBLE_EQ(sums.fabric[n], fabric[n] / 9);
    }
    EXPECT_NEAR(sums.principal[1], 0, 1e-15);
    EXPECT_DOUBLE_EQ(sums.principal[0], part * 18 / volume_of(1.5));
    EXPECT_EQ(sums.rattler, 1); // it unravels from its ends
    EXPECT_EQ(sums.backbone, 0);
  }
  EXPECT_EQ(found.counts, (std::array<std::int64_t, 7>{ 8, 14, 8, 0, 0, 0, 0 }));
}

/// A simple cubic lattice, periodic, with the same force between all neighbours along an axis: the mean stress is force
/// times distance over volume, and each particle has the same.
TEST(Lattice, UnderKnownForces)
{
  constexpr int n = 4;
  constexpr double a = 0.25;
  const std::array<Vector3, 3> forces = { Vector3{ -3, 0.5, 0 }, Vector3{ 0.5, -5, 0.25 },
    Vector3{ 0, 0.25, -7 } }; // on the lower neighbour along x, y and z
  for (const bool lines : { true, false })
  {
    Scene scene;
    scene.known.ends = lines;
    scene.box = made::periodic_box({ 0, 0, 0 }, { n * a, n * a, n * a });
    const auto id = [&](int i, int j, int k) { return (i % n * n + j % n) * n + k % n; };
    for (int i = 0; i < n * n * n; ++i)
    {
      const Vector3 x = { i / (n * n) * a, i / n % n * a, i % n * a };
      scene.particles.push_back({ i, x, a / 2 });
      const std::array<int, 3> others = { id(i / (n * n) + 1, i / n % n, i % n),
        id(i / (n * n), i / n % n + 1, i % n), id(i / (n * n), i / n % n, i % n + 1) };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        Vector3 to = x; // out of the box at its faces
        to[axis] += a;
        scene.pairs.push_back({ i, others[axis], x, to, forces[axis] });
      }
    }
    const Found found = sum_all(scene);
    for (const Sums& sums : found.particles)
    {
      EXPECT_EQ(sums.coordination, 6);
      EXPECT_EQ(sums.backbone, 6);
      EXPECT_EQ(sums.rattler, 0);
      EXPECT_EQ(sums.force, Vector3{});
      EXPECT_EQ(sums.torque, Vector3{});
      EXPECT_EQ(sums.stress, (Six{ -3 * a, -5 * a, -7 * a, 0.5 * a, 0, 0.25 * a }));
      EXPECT_EQ(sums.fabric, (Six{ 2. / 6, 2. / 6, 2. / 6, 0, 0, 0 }));
      EXPECT_DOUBLE_EQ(
        sums.principal[0] + sums.principal[1] + sums.principal[2], -15 * a / volume_of(a / 2));
    }
    EXPECT_EQ(found.counts, (std::array<std::int64_t, 7>{ 64, 384, 0, 384, 0, 0, 0 }));
    EXPECT_DOUBLE_EQ(found.friction[0][0], 0.5 / 3);
    EXPECT_DOUBLE_EQ(found.friction[0][1], std::hypot(0.5, 0.25) / 5);
  }
}

/// A particle of radius 1 on a floor and beside a wall: the force acts at the wall, whatever the arm.
TEST(Walls, FloorAndSide)
{
  for (const bool half : { false, true })
  {
    Scene scene;
    scene.particles = { { 5, { 3, 4, 0.75 }, 1 } };
    scene.walls = { { 0, 5, { 3, 4, 0 }, { 3, 4, 0.75 }, { 0, 2, 8 } },
      { 0, 5, { 2, 4, 0.75 }, { 3, 4, 0.75 }, { 1, 0, 0 } } };
    made::ContactSumsRequest request = everything();
    request.options.arm = half ? made::LeverArm::Half : made::LeverArm::ContactPoint;
    const Found found = sum_all(scene, request);
    const Sums& sums = found.particles[0];
    EXPECT_EQ(sums.coordination, 2);
    EXPECT_EQ(sums.force, (Vector3{ 1, 2, 8 }));
    // arms: 0.75 down, and 1 to the left
    EXPECT_EQ(sums.stress, (Six{ -1, 0, -6, 0, 0, 0 }))
      << "yz has the order y f_z: the arm has no y";
    EXPECT_EQ(sums.torque, (Vector3{ 1.5, 0, 0 }));
    EXPECT_EQ(sums.fabric, (Six{ 0.5, 0, 0.5, 0, 0, 0 }));
    EXPECT_EQ(sums.rattler, 0); // walls bear
    EXPECT_EQ(sums.backbone, 2);
    EXPECT_EQ(found.friction[1], (std::vector<double>{ 0.25, 0 }));
    EXPECT_EQ(found.counts, (std::array<std::int64_t, 7>{ 1, 2, 0, 2, 0, 0, 0 }));
  }
}

/// Given torques of walls are those on the particle.
TEST(Walls, GivenTorques)
{
  Scene scene;
  scene.known.torque = true;
  scene.particles = { { 5, { 3, 4, 0.75 }, 1 } };
  scene.walls = { { 0, 5, { 3, 4, 0 }, { 3, 4, 0.75 }, { 0, 2, 8 }, {}, { 1, 2, 3 } } };
  EXPECT_EQ(sum_all(scene).particles[0].torque, (Vector3{ 1, 2, 3 }));
}

/// Rows without lines, but with the point that is touched, across a periodic face.
TEST(Walls, PointsAlone)
{
  Scene scene;
  scene.known.ends = false;
  scene.known.point = true;
  scene.box = made::periodic_box({ 0, 0, 0 }, { 8, 8, 8 }, "pp pp ff");
  scene.particles = { { 5, { 7.5, 4, 0.75 }, 1 } };
  scene.walls = { { 0, 5, {}, {}, { 0, 0, 8 }, {}, {}, { 0.25, 4, 0 } } };
  const Found found = sum_all(scene);
  EXPECT_EQ(found.particles[0].stress, (Six{ 0, 0, -6, 0, 0.75 * 8, 0 }));
  EXPECT_EQ(found.particles[0].force, (Vector3{ 0, 0, 8 }));
}

/// Contacts below a force or an overlap do not count, but their forces do.
TEST(Thresholds, OfForceAndOverlap)
{
  Scene scene;
  scene.known.overlap = true;
  for (int i = 0; i < 4; ++i)
  {
    scene.particles.push_back({ i, { 2. * i, 0, 0 }, 1 + i / 64. });
  }
  for (int i = 0; i < 3; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    scene.pairs.push_back({ i, i + 1, scene.particles[at].x, scene.particles[at + 1].x,
      { -1. - i, 0, 0 }, {}, {}, {}, 0.5 + i });
  }
  const auto coordination = [&](double force, double overlap)
  {
    made::ContactSumsRequest request = everything();
    request.options.least_force = force;
    request.options.least_overlap = overlap;
    const Found found = sum_all(scene, request);
    std::vector<int> all;
    for (const Sums& sums : found.particles)
    {
      all.push_back(sums.coordination);
      EXPECT_EQ(sums.fabric[0], sums.coordination > 0 ? 1 : 0);
    }
    EXPECT_EQ(found.particles[0].force, (Vector3{ -1, 0, 0 }));
    EXPECT_EQ(found.particles[1].force, (Vector3{ -1, 0, 0 }));
    EXPECT_NE(found.particles[3].stress[0], 0);
    EXPECT_EQ(found.counts[1], all[0] + all[1] + all[2] + all[3]);
    return all;
  };
  using Counts = std::vector<int>;
  EXPECT_EQ(coordination(0, 0), (Counts{ 1, 2, 2, 1 }));
  EXPECT_EQ(coordination(1, 0), (Counts{ 1, 2, 2, 1 })); // from it on
  EXPECT_EQ(coordination(std::nextafter(1, 2), 0), (Counts{ 0, 1, 2, 1 }));
  EXPECT_EQ(coordination(3, 0), (Counts{ 0, 0, 1, 1 }));
  EXPECT_EQ(coordination(4, 0), (Counts{ 0, 0, 0, 0 }));
  EXPECT_EQ(coordination(0, 0.5), (Counts{ 1, 2, 2, 1 }));
  EXPECT_EQ(coordination(0, 0.75), (Counts{ 0, 1, 2, 1 }));
  EXPECT_EQ(coordination(2, 2.5), (Counts{ 0, 0, 1, 1 }));
  // without delta: radii are 1, 1 + 1/64 and so on
  scene.known.overlap = false;
  EXPECT_EQ(coordination(0, 1. / 64), (Counts{ 1, 2, 2, 1 }));
  EXPECT_EQ(coordination(0, 2. / 64), (Counts{ 0, 1, 2, 1 }));
  EXPECT_EQ(coordination(0, 5. / 64), (Counts{ 0, 0, 1, 1 }));
  EXPECT_EQ(coordination(0, 5.5 / 64), (Counts{ 0, 0, 0, 0 }));
  scene.known.ends = false;
  EXPECT_EQ(coordination(0, 5. / 64), (Counts{ 0, 0, 1, 1 }));
}

/// What contacts without forces do not tell is not there.
TEST(Contents, WithoutForces)
{
  Scene scene = two_particles();
  scene.known.force = false;
  const made::Frame frame(scene.particles, scene);
  const made::Rows rows(scene.pairs, scene.known, false);
  granular::SerialCommunicator alone;
  granular::Progress progress;
  const std::array<made::ContactRows, 1> inputs = { rows.view() };
  const made::ContactSums sums =
    granular::sum_contacts(frame.view(), inputs, everything(), alone, progress);
  for (const granular::Block* block :
    { &sums.force, &sums.torque, &sums.stress, &sums.principal_stress, &sums.von_mises })
  {
    EXPECT_EQ(block->data(), nullptr);
  }
  EXPECT_TRUE(sums.friction.empty());
  EXPECT_EQ(sums.fabric.bytes(), 2 * 6 * sizeof(double));
  EXPECT_EQ(static_cast<const double*>(sums.fabric.data())[6], 1);
  EXPECT_EQ(static_cast<const std::int32_t*>(sums.coordination.data())[1], 1);
}

/// What nobody asks for is not there, and does not change the rest.
TEST(Contents, OnlyWhatIsAsked)
{
  const Scene scene = two_particles();
  const Sums all = sum_all(scene).particles[0];
  for (int kind = 0; kind < 6; ++kind)
  {
    made::ContactSumsRequest request;
    request.force = kind == 0;
    request.torque = kind == 1;
    request.fabric = kind == 2;
    request.stress = kind == 3;
    request.principal_stress = kind == 4;
    request.von_mises = kind == 5;
    const Sums sums = sum_all(scene, request).particles[0];
    EXPECT_EQ(sums.coordination, 1);
    EXPECT_EQ(sums.force, kind == 0 ? all.force : Vector3{});
    EXPECT_EQ(sums.torque, kind == 1 ? all.torque : Vector3{});
    EXPECT_EQ(sums.fabric, kind == 2 ? all.fabric : Six{});
    EXPECT_EQ(sums.stress, kind == 3 ? all.stress : Six{});
    EXPECT_EQ(sums.principal, kind == 4 ? all.principal : Vector3{});
    EXPECT_EQ(sums.von_mises, kind == 5 ? all.von_mises : 0);
    EXPECT_EQ(sums.backbone, 0);
  }
}
