// SPDX-License-Identifier: BSD-3-Clause
// Averages of contacts: the same bits for any order of rows, threads and ranks; rows that are missing, broken or not there.
#include "made_rows.h"

#include "granular/common/error.h"

#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
/// Each particle and each contact on some rank, or all of them on one.
Scene part_of(const Scene& scene, const Communicator& ranks, unsigned seed)
{
  std::mt19937_64 random(seed);
  return part_of(scene,
    [&]
    {
      const std::uint64_t number = random();
      const auto size = static_cast<std::uint64_t>(ranks.size());
      const std::uint64_t of = seed % 2 == 0 ? number % size : seed / 2 % size;
      return of == static_cast<std::uint64_t>(ranks.rank());
    });
}

/// Cells that are a block, and several of them.
std::vector<EulerAverageRequest> some_requests()
{
  const EulerGrid few = { lo, hi, { 3, 4, 2 } };
  const EulerGrid many = { lo, hi, { 15, 20, 16 } }; // of 4096 at most in a block
  return { request_of_contacts(few, CellWeights::Overlap),
    request_of_contacts(many, CellWeights::Centre),
    request_of_contacts(few, CellWeights::Kernel, KernelShape::Lucy, 0.5, KernelBounds::Inside),
    request_of_contacts(many, CellWeights::Kernel, KernelShape::Gaussian, 0.08),
    request_of_contacts(many, CellWeights::Kernel, KernelShape::Heaviside, 0.1) };
}

Scene some_scene()
{
  Scene scene = random_scene(120, 150, 40, lo, hi, 1, 0.2);
  for (std::size_t i = 0; i < 20; ++i) // forces that cancel, but for what is much smaller
  {
    Touch back = scene.pairs[i];
    scene.pairs[i].force[0] *= 1e9;
    back.force[0] *= -1e9;
    scene.pairs.push_back(back);
  }
  scene.pairs[7].force[1] = not_a_number;
  scene.pairs[9].id1 = 100'000;
  return scene;
}
}

TEST(ContactRows, AnyOrderAndThreadsGiveTheSameBits)
{
  const Box box = make_box();
  for (const EulerAverageRequest& request : some_requests())
  {
    Scene scene = some_scene();
    const auto first = bits_of(average_contacts_of(scene, &box, request));
    std::mt19937_64 random(5);
    for (const int threads : { 1, 4 })
    {
      std::ranges::shuffle(scene.pairs, random);
      std::ranges::shuffle(scene.walls, random);
      Counted counted;
      EXPECT_EQ(bits_of(average_contacts_of(scene, &box, request, threads, &counted)), first);
      EXPECT_EQ(counted.broken, 1);
      EXPECT_EQ(counted.missing, 1);
    }
  }
}

TEST(ContactRows, AnyRanksGiveTheSameBits)
{
  const Box box = make_box();
  for (const EulerAverageRequest& request : some_requests())
  {
    const Scene scene = some_scene();
    const auto all = bits_of(average_contacts_of(scene, &box, request));
    for (const int size : { 1, 2, 3 })
    {
      const unsigned seed = size == 2 ? 3 : 0; // all on the second rank, or anywhere
      run_ranks(size,
        [&](Communicator& ranks)
        {
          EulerAverageRequest own = request;
          own.wanted.first = request.grid.size() * ranks.rank() / size;
          own.wanted.last = request.grid.size() * (ranks.rank() + 1) / size;
          const auto found =
            bits_of(average_contacts_of(part_of(scene, ranks, seed), &box, own, ranks));
          const std::vector<std::vector<std::uint64_t>> wanted(
            all.begin() + own.wanted.first, all.begin() + own.wanted.last);
          EXPECT_TRUE(found == wanted) << ranks.rank() << " of " << size << ", " << seed;
        });
    }
  }
}

TEST(ContactRows, ContactsOfAParticleThatIsMissingCountAsFarAsTheyAreKnown)
{
  const EulerAverageRequest request =
    request_of_contacts({ lo, hi, { 3, 4, 2 } }, CellWeights::Overlap);
  Scene scene = random_scene(30, 40, 10, lo, hi, 2);
  const auto whole = bits_of(average_contacts_of(scene, nullptr, request));
  Counted counted;
  scene.pairs[3].id1 = 1000; // lines say where they are
  scene.pairs[4].id2 = 1001;
  EXPECT_EQ(bits_of(average_contacts_of(scene, nullptr, request, 1, &counted)), whole);
  EXPECT_EQ(counted.missing, 2);
  // with nobody at either end it is not of these particles
  scene.pairs[3].id2 = 1002;
  scene.walls[2].id2 = 1003;
  Scene without = scene;
  without.pairs.erase(without.pairs.begin() + 3);
  without.walls.erase(without.walls.begin() + 2);
  const auto expected = bits_of(average_contacts_of(without, nullptr, request));
  EXPECT_NE(expected, whole);
  EXPECT_EQ(bits_of(average_contacts_of(scene, nullptr, request, 1, &counted)), expected);
  EXPECT_EQ(counted.missing, 3);
}

TEST(ContactRows, RowsWithNumbersThatAreNoneAreLeftOutAndCounted)
{
  const EulerAverageRequest request =
    request_of_contacts({ lo, hi, { 3, 4, 2 } }, CellWeights::Centre);
  Scene scene = random_scene(30, 40, 10, lo, hi, 3);
  const auto whole = bits_of(average_contacts_of(scene, nullptr, request));
  const std::vector<Touch> pairs(scene.pairs.begin(), scene.pairs.begin() + 6);
  scene.pairs.insert(scene.pairs.end(), pairs.begin(), pairs.end());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  scene.pairs[40].force[0] = not_a_number;
  scene.pairs[41].force[2] = infinity;
  scene.pairs[42].from[1] = not_a_number;
  scene.pairs[43].to[1] = -infinity;
  scene.pairs[44].force[1] = 1e300;
  scene.pairs[45].to[0] = 1e300;
  scene.walls.push_back(scene.walls[0]);
  scene.walls.back().force[1] = not_a_number;
  Counted counted;
  EXPECT_EQ(bits_of(average_contacts_of(scene, nullptr, request, 2, &counted)), whole);
  EXPECT_EQ(counted.broken, 7);
  EXPECT_EQ(counted.missing, 0);
}

TEST(ContactRows, NothingGivesEmptyCells)
{
  const Box box = make_box();
  for (const EulerAverageRequest& request : some_requests())
  {
    const auto cells = static_cast<std::size_t>(request.grid.size());
    const EulerFields fields = average_contacts_of({}, &box, request).fields;
    EXPECT_EQ(fields.contact_normal, std::vector<double>(3 * cells));
    EXPECT_EQ(fields.contact_shear, std::vector<double>(3 * cells));
    EXPECT_EQ(fields.coordination, std::vector<double>(cells));
    EXPECT_EQ(fields.fabric, std::vector<double>(6 * cells));
    Scene particles = random_scene(10, 1, 0, lo, hi, 4);
    particles.pairs.clear();
    const EulerFields still = average_contacts_of(particles, &box, request).fields;
    EXPECT_EQ(still.contact_normal, std::vector<double>(3 * cells));
    EXPECT_EQ(still.coordination, std::vector<double>(cells));
  }
}

TEST(ContactRows, FieldsThatNobodyWantsAreEmpty)
{
  EulerAverageRequest request = request_of_contacts({ lo, hi, { 3, 4, 2 } }, CellWeights::Overlap);
  const Scene scene = random_scene(30, 40, 10, lo, hi, 5);
  const EulerAverages all = average_contacts_of(scene, nullptr, request);
  request.fields = {};
  request.keep_sums = false;
  const EulerAverages few = average_contacts_of(scene, nullptr, request);
  EXPECT_EQ(few.fields.contact_normal, all.fields.contact_normal);
  EXPECT_TRUE(few.fields.coordination.empty() && few.fields.fabric.empty());
  EXPECT_TRUE(few.sums.ends.empty() && few.sums.normals.empty());
  request.fields.fabric = true;
  EXPECT_EQ(average_contacts_of(scene, nullptr, request).fields.fabric, all.fields.fabric);
}

TEST(ContactRows, ContactsWithoutForcesHaveNoStress)
{
  const EulerAverageRequest request =
    request_of_contacts({ lo, hi, { 3, 4, 2 } }, CellWeights::Overlap);
  Scene scene = random_scene(30, 40, 10, lo, hi, 6);
  const EulerFields with = average_contacts_of(scene, nullptr, request).fields;
  scene.forces = false;
  const EulerFields without = average_contacts_of(scene, nullptr, request).fields;
  EXPECT_TRUE(without.contact_normal.empty() && without.contact_shear.empty());
  EXPECT_EQ(without.coordination, with.coordination);
  EXPECT_EQ(without.fabric, with.fabric);
}

/// Contacts below the least force are none, but their force acts.
TEST(ContactRows, SmallForcesDoNotCountAsContacts)
{
  const EulerAverageRequest request =
    request_of_contacts({ lo, hi, { 3, 4, 2 } }, CellWeights::Overlap);
  const Scene scene = random_scene(30, 40, 10, lo, hi, 7);
  Scene strong = scene;
  const auto is_weak = [](const Touch& touch) { return length_of(touch.force) < 30; };
  std::erase_if(strong.pairs, is_weak);
  std::erase_if(strong.walls, is_weak);
  ASSERT_LT(strong.pairs.size(), scene.pairs.size());
  ContactOptions options;
  options.least_force = 30;
  const EulerFields found =
    average_contacts_of(scene, nullptr, request, 1, nullptr, options).fields;
  EXPECT_EQ(
    found.contact_normal, average_contacts_of(scene, nullptr, request).fields.contact_normal);
  EXPECT_EQ(found.coordination, average_contacts_of(strong, nullptr, request).fields.coordination);
  EXPECT_EQ(found.fabric, average_contacts_of(strong, nullptr, request).fields.fabric);
}

TEST(ContactRows, HugeForcesElsewhereTakeNoDigits)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 2, 1, 1 }, { 2, 1, 1 } };
  for (const CellWeights weights : { CellWeights::Overlap, CellWeights::Kernel })
  {
    const EulerAverageRequest request = request_of_contacts(grid, weights, KernelShape::Lucy, 0.1);
    Scene scene = random_scene(30, 40, 10, { 0, 0, 0 }, { 1, 1, 1 }, 11);
    const auto first_cell = [&]
    {
      const EulerFields fields = average_contacts_of(scene, nullptr, request).fields;
      return std::array{ fields.contact_normal[0], fields.contact_normal[2],
        fields.contact_shear[1] };
    };
    const auto expected = first_cell();
    scene.pairs.push_back({ 1, 2, { 1.5, 0.5, 0.5 }, { 1.7, 0.5, 0.5 }, {} });
    for (const double huge : { 1e30, 1e50, 1e85 })
    {
      scene.pairs.back().force = { huge, -huge, 1 };
      EXPECT_EQ(first_cell(), expected) << huge;
    }
  }
}

TEST(ContactRows, EndsThatCoincideHaveNoNormal)
{
  const EulerAverageRequest request =
    request_of_contacts({ lo, hi, { 1, 1, 1 } }, CellWeights::Overlap);
  Scene scene = random_scene(30, 5, 0, lo, hi, 8);
  const EulerFields before = average_contacts_of(scene, nullptr, request).fields;
  Touch point = scene.pairs[0];
  point.to = point.from;
  scene.pairs.push_back(point);
  const EulerFields after = average_contacts_of(scene, nullptr, request).fields;
  EXPECT_EQ(after.fabric, before.fabric);
  EXPECT_EQ(after.contact_normal, before.contact_normal);
  EXPECT_NEAR(after.coordination[0] / before.coordination[0], 1.2, 1e-14);
}

TEST(ContactRows, TheStressIsThatOfMotionAndContacts)
{
  const EulerAverageRequest request =
    request_of_contacts({ lo, hi, { 3, 4, 2 } }, CellWeights::Overlap);
  const Scene scene = random_scene(60, 90, 10, lo, hi, 9);
  const EulerCells kinetic = average(Grains(scene.particles).frame(), request).cells;
  EulerAverages averages = average_contacts_of(scene, nullptr, request);
  EXPECT_EQ(averages.cells, kinetic); // contacts alone do not change it
  add_contact_stress(averages.cells, averages.fields);
  EXPECT_EQ(averages.fields.kinetic_normal, kinetic.normal_stress);
  EXPECT_EQ(averages.fields.kinetic_shear, kinetic.shear_stress);
  for (std::size_t i = 0; i < kinetic.normal_stress.size(); ++i)
  {
    EXPECT_EQ(averages.cells.normal_stress[i],
      kinetic.normal_stress[i] + averages.fields.contact_normal[i]);
    EXPECT_EQ(
      averages.cells.shear_stress[i], kinetic.shear_stress[i] + averages.fields.contact_shear[i]);
  }
  for (std::size_t cell = 0; cell < averages.cells.pressure.size(); ++cell)
  {
    const double* const sigma = averages.cells.normal_stress.data() + 3 * cell;
    EXPECT_DOUBLE_EQ(averages.cells.pressure[cell], -(sigma[0] + sigma[1] + sigma[2]) / 3);
    EXPECT_NE(averages.cells.pressure[cell], kinetic.pressure[cell]);
  }
}
