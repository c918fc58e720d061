// SPDX-License-Identifier: BSD-3-Clause
// Random scenes, and their sums by the plainest means: each contact after the other, added up as large integers.
#ifndef granular_tests_contacts_plain_sums_h
#define granular_tests_contacts_plain_sums_h

#include "../support/big_sum.h"
#include "made_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

namespace made
{
/// All of the numbers are fractions with few bits, so that branches, arms and products are exact.
struct SceneForm
{
  std::size_t particles = 200;
  std::size_t pairs = 600;
  std::size_t walls = 80;
  Known known = {};
  int powers = 285;     ///< forces are 2^-powers to 2^powers
  bool periodic = true; ///< rows without ends are nearest images then
  bool far_ids = false; ///< of 64 bits, and negative
  bool ghosts = false;
  bool missing = false;
  bool cancel = false; ///< each force comes back with the opposite sign
};

/// One period: no difference of two places is half of it.
inline constexpr double period = 8 + 1. / 64;

inline double nearest_image(double difference)
{
  return difference > period / 2 ? difference - period
    : difference < -period / 2   ? difference + period
                                 : difference;
}

inline Vector3 random_place(std::mt19937_64& random)
{
  const auto number = [&] { return static_cast<double>(random() % 512) / 64; };
  return { number(), number(), number() };
}

inline Vector3 random_force(std::mt19937_64& random, int powers)
{
  const auto number = [&]
  {
    const auto mantissa = static_cast<double>(static_cast<int>(random() % (1 << 21)) - (1 << 20));
    const auto all = static_cast<std::uint64_t>(2 * powers + 1);
    return std::ldexp(mantissa, static_cast<int>(random() % all) - powers - 20);
  };
  return { number(), number(), number() };
}

inline Touch random_touch(
  const Particle& first, const Particle& second, const SceneForm& form, std::mt19937_64& random)
{
  Touch touch;
  touch.id1 = first.id;
  touch.id2 = second.id;
  touch.to = second.x;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // the ends of lines are anywhere, as nothing says that they are at the particles
    touch.from[axis] = form.periodic
      ? second.x[axis] - nearest_image(second.x[axis] - first.x[axis])
      : first.x[axis];
    touch.point[axis] = touch.from[axis] + static_cast<double>(random() % 64) / 64 - 0.5;
  }
  touch.force = random_force(random, form.powers);
  touch.tangential = random_force(random, form.powers);
  touch.torque = random_force(random, form.powers);
  touch.overlap = static_cast<double>(random() % 8) / 8;
  return touch;
}

inline Scene make_scene(const SceneForm& form, unsigned seed)
{
  std::mt19937_64 random(seed);
  Scene scene;
  scene.known = form.known;
  if (form.periodic)
  {
    scene.box = periodic_box({ 0, 0, 0 }, { period, period, period });
  }
  for (std::size_t i = 0; i < form.particles; ++i)
  {
    const Id id = form.far_ids ? static_cast<Id>((random() << 10) + i) : static_cast<Id>(i) - 5;
    scene.particles.push_back({ id, random_place(random), random() % 2 == 0 ? 1. : 3. });
  }
  if (form.far_ids)
  {
    scene.particles.front().id = std::numeric_limits<Id>::min();
    scene.particles.back().id = std::numeric_limits<Id>::max();
  }
  const auto any = [&]() -> const Particle& { return scene.particles[random() % form.particles]; };
  for (std::size_t i = 0; i < form.pairs; ++i)
  {
    scene.pairs.push_back(random_touch(any(), any(), form, random));
    if (form.cancel)
    {
      Touch back = scene.pairs.back();
      back.force = { -back.force[0], -back.force[1], -back.force[2] };
      scene.pairs.push_back(back);
    }
  }
  for (std::size_t i = 0; i < form.walls; ++i)
  {
    scene.walls.push_back(random_touch(any(), any(), form, random));
  }
  for (std::size_t i = 0; form.missing && i < scene.pairs.size(); i += 7)
  {
    (i % 2 == 0 ? scene.pairs[i].id1 : scene.pairs[i].id2) = 1'000'000 + static_cast<Id>(i);
  }
  std::vector<Particle> ghosts;
  for (std::size_t i = 0; form.ghosts && i < scene.particles.size(); i += 3)
  {
    Particle ghost = scene.particles[i];
    ghost.ghost = 1;
    ghost.x[0] += 100;
    ghosts.push_back(ghost);
  }
  scene.particles.insert(
    scene.particles.end() - static_cast<std::ptrdiff_t>(scene.particles.size() / 2), ghosts.begin(),
    ghosts.end());
  std::ranges::shuffle(scene.pairs, random);
  return scene;
}

/// The sums of a particle as integers.
struct PlainSums
{
  std::int32_t coordination = 0;
  int normals = 0;
  std::array<BigSum, 3> force, torque;
  std::array<BigSum, 6> fabric, stress;
};

inline Vector3 minus(const Vector3& a, const Vector3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/// The nearest image of a point, seen from a centre.
inline Vector3 seen_from(const Vector3& centre, const Vector3& point, const Scene& scene)
{
  Vector3 arm = minus(point, centre);
  for (std::size_t axis = 0; scene.box && axis < 3; ++axis)
  {
    arm[axis] = nearest_image(arm[axis]);
  }
  return arm;
}

inline Vector3 turned_round(const Vector3& a)
{
  return { -a[0], -a[1], -a[2] };
}

inline Vector3 moment(const Vector3& arm, const Vector3& force)
{
  return { arm[1] * force[2] - arm[2] * force[1], arm[2] * force[0] - arm[0] * force[2],
    arm[0] * force[1] - arm[1] * force[0] };
}

inline void add_end(PlainSums& to, const Vector3& arm, const Vector3& normal, const Vector3& force,
  const Vector3& torque)
{
  constexpr std::array<std::array<std::size_t, 2>, 6> axes = { { { 0, 0 }, { 1, 1 }, { 2, 2 },
    { 0, 1 }, { 0, 2 }, { 1, 2 } } };
  const double length =
    std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  ++to.coordination;
  to.normals += length > 0 ? 1 : 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    to.force[axis].add(force[axis]);
    to.torque[axis].add(torque[axis]);
  }
  for (std::size_t n = 0; n < 6; ++n)
  {
    const auto [a, b] = axes[n];
    to.stress[n].add(arm[a] * force[b]);
    if (length > 0)
    {
      to.fabric[n].add(normal[a] / length * (normal[b] / length));
    }
  }
}

/// The sums of all particles, each rounded once.
inline std::vector<Sums> plain_sums(const Scene& scene, LeverArm lever = LeverArm::ContactPoint)
{
  std::map<Id, std::size_t> particle_of; // the first that is no ghost
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
  {
    if (scene.particles[i].ghost == 0)
    {
      particle_of.emplace(scene.particles[i].id, i);
    }
  }
  std::vector<PlainSums> sums(scene.particles.size());
  const bool use_point = scene.known.point && lever == LeverArm::ContactPoint;
  for (const Touch& touch : scene.pairs)
  {
    const auto first = particle_of.find(touch.id1);
    const auto second = particle_of.find(touch.id2);
    const bool line =
      scene.known.ends || (first != particle_of.end() && second != particle_of.end());
    const Vector3 branch = line ? minus(touch.to, touch.from) : Vector3{};
    double part = 0.5;
    if (lever == LeverArm::ContactPoint && first != particle_of.end() &&
      second != particle_of.end())
    {
      const double radius = scene.particles[first->second].radius;
      part = radius / (radius + scene.particles[second->second].radius);
    }
    const auto share = [&](double of) {
      return Vector3{ of * branch[0], of * branch[1], of * branch[2] };
    };
    if (first != particle_of.end())
    {
      const Vector3 arm =
        use_point && line ? seen_from(touch.from, touch.point, scene) : share(part);
      add_end(sums[first->second], arm, branch, touch.force,
        scene.known.torque && line ? touch.torque : moment(arm, touch.force));
    }
    if (second != particle_of.end())
    {
      const Vector3 arm =
        use_point && line ? seen_from(touch.to, touch.point, scene) : share(part - 1);
      const Vector3 force = turned_round(touch.force);
      add_end(sums[second->second], arm, branch, force,
        scene.known.torque && line ? minus(moment(branch, touch.force), touch.torque)
                                   : moment(arm, force));
    }
  }
  for (const Touch& touch : scene.walls)
  {
    const bool point =
      use_point || !scene.known.ends; // without lines nothing else says where it is
    const Vector3 arm =
      point ? seen_from(touch.to, touch.point, scene) : minus(touch.from, touch.to);
    const auto particle = particle_of.find(touch.id2);
    if (particle != particle_of.end())
    {
      const Vector3 normal = scene.known.ends ? minus(touch.from, touch.to) : arm;
      add_end(sums[particle->second], arm, normal, touch.force,
        scene.known.torque ? touch.torque : moment(arm, touch.force));
    }
  }
  std::vector<Sums> rounded(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    const auto round = [](const auto& from, auto& to, int divisor)
    {
      for (std::size_t n = 0; n < from.size(); ++n)
      {
        to[n] = from[n].value() / divisor;
      }
    };
    rounded[i].coordination = sums[i].coordination;
    round(sums[i].force, rounded[i].force, 1);
    round(sums[i].torque, rounded[i].torque, 1);
    round(sums[i].fabric, rounded[i].fabric, std::max(sums[i].normals, 1));
    round(sums[i].stress, rounded[i].stress, 1);
  }
  return rounded;
}

/// A request of what plain_sums makes.
inline ContactSumsRequest plain_request(LeverArm lever = LeverArm::ContactPoint, int threads = 1)
{
  ContactSumsRequest request;
  request.options.arm = lever;
  request.threads = threads;
  return request;
}
}
#endif
