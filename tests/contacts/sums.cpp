// SPDX-License-Identifier: BSD-3-Clause
// Sums over contacts, bit for bit those of large integers, which are rounded once.
#include "../support/hard_case.h"
#include "plain_sums.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

using made::count_different;
using made::Known;
using made::LeverArm;
using made::make_scene;
using made::plain_request;
using made::plain_sums;
using made::Scene;
using made::SceneForm;
using made::Sums;
using made::Touch;

namespace
{
/// All kinds of contacts.
std::vector<Known> all_kinds()
{
  std::vector<Known> kinds;
  for (int bits = 0; bits < 8; ++bits)
  {
    Known known;
    known.ends = (bits & 1) != 0;
    known.torque = (bits & 2) != 0;
    known.point = (bits & 4) != 0 || !known.ends; // or else walls have no place
    kinds.push_back(known);
  }
  return kinds;
}

/// Each row the other way round.
Scene swapped(Scene scene)
{
  for (Touch& touch : scene.pairs)
  {
    const Touch old = touch;
    touch.id1 = old.id2;
    touch.id2 = old.id1;
    touch.from = old.to;
    touch.to = old.from;
    touch.force = made::turned_round(old.force);
  }
  return scene;
}
}

TEST(ContactSums, RandomScenes)
{
  HardCase hard("sums",
    "contacts: force, torque, fabric and stress of particles, forces of up to 170 orders of "
    "magnitude, pairs and walls, "
    "lines and rows across periodic faces, missing particles, ghosts, ids of 64 bits: other bits "
    "than exact sums rounded once",
    "particles", 0);
  unsigned seed = 0;
  for (const Known& known : all_kinds())
  {
    for (const LeverArm lever : { LeverArm::ContactPoint, LeverArm::Half })
    {
      for (const int powers : { 0, 4, 285 })
      {
        SceneForm form;
        form.known = known;
        form.powers = powers;
        form.far_ids = seed % 2 == 0;
        form.ghosts = seed % 3 == 0;
        form.missing = seed % 4 < 2;
        form.cancel = seed % 5 == 0;
        const Scene scene = make_scene(form, ++seed);
        const made::Found found = sum_all(scene, plain_request(lever));
        hard.add(
          count_different(found.particles, plain_sums(scene, lever)), std::ssize(scene.particles));
      }
    }
  }
}

TEST(ContactSums, AnyOrderOfRowsAndParticles)
{
  std::mt19937_64 random(3);
  for (const Known& known : all_kinds())
  {
    SceneForm form;
    form.known = known;
    form.cancel = known.torque;
    const Scene scene = make_scene(form, 17);
    const std::vector<Sums> expected = sum_all(scene).particles;
    Scene other = scene;
    std::ranges::shuffle(other.pairs, random);
    std::ranges::reverse(other.walls);
    EXPECT_EQ(count_different(sum_all(other).particles, expected), 0);
    std::ranges::reverse(other.particles);
    std::vector<Sums> reversed = sum_all(other).particles;
    std::ranges::reverse(reversed);
    EXPECT_EQ(count_different(reversed, expected), 0);
  }
}

/// Which end is the first is a matter of the program that wrote the file.
TEST(ContactSums, SwappedEnds)
{
  for (const Known& known : all_kinds())
  {
    SceneForm form;
    form.known = known;
    form.known.torque = false; // or else the rows name that on the first
    const Scene scene = make_scene(form, 18);
    EXPECT_EQ(count_different(sum_all(swapped(scene)).particles, sum_all(scene).particles), 0);
  }
}

TEST(ContactSums, AnyNumberOfThreadsAndMemory)
{
  SceneForm form;
  form.particles = 5000; // several blocks
  form.pairs = 80000;    // and stretches
  form.walls = 3000;
  for (const bool ends : { true, false })
  {
    form.known.ends = ends;
    form.known.point = !ends;
    const Scene scene = make_scene(form, 19);
    made::ContactSumsRequest request = made::everything();
    const made::Found expected = sum_all(scene, request);
    EXPECT_EQ(count_different(sum_all(scene, plain_request()).particles, plain_sums(scene)), 0);
    for (const auto& [threads, memory] :
      { std::pair{ 2, request.memory }, { 3, 500'000 }, { 4, 1'000'000 }, { 1, 0 } })
    {
      request.threads = threads;
      request.memory = memory;
      const made::Found found = sum_all(scene, request);
      EXPECT_EQ(count_different(found.particles, expected.particles), 0)
        << threads << ", " << memory;
      EXPECT_EQ(found.friction, expected.friction);
      EXPECT_EQ(found.counts, expected.counts);
    }
  }
}

TEST(ContactSums, AMillionContactsOfOneParticle)
{
  HardCase hard("sums",
    "contacts: one particle with 10^6 contacts, whose forces cancel exactly, or to 1e-12 of all of "
    "them: other "
    "bits than exact sums",
    "particles", 0);
  SceneForm form;
  form.particles = 40;
  form.pairs = 500000;
  form.walls = 0;
  form.powers = 3;
  form.cancel = true;
  Scene scene = make_scene(form, 21);
  for (Touch& touch : scene.pairs)
  {
    touch.id1 = scene.particles[0].id;
    const made::Vector3 branch = made::seen_from(scene.particles[0].x, touch.to, scene);
    touch.from = made::minus(touch.to, branch);
  }
  scene.pairs[777].force[0] += 0x1p-20;
  const made::Found found = sum_all(scene, plain_request(LeverArm::ContactPoint, 2));
  EXPECT_GE(found.particles[0].coordination, 1000000);
  EXPECT_EQ(found.particles[0].force[0], 0x1p-20);
  EXPECT_EQ(found.particles[0].force[1], 0);
  EXPECT_EQ(found.particles[0].force[2], 0);
  hard.add(count_different(found.particles, plain_sums(scene)), 40);
}
