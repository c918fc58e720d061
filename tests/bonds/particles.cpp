// SPDX-License-Identifier: BSD-3-Clause
// Storage, and arguments that cannot be.
#include "bonds.h"

#include <utility>

using namespace bonds;

TEST(BondedParticles, GrowAsTheStyle)
{
  const Object particles = create(3, 2);
  std::vector<std::size_t> capacities;
  for (const std::size_t capacity : { 0U, 12U, 0U })
  {
    expect_ok(granular_bonds_grow(particles.get(), capacity));
    capacities.push_back(arrays_of(particles).capacity);
  }
  EXPECT_EQ(capacities, (std::vector<std::size_t>{ 10000, 12, 10012 }));
  expect_ok(granular_bonds_resize(particles.get(), 45000));
  EXPECT_EQ(message_of(granular_bonds_grow(particles.get(), 44999), GRANULAR_BONDS_LIMIT_ERROR)
              .substr(0, 27),
    "expected room for 45000 to ");
  EXPECT_EQ(arrays_of(particles).capacity, 45000U);
}

/// Each particle is copied only a few times: 1 + 2/3 + 4/9 + ... = 3.
TEST(BondedParticles, AMillionOneByOneMoveSeldom)
{
  const Object particles = create(1, 0);
  const double x[3] = {};
  std::size_t copied = 0;
  std::size_t capacity = 0;
  for (std::size_t i = 0; i < 1'000'000; ++i)
  {
    std::size_t row = 0;
    ASSERT_EQ(granular_bonds_add(particles.get(), 1, x, &row), GRANULAR_BONDS_OK);
    ASSERT_EQ(row, i);
    const std::size_t now = arrays_of(particles).capacity;
    copied += now != std::exchange(capacity, now) ? i : 0;
  }
  EXPECT_LE(copied, 3'000'000U);
}

TEST(BondedParticles, GrowingKeepsAllBits)
{
  const Object particles = make(37, 4, 3, 1);
  const auto before = bits_of(particles);
  for (const std::size_t capacity : { 37U, 38U, 0U, 100000U, 37U })
  {
    expect_ok(granular_bonds_grow(particles.get(), capacity));
    EXPECT_EQ(bits_of(particles), before);
  }
}

/// Also in rows that were used, and at a place of the object itself, which grows.
TEST(BondedParticles, NewOnesHaveTheDefaults)
{
  const Object used = make(20, 2, 3, 4);
  const Object fresh = create(2, 3, 10);
  expect_ok(granular_bonds_resize(used.get(), 0));
  expect_ok(granular_bonds_resize(used.get(), 10));
  EXPECT_EQ(bits_of(used), bits_of(fresh));
  const granular_bonds_arrays a = arrays_of(fresh);
  EXPECT_EQ(bits_of(a, 9),
    (Words{ 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, /* five vectors */
      0, 0, 0, 1 /* mask */, 0, 0, 0, 0 }));

  set(a.x, 4, 5, 6);
  expect_ok(granular_bonds_grow(fresh.get(), 10));
  expect_ok(granular_bonds_add(fresh.get(), 7, arrays_of(fresh).x, nullptr));
  const granular_bonds_arrays grown = arrays_of(fresh);
  EXPECT_EQ(Numbers(grown.x + 30, grown.x + 33), (Numbers{ 4, 5, 6 }));
  EXPECT_EQ(grown.type[10], 7);
  EXPECT_EQ(grown.mask[10], 1);
}

TEST(BondedParticles, Bonds)
{
  const Object particles = create(2, 2, 2);
  const double first[] = { 0.5, -0.5 };
  const double second[] = { 0.25, 8 };
  expect_ok(granular_bonds_add_bond(particles.get(), 1, -3, 17, first));
  expect_ok(granular_bonds_add_bond(particles.get(), 1, 4, -18, second));
  const granular_bonds_arrays a = arrays_of(particles);
  EXPECT_EQ(a.bonds[0], 0);
  EXPECT_EQ(a.bonds[1], 2);
  EXPECT_EQ(std::vector(a.bond_types + 2, a.bond_types + 4), (std::vector<std::int32_t>{ -3, 4 }));
  EXPECT_EQ(std::vector(a.partners + 2, a.partners + 4), (std::vector<std::int64_t>{ 17, -18 }));
  EXPECT_EQ(std::vector(a.history + 4, a.history + 8), (Numbers{ 0.5, -0.5, 0.25, 8 }));

  EXPECT_EQ(message_of(
              granular_bonds_add_bond(particles.get(), 1, 1, 1, first), GRANULAR_BONDS_LIMIT_ERROR),
    "expected at most 2 bonds of particle 1, got 3");
  EXPECT_EQ(message_of(granular_bonds_add_bond(particles.get(), 2, 1, 1, first),
              GRANULAR_BONDS_BAD_ARGUMENT),
    "expected a particle below 2, got 2");
  EXPECT_EQ(
    message_of(granular_bonds_set_bonds(particles.get(), 1, -1), GRANULAR_BONDS_BAD_ARGUMENT),
    "expected a number of bonds from 0, got -1");
  EXPECT_EQ(a.bonds[1], 2);

  expect_ok(granular_bonds_set_bonds(particles.get(), 1, 1));
  expect_ok(granular_bonds_set_bonds(particles.get(), 1, 2));
  EXPECT_EQ(std::vector(a.partners + 2, a.partners + 4), (std::vector<std::int64_t>{ 17, 0 }));
  EXPECT_EQ(std::vector(a.history + 4, a.history + 8), (Numbers{ 0.5, -0.5, 0, 0 }));
}

TEST(BondedParticles, TheLastOneTakesTheHole)
{
  const Object particles = make(5, 3, 2, 2);
  const auto all = bits_of(particles);
  expect_ok(granular_bonds_remove(particles.get(), 1));
  EXPECT_EQ(bits_of(particles), (std::vector{ all[0], all[4], all[2], all[3] }));
  expect_ok(granular_bonds_remove(particles.get(), 3));
  EXPECT_EQ(bits_of(particles), (std::vector{ all[0], all[4], all[2] }));
  EXPECT_EQ(message_of(granular_bonds_remove(particles.get(), 3), GRANULAR_BONDS_BAD_ARGUMENT),
    "expected a particle below 3, got 3");
}

TEST(BondedParticles, Limits)
{
  const auto creating = [](std::int32_t most_bonds, std::int32_t history_values)
  {
    granular_bonds* particles = nullptr;
    const std::string text = message_of(
      granular_bonds_create(most_bonds, history_values, &particles), GRANULAR_BONDS_LIMIT_ERROR);
    EXPECT_EQ(particles, nullptr);
    return text;
  };
  EXPECT_EQ(creating(0, 12), "expected room for at least 1 bond a particle, got 0");
  EXPECT_EQ(creating(4, -1), "expected at least 0 history values a bond, got -1");
  creating(Limits32::max(), Limits32::max());
  const Object particles = create(Limits32::max(), 512);
  for (const auto function : { granular_bonds_grow, granular_bonds_resize })
  {
    for (const std::size_t size :
      { std::size_t{ 1 } << 20, std::numeric_limits<std::size_t>::max() })
    {
      message_of(function(particles.get(), size), GRANULAR_BONDS_LIMIT_ERROR);
    }
  }
  EXPECT_EQ(arrays_of(particles).capacity, 0U);
}

/// 5 vectors of 24 bytes, 16 of tag and molecule, 12 of type, mask and number of bonds, 12 of the image; of each bond 12 and
/// the history.
TEST(BondedParticles, MemoryInBytes)
{
  for (const auto& [most_bonds, values] : { std::pair(1, 0), std::pair(6, 0), std::pair(12, 14) })
  {
    const Object particles = create(most_bonds, values);
    EXPECT_EQ(arrays_of(particles).memory, 0U);
    expect_ok(granular_bonds_grow(particles.get(), 1234));
    const granular_bonds_arrays a = arrays_of(particles);
    const auto bonds = static_cast<std::size_t>(most_bonds);
    const std::size_t history = bonds * static_cast<std::size_t>(values) * 8;
    EXPECT_EQ(a.memory, 1234 * (160 + 12 * bonds + history));
    EXPECT_EQ(a.described, 1234 * (120 + 4 * (4 + bonds) + history));
    const std::size_t last = 1233 * bonds; // all of it is there
    a.bond_types[last + bonds - 1] = 1;
    a.image[3 * 1233 + 2] = 1;
  }
}

#ifndef GRANULAR_TEST_SANITIZED // which ends the program
TEST(BondedParticles, WithoutMemoryTheyStayAsTheyWere)
{
  const Object particles = make(20, 3, 5, 3);
  const auto before = bits_of(particles);
  for (const auto function : { granular_bonds_grow, granular_bonds_resize })
  {
    EXPECT_EQ(
      message_of(function(particles.get(), std::size_t{ 1 } << 50), GRANULAR_BONDS_NO_MEMORY),
      "out of memory");
    EXPECT_EQ(arrays_of(particles).capacity, 10000U);
    EXPECT_EQ(bits_of(particles), before);
  }
}
#endif

TEST(BondedParticles, NullsAreErrors)
{
  const Object object = make(2, 1, 1, 1);
  granular_bonds* const particles = object.get();
  granular_bonds_arrays arrays;
  const double x[3] = {};
  std::size_t doubles = 0;
  const auto expect_null = [](granular_bonds_status status, const std::string& name) {
    EXPECT_EQ(message_of(status, GRANULAR_BONDS_BAD_ARGUMENT), "expected " + name + ", got null");
  };
  granular_bonds_destroy(nullptr);
  expect_null(granular_bonds_create(1, 0, nullptr), "particles");
  expect_null(granular_bonds_grow(nullptr, 0), "particles");
  expect_null(granular_bonds_resize(nullptr, 0), "particles");
  expect_null(granular_bonds_add(nullptr, 1, x, nullptr), "particles");
  expect_null(granular_bonds_add(particles, 1, nullptr, nullptr), "x");
  expect_null(granular_bonds_add_bond(nullptr, 0, 1, 1, x), "particles");
  expect_null(granular_bonds_add_bond(particles, 0, 1, 1, nullptr), "history");
  expect_null(granular_bonds_set_bonds(nullptr, 0, 0), "particles");
  expect_null(granular_bonds_remove(nullptr, 0), "particles");
  expect_null(granular_bonds_view(nullptr, &arrays), "particles");
  expect_null(granular_bonds_view(particles, nullptr), "arrays");
  expect_null(
    granular_bonds_pack(nullptr, 0, 0, 1, nullptr, nullptr, nullptr, 0, &doubles), "particles");
  expect_null(
    granular_bonds_pack(particles, 0, 0, 1, nullptr, nullptr, nullptr, 0, nullptr), "doubles");
  expect_null(granular_bonds_unpack(nullptr, 0, 0, nullptr, x, 0, nullptr), "particles");
  expect_null(granular_bonds_unpack(particles, 0, 0, nullptr, nullptr, 9, nullptr), "buffer");
  expect_null(
    granular_bonds_pack_record(nullptr, 0, nullptr, nullptr, 0, nullptr, 0, &doubles), "particles");
  expect_null(
    granular_bonds_pack_record(particles, 0, nullptr, nullptr, 1, nullptr, 0, &doubles), "fixes");
  expect_null(
    granular_bonds_pack_record(particles, 0, nullptr, nullptr, 0, nullptr, 0, nullptr), "doubles");
  expect_null(granular_bonds_unpack_record(nullptr, nullptr, 0, x, 3, nullptr), "particles");
  expect_null(granular_bonds_unpack_record(particles, nullptr, 0, nullptr, 3, nullptr), "chunk");
}
