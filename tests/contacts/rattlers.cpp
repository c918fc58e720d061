// SPDX-License-Identifier: BSD-3-Clause
// Rattlers: particles with too few contacts, and those that have too few without them, held against a plain removal.
#include "plain_sums.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

using made::Found;
using made::Id;
using made::Particle;
using made::Scene;
using made::Touch;

namespace
{
/// A particle or a wall that is not there: it never goes.
constexpr std::size_t nobody = ~std::size_t{ 0 };

struct Expected
{
  std::vector<int> rattlers;
  std::vector<int> backbone;
};

/// Takes away one particle with too few contacts after the other, and counts anew each time.
Expected removed(const Scene& scene, int least, double least_force)
{
  std::map<Id, std::size_t> place_of;
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
  {
    place_of.emplace(scene.particles[i].id, i);
  }
  const auto place = [&](Id id)
  {
    const auto found = place_of.find(id);
    return found == place_of.end() ? nobody : found->second;
  };
  std::vector<std::array<std::size_t, 2>> contacts;
  for (const Touch& touch : scene.pairs)
  {
    if (std::abs(touch.force[0]) >= least_force)
    {
      contacts.push_back({ place(touch.id1), place(touch.id2) });
    }
  }
  for (const Touch& touch : scene.walls)
  {
    if (std::abs(touch.force[0]) >= least_force)
    {
      contacts.push_back({ nobody, place(touch.id2) });
    }
  }
  Expected expected;
  expected.rattlers.assign(scene.particles.size(), 0);
  while (true)
  {
    expected.backbone.assign(scene.particles.size(), 0);
    const auto stays = [&](std::size_t i) { return i == nobody || expected.rattlers[i] == 0; };
    for (const auto& [a, b] : contacts)
    {
      for (const std::size_t end : { a, b })
      {
        if (end != nobody && stays(a) && stays(b))
        {
          ++expected.backbone[end];
        }
      }
    }
    std::size_t next = 0;
    while (next < scene.particles.size() && (!stays(next) || expected.backbone[next] >= least))
    {
      ++next;
    }
    if (next == scene.particles.size())
    {
      return expected;
    }
    expected.rattlers[next] = 1;
  }
}

Scene random_scene(std::size_t particles, std::size_t pairs, std::size_t walls, unsigned seed)
{
  std::mt19937_64 random(seed);
  Scene scene;
  for (std::size_t i = 0; i < particles; ++i)
  {
    scene.particles.push_back({ static_cast<Id>(3 * i) - 50, {}, 1 });
  }
  // some are not there, some touch themselves, and some touch twice
  const auto any = [&] { return static_cast<Id>(3 * (random() % (particles + 2))) - 50; };
  const auto force = [&] { return made::Vector3{ static_cast<double>(random() % 8), 0, 0 }; };
  for (std::size_t i = 0; i < pairs; ++i)
  {
    scene.pairs.push_back({ any(), any(), {}, { 1, 0, 0 }, force() });
  }
  for (std::size_t i = 0; i < walls; ++i)
  {
    scene.walls.push_back({ 0, any(), {}, { 1, 0, 0 }, force() });
  }
  return scene;
}

void expect_same(const Found& found, const Expected& expected)
{
  std::int64_t rattling = 0;
  std::int64_t bearing = 0;
  int different = 0;
  for (std::size_t i = 0; i < found.particles.size(); ++i)
  {
    different += found.particles[i].rattler != expected.rattlers[i] ? 1 : 0;
    different += found.particles[i].backbone != expected.backbone[i] ? 1 : 0;
    rattling += expected.rattlers[i];
    bearing += expected.backbone[i];
  }
  EXPECT_EQ(different, 0);
  EXPECT_EQ(found.counts[2], rattling);
  EXPECT_EQ(found.counts[3], bearing);
}

made::ContactSumsRequest request_for(int least, double least_force = 0)
{
  made::ContactSumsRequest request;
  request.least_contacts = least;
  request.options.least_force = least_force;
  return request;
}
}

TEST(Rattlers, RandomContacts)
{
  unsigned seed = 0;
  int some = 0; // where neither all nor none are rattlers
  for (const std::size_t pairs : { 0U, 30U, 60U, 90U, 120U, 200U })
  {
    for (const int least : { 1, 2, 3, 4, 7 })
    {
      const Scene scene = random_scene(60, pairs, pairs / 10, ++seed);
      const Expected expected = removed(scene, least, 0);
      expect_same(sum_all(scene, request_for(least)), expected);
      const auto rattling = std::ranges::count(expected.rattlers, 1);
      some += rattling > 0 && rattling < 60 ? 1 : 0;
      for (const int ranks : { 2, 3, 5 })
      {
        expect_same(
          sum_spread(scene, ranks, made::anywhere, made::in_turn, request_for(least)), expected);
      }
      expect_same(
        sum_spread(scene, 3, made::on_first, made::on_last, request_for(least)), expected);
    }
  }
  EXPECT_GT(some, 5);
}

/// Contacts that do not count bear nothing.
TEST(Rattlers, LeastForce)
{
  for (unsigned seed = 50; seed < 60; ++seed)
  {
    const Scene scene = random_scene(60, 160, 20, seed);
    expect_same(sum_all(scene, request_for(3, 2)), removed(scene, 3, 2));
    expect_same(
      sum_spread(scene, 2, made::in_turn, made::anywhere, request_for(3, 2)), removed(scene, 3, 2));
  }
}

/// By hand: a square whose corners have a tail, a chain between two walls, and a chain with a free end.
TEST(Rattlers, ByHand)
{
  Scene scene;
  for (Id id = 0; id < 15; ++id)
  {
    scene.particles.push_back({ id, {}, 1 });
  }
  const auto join = [&](Id a, Id b) { scene.pairs.push_back({ a, b, {}, { 1, 0, 0 } }); };
  const auto fix = [&](Id a) { scene.walls.push_back({ 0, a, {}, { 1, 0, 0 } }); };
  for (Id id = 0; id < 4; ++id)
  {
    join(id, (id + 1) % 4);
  }
  join(0, 4);
  join(4, 5); // the tail
  fix(6);
  join(6, 7);
  join(7, 8);
  fix(8);
  fix(9);
  join(9, 10);
  join(10, 11);
  fix(12); // on the floor, and nothing else
  fix(13);
  fix(13); // in a corner; 14 touches nothing
  const Found found = sum_all(scene, request_for(2));
  const std::vector<int> rattlers = { 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 1, 0, 1 };
  const std::vector<int> backbone = { 2, 2, 2, 2, 0, 0, 2, 2, 2, 0, 0, 0, 0, 2, 0 };
  for (std::size_t i = 0; i < 15; ++i)
  {
    EXPECT_EQ(found.particles[i].rattler, rattlers[i]) << i;
    EXPECT_EQ(found.particles[i].backbone, backbone[i]) << i;
  }
  EXPECT_EQ(found.particles[0].coordination, 3);
  EXPECT_EQ(found.counts, (std::array<std::int64_t, 7>{ 15, 26, 7, 16, 0, 0, 0 }));
}

/// Ghosts are no particles of their own.
TEST(Rattlers, Ghosts)
{
  Scene scene = random_scene(40, 70, 5, 7);
  const Expected expected = removed(scene, 3, 0);
  const std::size_t own = scene.particles.size();
  for (std::size_t i = 0; i < own; i += 2)
  {
    Particle ghost = scene.particles[i];
    ghost.ghost = 1;
    scene.particles.push_back(ghost);
  }
  for (const int ranks : { 1, 3 })
  {
    Found found = sum_spread(scene, ranks, made::anywhere, made::anywhere, request_for(3));
    found.particles.resize(own);
    expect_same(found, expected);
  }
}
