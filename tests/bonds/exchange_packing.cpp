// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/exchange_packing.h"
#include "granular/bonds/id_numbers.h"

#include "made_particles.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{
using granular::BondedParticles;
using granular::FormatError;
using granular::LimitError;
using granular::PackDialect;
using granular::PackRoutine;
using granular::ParticleRange;
using granular::ParticleRows;
using granular::PeriodicShift;
using granular::Vector3;
using made_particles::bits_of;
using Numbers = std::vector<double>;

constexpr PackDialect pfm = PackDialect::Pfm;
constexpr PackDialect plain = PackDialect::WithBonds;
const PeriodicShift no_shift;

/// What the programs send, by hand: x v f, X and V of the molecule, id, type, mask, molecule.
struct Order
{
  PackRoutine routine;
  PackDialect dialect;
  const char* fields;
  Numbers of_one; ///< of the particle of one()
};

const std::vector<Order> orders = {
  { PackRoutine::Comm, pfm, "xXV", { 1, 2, 3, 10, 11, 12, 13, 14, 15 } },
  { PackRoutine::Comm, plain, "x", { 1, 2, 3 } },
  { PackRoutine::CommVelocity, pfm, "xvXV", { 1, 2, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15 } },
  { PackRoutine::CommVelocity, plain, "xv", { 1, 2, 3, 4, 5, 6 } },
  { PackRoutine::Border, pfm, "xitmoXV", { 1, 2, 3, 21, 22, 23, 24, 10, 11, 12, 13, 14, 15 } },
  { PackRoutine::Border, plain, "xitmo", { 1, 2, 3, 21, 22, 23, 24 } },
  { PackRoutine::BorderVelocity, pfm, "xitmovXV",
    { 1, 2, 3, 21, 22, 23, 24, 4, 5, 6, 10, 11, 12, 13, 14, 15 } },
  { PackRoutine::BorderVelocity, plain, "xitmov", { 1, 2, 3, 21, 22, 23, 24, 4, 5, 6 } },
  { PackRoutine::BorderHybrid, pfm, "o", { 24 } },
  { PackRoutine::BorderHybrid, plain, "o", { 24 } },
  { PackRoutine::Reverse, pfm, "f", { 7, 8, 9 } },
  { PackRoutine::Reverse, plain, "f", { 7, 8, 9 } },
};

BondedParticles one()
{
  BondedParticles particles(1, 0);
  particles.add(22, { 1, 2, 3 });
  particles.v()[0] = { 4, 5, 6 };
  particles.f()[0] = { 7, 8, 9 };
  particles.x_mol()[0] = { 10, 11, 12 };
  particles.v_mol()[0] = { 13, 14, 15 };
  particles.tag()[0] = 21;
  particles.mask()[0] = 23;
  particles.molecule()[0] = 24;
  particles.image()[0] = { 25, 26, 27 };
  return particles;
}

/// The doubles of a particle, field by field.
void append(const BondedParticles& particles, std::size_t i, const char* fields, Numbers& to)
{
  for (; *fields; ++fields)
  {
    const auto add = [&](const Vector3& vector)
    { to.insert(to.end(), vector.begin(), vector.end()); };
    switch (*fields)
    {
      case 'x':
        add(particles.x()[i]);
        break;
      case 'v':
        add(particles.v()[i]);
        break;
      case 'f':
        add(particles.f()[i]);
        break;
      case 'X':
        add(particles.x_mol()[i]);
        break;
      case 'V':
        add(particles.v_mol()[i]);
        break;
      case 'i':
        to.push_back(granular::id_to_number(particles.tag()[i]));
        break;
      case 't':
        to.push_back(particles.type()[i]);
        break;
      case 'm':
        to.push_back(particles.mask()[i]);
        break;
      default:
        to.push_back(granular::id_to_number(particles.molecule()[i]));
    }
  }
}

std::vector<std::uint64_t> bits(const Numbers& numbers)
{
  std::vector<std::uint64_t> found;
  for (const double number : numbers)
  {
    found.push_back(std::bit_cast<std::uint64_t>(number));
  }
  return found;
}

Numbers pack(const BondedParticles& particles, const Order& order, const ParticleRows& rows,
  std::size_t count, const PeriodicShift& shift = no_shift)
{
  Numbers buffer(count * granular::packed_doubles(order.routine, order.dialect));
  granular::pack(particles, order.routine, order.dialect, rows, shift, buffer);
  return buffer;
}

template <class Failure, class Work>
std::string error_of(const Work& work)
{
  try
  {
    work();
  }
  catch (const Failure& error)
  {
    return error.text();
  }
  return {};
}

TEST(Packing, sizes_are_the_styles)
{
  const std::array<std::array<std::size_t, 2>, 6> sizes = { { { 9, 3 }, { 12, 6 }, { 13, 7 },
    { 16, 10 }, { 1, 1 }, { 3, 3 } } };
  for (std::size_t routine = 0; routine < sizes.size(); ++routine)
  {
    const auto which = static_cast<PackRoutine>(routine);
    EXPECT_EQ(granular::packed_doubles(which, pfm), sizes[routine][0]);
    EXPECT_EQ(granular::packed_doubles(which, plain), sizes[routine][1]);
  }
}

TEST(Packing, one_particle_by_hand)
{
  const BondedParticles particles = one();
  for (const Order& order : orders)
  {
    EXPECT_EQ(pack(particles, order, ParticleRange{ 0, 1 }, 1), order.of_one) << order.fields;
  }
}

/// 300 particles are some blocks of which each holds large ids, then blocks without, and one large id at the end of one.
BondedParticles many(std::size_t count)
{
  BondedParticles particles = made_particles::make(count, 2, 1, 11);
  for (std::size_t i = 128; i < count; ++i)
  {
    particles.tag()[i] = static_cast<std::int64_t>(i) - 3;
    particles.molecule()[i] = i == 511 ? -5'000'000'000'000'000'000 : 7;
  }
  return particles;
}

TEST(Packing, ranges_and_lists_against_plain_loops)
{
  const BondedParticles particles = many(700);
  for (const Order& order : orders)
  {
    for (const ParticleRange range : { ParticleRange{ 0, 700 }, ParticleRange{ 130, 255 },
           ParticleRange{ 3, 1 }, ParticleRange{ 700, 0 }, ParticleRange{ 5, 0 } })
    {
      Numbers expected;
      for (std::size_t i = range.first; i < range.first + range.count; ++i)
      {
        append(particles, i, order.fields, expected);
      }
      EXPECT_EQ(bits(pack(particles, order, range, range.count)), bits(expected)) << order.fields;
    }
    std::vector<std::size_t> list;
    Numbers expected;
    for (std::size_t k = 0; k < 300; ++k)
    {
      list.push_back(k % 10 == 0 ? 699 : k * k % 700);
      append(particles, list.back(), order.fields, expected);
    }
    EXPECT_EQ(bits(pack(particles, order, list, list.size())), bits(expected)) << order.fields;
  }
}

/// What is unpacked gives the same buffer again, and nothing else has changed.
TEST(Packing, unpacking_is_the_other_way)
{
  const BondedParticles particles = many(700);
  for (const Order& order : orders)
  {
    if (order.routine == PackRoutine::Reverse)
    {
      continue;
    }
    const Numbers buffer = pack(particles, order, ParticleRange{ 0, 700 }, 700);
    for (const std::size_t first : std::initializer_list<std::size_t>{ 0, 13, 650, 1000 })
    {
      BondedParticles others = made_particles::make(2000, 1, 0, 12);
      others.resize(1000); // there was something else in the room behind
      others.grow(first == 650 ? 1000 : others.capacity()); // without room, and with it
      const auto before = bits_of(others);
      granular::unpack(others, order.routine, order.dialect, { first, 700 }, buffer);
      ASSERT_EQ(others.size(), std::max<std::size_t>(1000, first + 700));
      EXPECT_EQ(bits(pack(others, order, ParticleRange{ first, 700 }, 700)), bits(buffer))
        << order.fields;

      BondedParticles expected = made_particles::make(1000, 1, 0, 12);
      expected.resize(others.size());
      for (std::size_t i = 0; i < 700; ++i)
      {
        const std::string fields = order.fields;
        const auto has = [&](char field) { return fields.find(field) != std::string::npos; };
        const std::size_t row = first + i;
        expected.x()[row] = has('x') ? particles.x()[i] : expected.x()[row];
        expected.v()[row] = has('v') ? particles.v()[i] : expected.v()[row];
        expected.x_mol()[row] = has('X') ? particles.x_mol()[i] : expected.x_mol()[row];
        expected.v_mol()[row] = has('V') ? particles.v_mol()[i] : expected.v_mol()[row];
        expected.tag()[row] = has('i') ? particles.tag()[i] : expected.tag()[row];
        expected.type()[row] = has('t') ? particles.type()[i] : expected.type()[row];
        expected.mask()[row] = has('m') ? particles.mask()[i] : expected.mask()[row];
        expected.molecule()[row] = has('o') ? particles.molecule()[i] : expected.molecule()[row];
      }
      ASSERT_EQ(bits_of(others), bits_of(expected)) << order.fields;
    }
  }
}

/// Where the room ends somewhere in the buffer, and where there is none.
TEST(Packing, unpacking_makes_room_once)
{
  constexpr std::size_t count = 1'000'000;
  const Numbers buffer(count, 7);
  for (const std::size_t old : std::initializer_list<std::size_t>{ 0, 5, 400'000 })
  {
    BondedParticles particles(1, 0);
    particles.resize(old);
    granular::unpack(particles, PackRoutine::BorderHybrid, plain, { old, count }, buffer);
    EXPECT_EQ(particles.size(), old + count);
    EXPECT_EQ(particles.capacity(), old + count); // steps that add up would be beyond
    EXPECT_EQ(particles.molecule().back(), 7);
  }
}

TEST(Packing, forces_are_added)
{
  BondedParticles particles = one();
  particles.add(1, {});
  const Numbers buffer = { 0.5, 1, 2, 100, 200, 300, 0.25, 0, 0 };
  const std::vector<std::size_t> rows = { 0, 1, 0 };
  granular::unpack_reverse(particles, rows, buffer);
  EXPECT_EQ(particles.f()[0], (Vector3{ 7.75, 9, 11 }));
  EXPECT_EQ(particles.f()[1], (Vector3{ 100, 200, 300 }));
  granular::unpack(particles, PackRoutine::Reverse, plain, { 1, 1 }, std::span(buffer).first(3));
  EXPECT_EQ(particles.f()[1], (Vector3{ 100.5, 201, 302 }));
}

// ---- periodic boxes ----------------------------------------------------------------------------

/// Numbers that add up without rounding.
PeriodicShift shift_of(bool triclinic)
{
  PeriodicShift shift;
  shift.counts = { 1, -1, 2, -1, 1, 3 }; // x y z yz xz xy
  shift.lengths = { 1000, 2000, 4000 };
  shift.yz = 0.5;
  shift.xz = 0.25;
  shift.xy = 0.125;
  shift.triclinic = triclinic;
  shift.rates = { 16, 32, 64, 1, 2, 4 };
  shift.moving_groups = 1 + 8;
  return shift;
}

TEST(Packing, shifted_by_hand)
{
  BondedParticles particles = one();
  particles.mask()[0] = 2;
  particles.add(1, { 1, 2, 3 });
  particles.mask()[1] = 8 + 2; // only the second one is in a moving group
  for (const bool triclinic : { false, true })
  {
    const PeriodicShift shift = shift_of(triclinic);
    const double dx = 1000 + (triclinic ? 3 * 0.125 + 0.25 : 0);
    const double dy = -2000 - (triclinic ? 0.5 : 0);
    const Vector3 border = triclinic ? Vector3{ 1, -1, 2 } : Vector3{ 1000, -2000, 8000 };
    const Vector3 dv = { 16 + 3 * 4 + 2, -32 - 1, 128 };
    for (const Order& order : orders)
    {
      // in the other order: the mask that counts is that of the particle, not that of its place
      Numbers expected;
      append(particles, 1, order.fields, expected);
      append(particles, 0, order.fields, expected);
      const std::size_t half = expected.size() / 2;
      const std::string fields = order.fields;
      const bool is_border = fields.find('t') != std::string::npos;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const Vector3 comm = { dx, dy, 8000 };
        for (const std::size_t begin : { std::size_t{ 0 }, half })
        {
          if (fields[0] == 'x')
          {
            expected[begin + k] += is_border ? border[k] : comm[k];
          }
        }
        if (fields.find('v') != std::string::npos)
        {
          expected[k + (is_border ? 7 : 3)] += dv[k];
        }
      }
      const std::vector<std::size_t> list = { 1, 0 };
      EXPECT_EQ(pack(particles, order, list, 2, shift), expected) << fields << triclinic;
    }
  }
}

/// Any box: within the rounding of five operations of the exact sum.
TEST(Packing, shifts_are_nearly_exact)
{
  made_particles::Maker maker(5);
  const auto number = [&] { return 0.1 * static_cast<double>(maker.below(20001)) - 1000; };
  for (int i = 0; i < 1000; ++i)
  {
    PeriodicShift shift;
    for (int& count : shift.counts)
    {
      count = static_cast<int>(maker.below(3)) - 1;
    }
    shift.lengths = { number(), number(), number() };
    shift.yz = number();
    shift.xz = number();
    shift.xy = number();
    shift.triclinic = true;
    BondedParticles particles(1, 0);
    particles.add(1, { number(), number(), number() });
    const Vector3& x = particles.x()[0];
    const auto& n = shift.counts;
    using Wide = long double;
    const std::array<Wide, 3> exact = { Wide(x[0]) + n[0] * Wide(shift.lengths[0]) +
        n[5] * Wide(shift.xy) + n[4] * Wide(shift.xz),
      Wide(x[1]) + n[1] * Wide(shift.lengths[1]) + n[3] * Wide(shift.yz),
      Wide(x[2]) + n[2] * Wide(shift.lengths[2]) };
    const Numbers got = pack(particles, orders[1], ParticleRange{ 0, 1 }, 1, shift);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_LE(std::abs(got[axis] - exact[axis]), 4 * 0x1p-53L * 4000);
    }
  }
}

// ---- errors ------------------------------------------------------------------------------------

TEST(Packing, wrong_rows_and_sizes)
{
  BondedParticles particles = made_particles::make(4, 1, 0, 1);
  const auto before = bits_of(particles);
  Numbers buffer(12);
  const std::size_t all = std::numeric_limits<std::size_t>::max();
  const auto packing = [&](const ParticleRows& rows)
  {
    return error_of<LimitError>(
      [&] { granular::pack(particles, PackRoutine::Comm, plain, rows, no_shift, buffer); });
  };
  EXPECT_EQ(packing(ParticleRange{ 1, 4 }), "expected rows of 4 particles, got 4 from 1 on");
  EXPECT_NE(packing(ParticleRange{ 5, 0 }), "");
  EXPECT_NE(packing(ParticleRange{ 2, all }), "");
  EXPECT_NE(packing(ParticleRange{ all, 2 }), "");
  EXPECT_EQ(packing(std::vector<std::size_t>{ 0, 4 }), "expected rows of 4 particles, got row 4");
  EXPECT_EQ(packing(ParticleRange{ 0, 3 }), "expected a buffer of 9 doubles, got 12");
  EXPECT_EQ(packing(ParticleRange{ 0, 4 }), "");

  const auto unpacking = [&](const ParticleRange& rows)
  {
    return error_of<granular::Error>(
      [&] { granular::unpack(particles, PackRoutine::Comm, plain, rows, buffer); });
  };
  EXPECT_EQ(unpacking({ 0, 5 }), "expected 3 doubles of each of 5 particles, got 12");
  EXPECT_NE(unpacking({ 0, all }), "");
  EXPECT_NE(unpacking({ 0, all / 3 + 5 }), ""); // 3 times that is 12
  EXPECT_EQ(unpacking({ 5, 4 }), "expected a first row of at most 4, got 5");
  EXPECT_NE(unpacking({ all, 4 }), "");
  EXPECT_EQ(bits_of(particles), before);
}

TEST(Packing, types_and_masks_that_are_none)
{
  for (const double wrong : { 0.5, std::numeric_limits<double>::quiet_NaN(), 0x1p31, -0x1p31 - 1,
         1e300, -std::numeric_limits<double>::infinity(), 1e-310, 0x1p52, 0x1p64 + 0x1p40 })
  {
    for (const std::size_t at : { 4U, 5U })
    {
      const BondedParticles particles = many(400);
      Numbers buffer = pack(particles, orders[5], ParticleRange{ 0, 400 }, 400);
      buffer[7 * 300 + at] = wrong;
      for (const auto& [first, room] : std::initializer_list<std::pair<std::size_t, std::size_t>>{
             { 0, 400 }, { 300, 400 }, { 300, 800 }, { 400, 400 }, { 400, 800 } })
      {
        BondedParticles others = many(400);
        others.grow(room);
        const ParticleRange range{ first, 400 };
        const std::string text = error_of<FormatError>(
          [&] { granular::unpack(others, PackRoutine::Border, plain, range, buffer); });
        EXPECT_EQ(text.substr(0, text.find(", got")),
          "expected a whole number of 32 bits in double " + std::to_string(7 * 300 + at) +
            " of the buffer, of its particle 300");
        EXPECT_EQ(bits_of(others), bits_of(particles));
      }
    }
  }
}

TEST(Packing, nothing)
{
  BondedParticles none(1, 0);
  for (const Order& order : orders)
  {
    EXPECT_TRUE(pack(none, order, ParticleRange{}, 0).empty());
    granular::unpack(none, order.routine, order.dialect, {}, {});
  }
  granular::unpack_reverse(none, {}, {});
  EXPECT_EQ(none.size(), 0U);
  EXPECT_EQ(none.capacity(), 0U);
}
}
