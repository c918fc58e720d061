// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/bonded_particles.h"

#include "made_particles.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <map>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace
{
/// What this program took from operator new and has not given back, and how much it may.
std::map<void*, std::size_t>* taken = nullptr; // itself made by malloc alone: it is not counted
bool counting = false;
std::size_t room = std::numeric_limits<std::size_t>::max();

std::size_t taken_bytes()
{
  std::size_t bytes = 0;
  for (const auto& [memory, size] : *taken)
  {
    bytes += size;
  }
  return bytes;
}

/// Counts while it lives.
class Count
{
public:
  Count()
  {
    taken = &taken_;
    counting = true;
  }
  Count(const Count&) = delete;
  Count& operator=(const Count&) = delete;
  ~Count()
  {
    counting = false;
    room = std::numeric_limits<std::size_t>::max();
  }

private:
  std::map<void*, std::size_t> taken_;
};

void* take(std::size_t bytes)
{
  if (counting && bytes > room)
  {
    throw std::bad_alloc();
  }
  void* const memory = std::malloc(bytes > 0 ? bytes : 1);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  if (std::exchange(counting, false))
  {
    room -= bytes;
    (*taken)[memory] = bytes;
    counting = true;
  }
  return memory;
}

void give_back(void* memory) noexcept
{
  if (std::exchange(counting, false))
  {
    taken->erase(memory);
    counting = true;
  }
  std::free(memory);
}
}

void* operator new(std::size_t bytes)
{
  return take(bytes);
}

void* operator new[](std::size_t bytes)
{
  return take(bytes);
}

void operator delete(void* memory) noexcept
{
  give_back(memory);
}

void operator delete[](void* memory) noexcept
{
  give_back(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  give_back(memory);
}

void operator delete[](void* memory, std::size_t) noexcept
{
  give_back(memory);
}

namespace
{
using granular::BondedParticles;
using granular::LimitError;
using granular::Vector3;
using made_particles::bits_of;

template <class Work>
std::string limit_of(const Work& work)
{
  try
  {
    work();
  }
  catch (const LimitError& error)
  {
    return error.text();
  }
  return {};
}

TEST(BondedParticles, grows_as_the_style)
{
  BondedParticles particles(3, 2);
  EXPECT_EQ(particles.capacity(), 0U);
  particles.grow();
  EXPECT_EQ(particles.capacity(), 10000U);
  particles.grow(12);
  EXPECT_EQ(particles.capacity(), 12U);
  particles.grow(0);
  EXPECT_EQ(particles.capacity(), 10012U);
  EXPECT_EQ(particles.size(), 0U);

  particles.resize(45000);
  EXPECT_EQ(limit_of([&] { particles.grow(44999); }).substr(0, 27), "expected room for 45000 to ");
  EXPECT_EQ(particles.capacity(), 45000U);
  particles.grow();
  EXPECT_EQ(particles.capacity(), 55000U);
  particles.grow(45000);
  EXPECT_EQ(particles.capacity(), particles.size());
}

TEST(BondedParticles, reserve_makes_half_as_much_again)
{
  BondedParticles particles(3, 2);
  for (const auto& [size, capacity] : std::initializer_list<std::pair<std::size_t, std::size_t>>{
         { 0, 0 }, { 1, 10000 }, { 10000, 10000 }, { 10001, 20000 }, { 20001, 30000 },
         { 30001, 45000 }, { 45001, 67500 }, { 67501, 101250 }, { 200000, 200000 }, { 7, 200000 } })
  {
    particles.reserve(size);
    EXPECT_EQ(particles.capacity(), capacity);
    EXPECT_EQ(particles.size(), 0U);
  }
  BondedParticles others(3, 2);
  others.resize(10000);
  others.resize(10001);
  EXPECT_EQ(others.capacity(), 20000U);
  others.resize(90000);
  EXPECT_EQ(others.capacity(), 90000U);
}

TEST(BondedParticles, a_million_one_by_one_move_seldom)
{
  BondedParticles particles(1, 0);
  int moves = 0;
  std::size_t copied = 0;
  for (std::size_t i = 0; i < 1'000'000; ++i)
  {
    const std::size_t capacity = particles.capacity();
    particles.add(1, {});
    moves += particles.capacity() != capacity ? 1 : 0;
    copied += particles.capacity() != capacity ? i : 0;
  }
  EXPECT_EQ(particles.size(), 1'000'000U);
  EXPECT_LE(moves, 60);
  EXPECT_LE(copied, 3'000'000U); // 1 + 2/3 + 4/9 + ... = 3 times as many
}

TEST(BondedParticles, what_was_moved_from_is_empty)
{
  static_assert(!std::is_copy_constructible_v<BondedParticles>);
  static_assert(!std::is_copy_assignable_v<BondedParticles>);
  BondedParticles first = made_particles::make(30, 3, 2, 4);
  const auto all = bits_of(first);
  const std::size_t capacity = first.capacity();
  const auto expect_empty = [](const BondedParticles& particles)
  {
    EXPECT_EQ(particles.size(), 0U);
    EXPECT_EQ(particles.capacity(), 0U);
    EXPECT_EQ(particles.memory().allocated, 0U);
    EXPECT_TRUE(particles.x().empty() && particles.bonds().empty());
    EXPECT_EQ(particles.most_bonds(), 3);
    EXPECT_EQ(particles.history_values(), 2);
  };
  BondedParticles second(std::move(first));
  EXPECT_EQ(bits_of(second), all);
  EXPECT_EQ(second.capacity(), capacity);
  expect_empty(first);
  EXPECT_EQ(first.add(7, {}), 0U); // and may be used
  EXPECT_EQ(first.type()[0], 7);

  BondedParticles third(1, 0);
  third.add(1, {});
  third = std::move(second);
  EXPECT_EQ(bits_of(third), all);
  EXPECT_EQ(third.capacity(), capacity);
  EXPECT_EQ(third.most_bonds(), 3);
  EXPECT_EQ(third.history_values(), 2);
  expect_empty(second);

  BondedParticles& same = third;
  third = std::move(same);
  EXPECT_EQ(bits_of(third), all);
}

TEST(BondedParticles, add_gives_the_defaults)
{
  BondedParticles particles(2, 3);
  particles.resize(1);
  particles.v()[0] = particles.f()[0] = particles.x_mol()[0] = particles.v_mol()[0] = { 1, 2, 3 };
  particles.tag()[0] = particles.molecule()[0] = 9;
  particles.image()[0] = { 1, 2, 3 };
  particles.mask()[0] = 8;
  particles.add_bond(0, 4, 5, std::vector<double>{ 6, 7, 8 });
  particles.clear(); // the row has been used
  EXPECT_EQ(particles.add(5, { 1, 2, 3 }), 0U);
  EXPECT_EQ(particles.size(), 1U);
  EXPECT_EQ(particles.x()[0], (Vector3{ 1, 2, 3 }));
  for (const Vector3& zero :
    { particles.v()[0], particles.f()[0], particles.x_mol()[0], particles.v_mol()[0] })
  {
    EXPECT_EQ(zero, Vector3{});
  }
  EXPECT_EQ(particles.tag()[0], 0);
  EXPECT_EQ(particles.type()[0], 5);
  EXPECT_EQ(particles.mask()[0], 1);
  EXPECT_EQ(particles.image()[0], granular::ImageCounts{});
  EXPECT_EQ(particles.molecule()[0], 0);
  EXPECT_EQ(particles.bonds()[0], 0);
  EXPECT_TRUE(particles.history(0).empty());
}

/// What is not said to be written has its default, also where something else has been.
TEST(BondedParticles, resize_leaves_out_what_is_written)
{
  using granular::PackField;
  using Reset = void (*)(BondedParticles&);
  const std::initializer_list<std::pair<PackField, Reset>> fields = {
    { PackField::X, [](BondedParticles& particles) { particles.x()[2] = {}; } },
    { PackField::V, [](BondedParticles& particles) { particles.v()[2] = {}; } },
    { PackField::F, [](BondedParticles& particles) { particles.f()[2] = {}; } },
    { PackField::XMol, [](BondedParticles& particles) { particles.x_mol()[2] = {}; } },
    { PackField::VMol, [](BondedParticles& particles) { particles.v_mol()[2] = {}; } },
    { PackField::Tag, [](BondedParticles& particles) { particles.tag()[2] = 0; } },
    { PackField::Type, [](BondedParticles& particles) { particles.type()[2] = 0; } },
    { PackField::Mask, [](BondedParticles& particles) { particles.mask()[2] = 1; } },
    { PackField::Image, [](BondedParticles& particles) { particles.image()[2] = {}; } },
    { PackField::Molecule, [](BondedParticles& particles) { particles.molecule()[2] = 0; } },
  };
  BondedParticles expected = made_particles::make(2, 3, 2, 6);
  expected.add(0, {});
  for (const auto& [field, reset] : fields)
  {
    BondedParticles particles = made_particles::make(5, 3, 2, 6);
    particles.tag()[2] = 77;
    particles.resize(2);
    particles.resize(3, granular::set_of(field));
    reset(particles);
    EXPECT_EQ(bits_of(particles), bits_of(expected)) << static_cast<int>(field);
  }
}

TEST(BondedParticles, add_of_its_own_place_while_growing)
{
  BondedParticles particles(1, 0);
  particles.grow(1);
  particles.add(1, { 4, 5, 6 });
  particles.add(1, particles.x()[0]);
  EXPECT_EQ(particles.x()[1], (Vector3{ 4, 5, 6 }));
}

TEST(BondedParticles, growing_keeps_all_bits)
{
  BondedParticles particles = made_particles::make(37, 4, 3, 1);
  const auto before = bits_of(particles);
  for (const std::size_t capacity : std::initializer_list<std::size_t>{ 37, 38, 0, 100000, 37 })
  {
    particles.grow(capacity);
    EXPECT_EQ(bits_of(particles), before);
  }
}

TEST(BondedParticles, bonds)
{
  BondedParticles particles(2, 2);
  particles.add(1, {});
  particles.add(1, {});
  particles.add_bond(1, -3, 17, std::vector<double>{ 0.5, -0.5 });
  particles.add_bond(1, 4, -18, std::vector<double>{ 0.25, 8 });
  EXPECT_EQ(particles.bonds()[0], 0);
  EXPECT_EQ(particles.bonds()[1], 2);
  const auto& others = std::as_const(particles);
  EXPECT_EQ(std::vector(others.bond_types(1).begin(), others.bond_types(1).end()),
    (std::vector<std::int32_t>{ -3, 4 }));
  EXPECT_EQ(std::vector(others.partners(1).begin(), others.partners(1).end()),
    (std::vector<std::int64_t>{ 17, -18 }));
  EXPECT_EQ(std::vector(others.history(1).begin(), others.history(1).end()),
    (std::vector<double>{ 0.5, -0.5, 0.25, 8 }));

  const std::vector<double> two(2);
  EXPECT_EQ(limit_of([&] { particles.add_bond(1, 1, 1, two); }),
    "expected at most 2 bonds of particle 1, got 3");
  EXPECT_EQ(
    limit_of([&] { particles.add_bond(2, 1, 1, two); }), "expected a particle below 2, got 2");
  EXPECT_EQ(limit_of([&] { particles.add_bond(0, 1, 1, {}); }),
    "expected 2 history values of a bond, got 0");
  EXPECT_EQ(particles.bonds()[1], 2);

  particles.set_bonds(1, 1);
  particles.set_bonds(1, 2);
  EXPECT_EQ(others.partners(1)[0], 17);
  EXPECT_EQ(others.partners(1)[1], 0);
  EXPECT_EQ(others.history(1)[2], 0);
}

TEST(BondedParticles, the_last_one_takes_the_hole)
{
  BondedParticles particles = made_particles::make(5, 3, 2, 2);
  const auto all = bits_of(particles);
  particles.remove(1);
  EXPECT_EQ(bits_of(particles), (std::vector{ all[0], all[4], all[2], all[3] }));
  particles.remove(3);
  EXPECT_EQ(bits_of(particles), (std::vector{ all[0], all[4], all[2] }));
  EXPECT_EQ(limit_of([&] { particles.remove(3); }), "expected a particle below 3, got 3");
  particles.remove(0);
  particles.remove(0);
  particles.remove(0);
  EXPECT_EQ(particles.size(), 0U);
}

TEST(BondedParticles, limits)
{
  EXPECT_EQ(limit_of([] { BondedParticles(0, 12); }),
    "expected room for at least 1 bond a particle, got 0");
  EXPECT_EQ(
    limit_of([] { BondedParticles(4, -1); }), "expected at least 0 history values a bond, got -1");
  const std::int32_t most = std::numeric_limits<std::int32_t>::max();
  EXPECT_NE(limit_of([&] { BondedParticles(most, most); }), "");
  BondedParticles particles(most, 512);
  EXPECT_NE(limit_of([&] { particles.grow(1 << 20); }), "");
  EXPECT_NE(limit_of([&] { particles.resize(std::numeric_limits<std::size_t>::max()); }), "");
  EXPECT_NE(limit_of([&] { particles.reserve(1 << 20); }), "");
  EXPECT_EQ(particles.capacity(), 0U);
}

/// 5 vectors of 24 bytes, 16 of tag and molecule, 12 of type, mask and number of bonds, 12 of the image; of each bond 12 and
/// the history.
TEST(BondedParticles, memory_is_what_was_taken)
{
  for (const auto& [most_bonds, values] : { std::pair(1, 0), std::pair(6, 0), std::pair(12, 14) })
  {
    const Count count;
    BondedParticles particles(most_bonds, values);
    EXPECT_EQ(particles.memory().allocated, 0U);
    const std::size_t before = taken_bytes();
    for (const std::size_t capacity : std::initializer_list<std::size_t>{ 7, 0, 1234 })
    {
      particles.grow(capacity);
      const auto bonds = static_cast<std::size_t>(most_bonds);
      const std::size_t history = bonds * static_cast<std::size_t>(values) * 8;
      const granular::BondedMemory memory = particles.memory();
      EXPECT_EQ(memory.allocated, taken_bytes() - before);
      EXPECT_EQ(memory.allocated, particles.capacity() * (160 + 12 * bonds + history));
      EXPECT_EQ(memory.described, particles.capacity() * (120 + 4 * (4 + bonds) + history));
    }
  }
}

TEST(BondedParticles, without_memory_it_stays_as_it_was)
{
  BondedParticles particles = made_particles::make(20, 3, 5, 3);
  particles.grow(20);
  const auto before = bits_of(particles);
  const std::size_t needed = particles.memory().allocated / 20 * 10020;
  for (std::size_t bytes = 0; bytes < needed; bytes += needed / 97)
  {
    {
      const Count count;
      room = bytes;
      EXPECT_THROW(particles.grow(), std::bad_alloc) << bytes << " of " << needed;
      EXPECT_EQ(taken_bytes(), 0U);
    }
    EXPECT_EQ(particles.capacity(), 20U);
    ASSERT_EQ(bits_of(particles), before);
  }
  const Count count;
  room = needed;
  particles.grow();
  EXPECT_EQ(particles.capacity(), 10020U);
}
}
