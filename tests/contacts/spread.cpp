// SPDX-License-Identifier: BSD-3-Clause
// Particles and contacts on any ranks: the bits of one rank. Ranks are threads.
#include "../support/hard_case.h"
#include "plain_sums.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using made::bits_of;
using made::count_different;
using made::everything;
using made::Found;
using made::Id;
using made::make_scene;
using made::Place;
using made::Scene;
using made::SceneForm;
using made::sum_all;
using made::sum_spread;
using made::Sums;

namespace
{
constexpr std::array sizes = { 1, 2, 3, 5 };

/// Which rank has a particle, and which a contact.
std::vector<std::array<Place, 2>> places()
{
  using namespace made;
  return { { anywhere, in_turn }, { in_turn, anywhere }, { on_first, on_last },
    { on_last, on_first }, { on_first, anywhere }, { anywhere, on_last },
    // the last rank has nothing at all
    { [](std::size_t i, int ranks) { return in_turn(i, std::max(ranks - 1, 1)); },
      [](std::size_t i, int ranks) { return anywhere(i, std::max(ranks - 1, 1)); } } };
}

/// nan is nan.
std::vector<std::uint64_t> bits_of_all(const std::vector<double>& values)
{
  std::vector<std::uint64_t> bits;
  for (const double value : values)
  {
    bits.push_back(std::bit_cast<std::uint64_t>(value));
  }
  return bits;
}

/// Returns how many particles have other bits on so many ranks, and expects the rest to be the same.
int count_on_ranks(const Scene& scene, const Found& expected, int size,
  const std::array<Place, 2>& place, const made::ContactSumsRequest& request)
{
  const Found found = sum_spread(scene, size, place[0], place[1], request);
  EXPECT_EQ(found.counts, expected.counts) << size;
  for (std::size_t input = 0; input < 2; ++input)
  {
    EXPECT_EQ(bits_of_all(found.friction[input]), bits_of_all(expected.friction[input])) << size;
  }
  return count_different(found.particles, expected.particles);
}
}

TEST(Spread, RandomScenes)
{
  HardCase hard("sums",
    "contacts: 1, 2, 3 and 5 ranks, particles and contacts on any of them or on one, ghosts, "
    "missing particles and broken "
    "rows: other bits than on one rank",
    "particles", 0);
  unsigned seed = 100;
  for (const bool ends : { true, false })
  {
    for (const bool point : { true, false })
    {
      SceneForm form;
      form.known = { ends, true, point, point, point || !ends, point };
      form.far_ids = point;
      form.ghosts = ends;
      form.missing = true;
      form.cancel = point;
      Scene scene = make_scene(form, ++seed);
      for (std::size_t i = 0; i < scene.pairs.size(); i += 11)
      {
        scene.pairs[i].force[i % 3] = made::no_number;
      }
      scene.particles[3].x[1] = made::no_number;
      scene.particles[4].radius = made::infinity;
      made::ContactSumsRequest request = everything();
      request.least_contacts = 4;
      request.options.least_overlap = point ? 0.25 : 0;
      const Found expected = sum_all(scene, request);
      EXPECT_GT(expected.counts[4], 0);
      EXPECT_GT(expected.counts[5], 0);
      for (const std::array<Place, 2>& place : places())
      {
        for (const int size : sizes)
        {
          request.threads = 1 + size % 2;
          hard.add(
            count_on_ranks(scene, expected, size, place, request), std::ssize(scene.particles));
        }
      }
    }
  }
}

/// Of particles with one id the first of the lowest rank counts: those of stretches of rows are the same for any ranks.
TEST(Spread, RepeatedIds)
{
  SceneForm form;
  form.known.point = true;
  Scene scene = make_scene(form, 7);
  for (std::size_t i = 0; i < 30; ++i)
  {
    scene.particles[199 - i].id = scene.particles[2 * i].id;
  }
  const Found expected = sum_all(scene);
  EXPECT_EQ(expected.counts[6], 30);
  const std::size_t all = scene.particles.size();
  const Place stretches = [all](std::size_t i, int ranks)
  { return static_cast<int>(i * static_cast<std::size_t>(ranks) / all); };
  for (const int size : sizes)
  {
    EXPECT_EQ(
      count_on_ranks(scene, expected, size, { stretches, made::anywhere }, everything()), 0);
  }
}

TEST(Spread, NothingAnywhere)
{
  for (const int size : sizes)
  {
    EXPECT_EQ(sum_spread({}, size, made::on_first, made::on_first).counts, sum_all({}).counts);
    // one particle, one contact, each on the other side
    Scene scene;
    scene.particles = { { -7, { 1, 1, 1 }, 1 } };
    scene.walls = { { 0, -7, { 1, 1, 0 }, { 1, 1, 1 }, { 0, 0, 3 } } };
    const Found found = sum_spread(scene, size, made::on_first, made::on_last);
    EXPECT_EQ(count_different(found.particles, sum_all(scene).particles), 0);
    EXPECT_EQ(found.particles[0].force[2], 3);
  }
}

/// Many particles of a rank hear of one rattler after the other.
TEST(Spread, LongChains)
{
  Scene scene;
  for (int i = 0; i < 400; ++i)
  {
    scene.particles.push_back({ i, { 1. * i, 0, 0 }, 0.5 });
    if (i > 0)
    {
      scene.pairs.push_back({ i - 1, i, { i - 1., 0, 0 }, { 1. * i, 0, 0 }, { -1, 0, 0 } });
    }
  }
  const Found open = sum_all(scene);
  EXPECT_EQ(open.counts[2], 400);
  scene.pairs.push_back({ 399, 0, { 399, 0, 0 }, { 400, 0, 0 }, { -1, 0, 0 } });
  const Found ring = sum_all(scene);
  EXPECT_EQ(ring.counts[2], 0);
  for (const int size : { 2, 5 })
  {
    EXPECT_EQ(
      count_on_ranks(scene, ring, size, { made::anywhere, made::anywhere }, everything()), 0);
  }
  scene.pairs.pop_back();
  for (const int size : { 2, 5 })
  {
    EXPECT_EQ(
      count_on_ranks(scene, open, size, { made::anywhere, made::anywhere }, everything()), 0);
    EXPECT_EQ(count_on_ranks(scene, open, size, { made::in_turn, made::on_last }, everything()), 0);
  }
}

namespace
{
/// Runs two ranks whose contacts and particles have different arrays. Returns the text of both.
std::string error_of_both(const std::array<made::Known, 2>& known, const std::array<bool, 2>& radii,
  const made::ContactSumsRequest& request = {})
{
  const Scene scene = make_scene({}, 5);
  std::array<std::string, 2> errors;
  run_ranks(2,
    [&](granular::Communicator& ranks)
    {
      const auto rank = static_cast<std::size_t>(ranks.rank());
      Scene own = scene;
      own.known = known[rank];
      own.radii = radii[rank];
      Found found = empty_for(own);
      std::mutex lock;
      try
      {
        sum_part(own, request, made::in_turn, made::in_turn, ranks, found, &lock);
      }
      catch (const granular::Error& error)
      {
        errors[rank] = error.what();
      }
    });
  EXPECT_EQ(errors[0], errors[1]);
  return errors[0];
}
}

TEST(Spread, ArraysThatDiffer)
{
  using made::Known;
  const Known all = { true, true, true, true, true, true };
  EXPECT_EQ(error_of_both({ all, all }, { true, true }), "");
  EXPECT_EQ(error_of_both({ all, all }, { true, false }), ""); // the contact points are known
  const std::array<std::pair<bool Known::*, const char*>, 6> parts = { { { &Known::ends, "ends" },
    { &Known::force, "force" }, { &Known::tangential, "tangential" }, { &Known::torque, "torque" },
    { &Known::point, "contact_point" }, { &Known::overlap, "overlap" } } };
  for (const auto& [part, name] : parts)
  {
    Known some = all;
    some.*part = false;
    const std::string expected = "expected the same arrays of contacts on all processes, got '" +
      std::string(name) + "' on some";
    EXPECT_EQ(error_of_both({ all, some }, { true, true }), expected);
    EXPECT_EQ(error_of_both({ some, all }, { true, true }), expected);
  }
  EXPECT_EQ(error_of_both({ Known(), Known() }, { true, false }),
    "expected the same arrays on all processes, got some without an array 'radius' of radii");
  EXPECT_EQ(error_of_both({ Known(), Known() }, { false, false }), ""); // half the line
  made::ContactSumsRequest request;
  request.von_mises = true;
  const std::string error = error_of_both({ all, all }, { true, false }, request);
  EXPECT_EQ(error.find("expected an array 'radius' of the particles, whose volume"), 0U) << error;
}

/// A rank that is cancelled stops all of them, and none waits.
TEST(Spread, Cancelled)
{
  struct Stop : granular::Progress
  {
    bool report(double) override { return --left != 0; }
    int left = 0;
  };
  const Scene scene = make_scene({}, 6);
  for (int at = 1; at < 12; ++at)
  {
    std::atomic<int> cancelled = 0;
    std::atomic<int> reports = 0;
    run_ranks(3,
      [&](granular::Communicator& ranks)
      {
        const made::Frame frame(part_of(scene.particles, made::in_turn, ranks), scene);
        const made::Rows pairs(part_of(scene.pairs, made::anywhere, ranks), scene.known, false);
        const std::array<made::ContactRows, 1> inputs = { pairs.view() };
        Stop stop;
        stop.left = ranks.rank() == 1 ? at : -1;
        try
        {
          granular::sum_contacts(frame.view(), inputs, everything(), ranks, stop);
        }
        catch (const granular::Cancelled&)
        {
          ++cancelled;
        }
        reports += ranks.rank() == 1 ? -stop.left : 0;
      });
    EXPECT_TRUE(cancelled == 3 || (cancelled == 0 && reports < 0)) << at << ' ' << cancelled;
    EXPECT_TRUE(at > 3 || cancelled == 3) << at;
  }
}
