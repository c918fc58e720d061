// SPDX-License-Identifier: BSD-3-Clause
// Contacts and particles that are odd, missing or wrong.
#include "../support/hard_case.h"
#include "plain_sums.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using made::count_different;
using made::everything;
using made::Found;
using made::Id;
using made::infinity;
using made::no_number;
using made::Scene;
using made::Six;
using made::sum_all;
using made::Sums;
using made::Vector3;

namespace
{
using Counts =
  std::array<std::int64_t, 7>; // particles, contacts, rattling, bearing, missing, broken, repeated

/// Two particles along x, of which the second is `id`.
Scene two(Id id = 2)
{
  Scene scene;
  scene.particles = { { 1, { 0, 0, 0 }, 1 }, { id, { 2, 0, 0 }, 1 } };
  scene.pairs = { { 1, id, { 0, 0, 0 }, { 2, 0, 0 }, { -4, 1, 0 } } };
  return scene;
}
}

TEST(Edges, NothingAtAll)
{
  const Found found = sum_all({});
  EXPECT_EQ(found.counts, Counts{});
  // particles without contacts
  Scene scene = two();
  scene.pairs.clear();
  const Found lonely = sum_all(scene);
  EXPECT_EQ(count_different(lonely.particles, { { .rattler = 1 }, { .rattler = 1 } }), 0);
  EXPECT_EQ(lonely.counts, (Counts{ 2, 0, 2, 0, 0, 0, 0 }));
  // contacts without particles
  scene = two();
  scene.particles.clear();
  EXPECT_EQ(sum_all(scene).counts, (Counts{ 0, 0, 0, 0, 1, 0, 0 }));
}

/// The other one gets its part, and without a line the force alone.
TEST(Edges, MissingParticles)
{
  for (const std::size_t missing : { 0U, 1U })
  {
    Scene scene = two();
    scene.particles.erase(scene.particles.begin() + static_cast<std::ptrdiff_t>(missing));
    Found found = sum_all(scene);
    const double sign = missing == 0 ? -1 : 1;
    EXPECT_EQ(found.counts, (Counts{ 1, 1, 1, 0, 1, 0, 0 }));
    EXPECT_EQ(found.particles[0].coordination, 1);
    EXPECT_EQ(found.particles[0].force, (Vector3{ -4 * sign, sign, 0 }));
    EXPECT_EQ(found.particles[0].stress, (Six{ -4, 0, 0, 1, 0, 0 })); // half the line
    EXPECT_EQ(found.friction[0], (std::vector<double>{ 0.25 }));
    scene.known.ends = false;
    scene.known.torque = true;
    found = sum_all(scene);
    const Sums alone = { .coordination = 1, .force = { -4 * sign, sign, 0 }, .rattler = 1 };
    EXPECT_EQ(count_different(found.particles, { alone }), 0);
    EXPECT_EQ(found.counts, (Counts{ 1, 1, 1, 0, 1, 0, 0 }));
    EXPECT_TRUE(std::isnan(found.friction[0][0]));
  }
  // of a wall
  Scene scene = two();
  scene.pairs.clear();
  scene.walls = { { 0, 9, { 0, 0, -1 }, {}, { 0, 0, 1 } },
    { 0, 1, { 0, 0, -1 }, {}, { 0, 0, 1 } } };
  const Found found = sum_all(scene);
  EXPECT_EQ(found.counts, (Counts{ 2, 1, 2, 0, 1, 0, 0 }));
  EXPECT_EQ(found.particles[0].force, (Vector3{ 0, 0, 1 }));
}

/// Nobody knows how far a particle that is not there overlaps with the other one: the contact counts.
TEST(Edges, OverlapWithMissingParticles)
{
  Scene scene = two();
  made::ContactSumsRequest request = everything();
  request.options.least_overlap = 1e9;
  EXPECT_EQ(sum_all(scene, request).particles[0].coordination, 0);
  scene.particles.pop_back();
  for (const bool ends : { true, false })
  {
    scene.known.ends = ends;
    EXPECT_EQ(sum_all(scene, request).particles[0].coordination, 1);
  }
}

/// Lines that readers leave as they are written go through the box; those that they draw end where doubles are far apart.
TEST(Edges, LinesAcrossPeriodicFaces)
{
  Scene scene = two();
  scene.box = made::periodic_box({ 0, 0, 0 }, { 5, 5, 5 });
  scene.particles[0].x = { 0.25, 0, 0 };
  scene.particles[1].x = { 4.5, 0, 0 };
  scene.pairs[0].from = scene.particles[0].x;
  scene.pairs[0].force = { 1, 0.5, 0 };
  for (const double drawn : { 4.5, -0.5, 9.5 })
  {
    scene.pairs[0].to = { drawn, 0, 0 };
    for (const Sums& particle : sum_all(scene).particles)
    {
      EXPECT_EQ(
        particle.stress, (Six{ -0.375, 0, 0, -0.1875, 0, 0 })); // half of -0.75 by the force
      EXPECT_EQ(particle.fabric, (Six{ 1, 0, 0, 0, 0, 0 }));
    }
    for (const std::size_t missing : { 0U, 1U }) // the line and the box tell the same
    {
      Scene one = scene;
      one.particles.erase(one.particles.begin() + static_cast<std::ptrdiff_t>(missing));
      EXPECT_EQ(sum_all(one).particles[0].stress, (Six{ -0.375, 0, 0, -0.1875, 0, 0 }));
    }
  }
  // a drawn end at 10^6 has ten digits behind the point
  scene.box = made::periodic_box({ 0, 0, 0 }, { 1e6, 5, 5 });
  scene.particles[0].x[0] = 1e6 - 1e-3;
  scene.particles[1].x[0] = 1e-3;
  scene.pairs[0].from = scene.particles[0].x;
  scene.pairs[0].to = { 1e-3 + 1e6, 0, 0 };
  const double branch = (1e6 - scene.particles[0].x[0]) + 1e-3; // the difference is exact
  EXPECT_NE(branch, scene.pairs[0].to[0] - scene.pairs[0].from[0]);
  EXPECT_EQ(sum_all(scene).particles[0].stress, (Six{ branch / 2, 0, 0, branch / 4, 0, 0 }));
  // with a wall, whose place is written on the other side
  scene.pairs.clear();
  scene.walls = { { 0, 1, { 0, 0, 0 }, scene.particles[0].x, { -1, 0, 0 } } };
  EXPECT_EQ(sum_all(scene).particles[0].stress[0], scene.particles[0].x[0] - 1e6);
}

/// The normal of a contact with a wall is that of its line, wherever the force acts.
TEST(Edges, NormalsOfWalls)
{
  Scene scene = two();
  scene.pairs.clear();
  made::Touch touch = { 0, 1, { 0, 0, -1 }, {}, { 0, 0, 1 } };
  touch.point = { 0.6, 0, -0.8 };
  scene.walls = { touch };
  for (const bool point : { false, true })
  {
    scene.known.point = point;
    EXPECT_EQ(sum_all(scene).particles[0].fabric, (Six{ 0, 0, 1, 0, 0, 0 }));
  }
}

/// A number that is none, infinite or too large leaves the row out, and is counted; the rest is as without the row.
TEST(Edges, BrokenRows)
{
  HardCase hard("sums",
    "contacts: rows with nan, infinities or numbers from 2^290 on in any array: sums that are not "
    "as without the rows",
    "particles", 0);
  made::SceneForm form;
  form.known = { true, true, true, true, true, true };
  form.powers = 3;
  const Scene scene = make_scene(form, 1);
  const Found whole = sum_all(scene);
  EXPECT_EQ(whole.counts[5], 0);
  using Member = double& (*)(made::Touch&);
  constexpr std::array<Member, 7> members = { [](made::Touch& touch) -> double&
    { return touch.from[1]; },
    [](made::Touch& touch) -> double& { return touch.to[2]; },
    [](made::Touch& touch) -> double& { return touch.force[0]; },
    [](made::Touch& touch) -> double& { return touch.tangential[2]; },
    [](made::Touch& touch) -> double& { return touch.torque[1]; },
    [](made::Touch& touch) -> double& { return touch.point[0]; },
    [](made::Touch& touch) -> double& { return touch.overlap; } };
  for (const double wrong : { no_number, infinity, -infinity, 0x1p290, -0x1p290, 1e308 })
  {
    for (const Member member : members)
    {
      for (const bool walls : { false, true })
      {
        Scene broken = scene;
        std::vector<made::Touch>& rows = walls ? broken.walls : broken.pairs;
        for (std::size_t i = 0; i < 50; i += 10)
        {
          rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(i), rows[i + 1]);
          member(rows[i]) = wrong;
        }
        const Found found = sum_all(broken);
        hard.add(count_different(found.particles, whole.particles), std::ssize(scene.particles));
        Counts counts = whole.counts;
        counts[5] = 5;
        EXPECT_EQ(found.counts, counts);
        EXPECT_TRUE(std::isnan(found.friction[walls ? 1 : 0][10]));
        EXPECT_FALSE(std::isnan(found.friction[walls ? 1 : 0][9]));
      }
    }
  }
}

/// The largest numbers that are not left out, and the smallest.
TEST(Edges, LargestAndSmallestNumbers)
{
  const double large = std::nextafter(0x1p290, 0);
  for (const double number : { large, 0x1p-1074, 0x1p-500 })
  {
    Scene scene = two();
    scene.known.torque = true;
    scene.pairs[0].from = { -number, number, -number };
    scene.pairs[0].to = { number, number, -number };
    scene.pairs[0].force = { -number, number, 0 };
    scene.pairs[0].torque = { number, -number, number };
    for (int i = 0; i < 3; ++i)
    {
      scene.pairs.push_back(scene.pairs[0]);
    }
    const Found found = sum_all(scene);
    EXPECT_EQ(found.counts[5], 0);
    EXPECT_EQ(found.particles[0].force, (Vector3{ -4 * number, 4 * number, 0 }));
    EXPECT_EQ(found.particles[0].torque, (Vector3{ 4 * number, -4 * number, 4 * number }));
    EXPECT_EQ(found.particles[0].stress[0], -4 * number * number);
    EXPECT_EQ(found.particles[0].fabric, (Six{ 1, 0, 0, 0, 0, 0 }));
    EXPECT_EQ(found.particles[1].torque[2], 4 * (2 * number * number - number));
  }
}

/// Particles that are nowhere, or of no radius: what is not finite does not stay in memory, however many contacts there are.
TEST(Edges, ParticlesWithoutPlaceOrRadius)
{
  for (const double wrong : { no_number, infinity, -infinity, 1e300 })
  {
    for (const bool place : { true, false })
    {
      Scene scene;
      scene.known.ends = false;
      for (int i = 0; i < 40; ++i)
      {
        scene.particles.push_back({ i, { 2. * i, 0, 0 }, 1 });
      }
      (place ? scene.particles[0].x[0] : scene.particles[0].radius) = wrong;
      for (int i = 0; i < 11400; ++i)
      {
        scene.pairs.push_back({ 0, 1 + i % 2, {}, {}, { 1e80, 0, 0 } });
        scene.pairs.push_back({ i % 38 + 1, i % 38 + 2, {}, {}, { 1, 0, 0 } });
      }
      const Found found = sum_all(scene);
      EXPECT_EQ(found.counts[5], 11400) << wrong << ' ' << place;
      EXPECT_EQ(found.particles[0].coordination, 0);
      for (std::size_t i = 2; i < 39; ++i)
      {
        EXPECT_EQ(found.particles[i].force, Vector3{});
        EXPECT_TRUE(std::isfinite(found.particles[i].stress[0])) << i;
      }
    }
  }
}

/// A particle that touches its own image: both ends are its own.
TEST(Edges, ContactWithItself)
{
  Scene scene;
  scene.box = made::periodic_box({ 0, 0, 0 }, { 2, 2, 2 });
  scene.particles = { { 3, { 1, 1, 1 }, 1 } };
  scene.pairs = { { 3, 3, { 1, 1, 1 }, { 3, 1, 1 }, { -5, 0.5, 0 } } };
  Found found = sum_all(scene);
  EXPECT_EQ(found.particles[0].coordination, 2);
  EXPECT_EQ(found.particles[0].backbone, 2);
  EXPECT_EQ(found.particles[0].force, Vector3{});
  EXPECT_EQ(found.particles[0].stress, (Six{ -10, 0, 0, 1, 0, 0 })); // branch times force
  EXPECT_EQ(found.particles[0].torque, (Vector3{ 0, 0, 1 }));
  EXPECT_EQ(found.particles[0].fabric, (Six{ 1, 0, 0, 0, 0, 0 }));
  made::ContactSumsRequest request = everything();
  request.least_contacts = 3;
  EXPECT_EQ(sum_all(scene, request).particles[0].rattler, 1);
  // rows alone do not say through which face
  scene.known.ends = false;
  found = sum_all(scene);
  EXPECT_EQ(found.particles[0].stress, Six{});
  EXPECT_EQ(found.particles[0].fabric, Six{});
  EXPECT_EQ(found.particles[0].coordination, 2);
}

/// Ends at one place: no normal, no stress; forces and the count are as ever, and the fabric is that of the others.
TEST(Edges, LinesWithoutLength)
{
  Scene scene = two();
  scene.pairs.push_back(scene.pairs[0]);
  scene.pairs[1].to = scene.pairs[1].from;
  const Found found = sum_all(scene);
  EXPECT_EQ(found.particles[0].coordination, 2);
  EXPECT_EQ(found.particles[0].force, (Vector3{ -8, 2, 0 }));
  EXPECT_EQ(found.particles[0].stress, (Six{ -4, 0, 0, 1, 0, 0 }));
  EXPECT_EQ(found.particles[0].fabric, (Six{ 1, 0, 0, 0, 0, 0 }));
  EXPECT_EQ(found.friction[0][1], infinity); // all of the force is across
  scene.pairs.erase(scene.pairs.begin());
  EXPECT_EQ(sum_all(scene).particles[0].fabric, Six{});
  EXPECT_EQ(sum_all(scene).particles[0].coordination, 1);
  scene.pairs[0].force = {};
  EXPECT_EQ(sum_all(scene).friction[0][0], 0);
}

TEST(Edges, AnyIds)
{
  for (const Id id : { Id{ 0 }, Id{ -1 }, std::numeric_limits<Id>::min(),
         std::numeric_limits<Id>::max(), (Id{ 1 } << 53) + 1, Id{ 1 } << 40 })
  {
    Scene scene = two(id);
    scene.particles.push_back({ id == 0 ? 5 : id - (id > 0 ? 1 : -1), { 9, 9, 9 }, 1 });
    const Found found = sum_all(scene);
    EXPECT_EQ(found.particles[1].force, (Vector3{ 4, -1, 0 })) << id;
    EXPECT_EQ(found.particles[2].coordination, 0) << id;
    EXPECT_EQ(found.counts[4], 0) << id;
  }
}

/// Contacts go to the first of those with an id.
TEST(Edges, RepeatedIds)
{
  Scene scene = two();
  scene.particles.push_back(scene.particles[0]);
  scene.particles.push_back(scene.particles[1]);
  scene.particles.push_back(scene.particles[1]);
  const Found found = sum_all(scene);
  EXPECT_EQ(found.counts[6], 3);
  EXPECT_EQ(found.counts[0], 5);
  EXPECT_EQ(
    count_different({ found.particles[0], found.particles[1] }, sum_all(two()).particles), 0);
  EXPECT_EQ(count_different(
              { found.particles[2], found.particles[4] }, { { .rattler = 1 }, { .rattler = 1 } }),
    0);
}

TEST(Edges, MobilisedFriction)
{
  Scene scene = two();
  scene.known.tangential = true;
  scene.pairs[0].tangential = { 3, 4, 0 }; // as the program has it, which is not across the line
  scene.pairs[0].force = { 3 - 10, 4, 0 };
  EXPECT_EQ(sum_all(scene).friction[0][0], 0.5);
  scene.pairs[0].tangential = {};
  EXPECT_EQ(sum_all(scene).friction[0][0], 0);
  scene.pairs[0].tangential = scene.pairs[0].force;
  EXPECT_EQ(sum_all(scene).friction[0][0], infinity);
  scene.pairs[0].force = scene.pairs[0].tangential = {};
  EXPECT_EQ(sum_all(scene).friction[0][0], 0);
}

/// Spans of another size than the rows need.
TEST(Edges, RowsThatDoNotFit)
{
  const Scene scene = two();
  const made::Frame frame(scene.particles, scene);
  const made::Rows rows(scene.pairs, { true, true, true, true, true, true }, false);
  const auto error = [&](const std::vector<made::ContactRows>& inputs)
  {
    granular::SerialCommunicator alone;
    granular::Progress progress;
    return error_of([&] { granular::sum_contacts(frame.view(), inputs, {}, alone, progress); });
  };
  made::ContactRows short_one = rows.view();
  short_one.force = short_one.force.first(2);
  EXPECT_EQ(error({ short_one }), "expected 3 values a contact in 'force', got 2 for 1 contacts");
  short_one = rows.view();
  short_one.ends = short_one.ends.first(3);
  EXPECT_EQ(error({ short_one }), "expected 6 values a contact in 'ends', got 3 for 1 contacts");
  short_one = rows.view();
  short_one.id2 = {};
  EXPECT_EQ(error({ short_one }), "expected an id2 of each contact, got 0 for 1 contacts");
  EXPECT_EQ(error({ rows.view(), rows.view() }), "");
  EXPECT_EQ(error({}), "");
}
