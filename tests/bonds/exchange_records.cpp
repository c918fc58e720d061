// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/exchange_packing.h"
#include "granular/bonds/id_numbers.h"

#include "made_particles.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{
using granular::BondedParticles;
using granular::PackDialect;
using granular::ParticleRange;
using granular::ParticleRows;
using made_particles::bits_of;
using Numbers = std::vector<double>;

constexpr PackDialect pfm = PackDialect::Pfm;
constexpr PackDialect plain = PackDialect::WithBonds;

Numbers pack(const BondedParticles& particles, PackDialect dialect, const ParticleRows& rows)
{
  Numbers buffer(granular::exchange_doubles(particles, dialect, rows));
  granular::pack_exchange(particles, dialect, rows, buffer);
  return buffer;
}

/// Everything but the force, and what WithBonds does not send.
std::vector<made_particles::Bits> sent_bits(const BondedParticles& particles, PackDialect dialect)
{
  std::vector<made_particles::Bits> all;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    all.push_back(bits_of(particles, i));
    if (dialect == plain)
    {
      all.back().reals.erase(all.back().reals.begin() + 6, all.back().reals.begin() + 12);
    }
  }
  return all;
}

BondedParticles two()
{
  BondedParticles particles(2, 3);
  particles.add(5, { 1, 2, 3 });
  particles.v()[0] = { 4, 5, 6 };
  particles.f()[0] = { 7, 8, 9 };
  particles.x_mol()[0] = { 10, 11, 12 };
  particles.v_mol()[0] = { 13, 14, 15 };
  particles.tag()[0] = 21;
  particles.mask()[0] = 23;
  particles.molecule()[0] = 24;
  particles.image()[0] = { -1048576, -1048576 + 3, -1048576 }; // 3 x 2^21
  particles.add_bond(0, -1, 4607182418800017408, Numbers{ 31, 32, 33 });
  particles.add_bond(0, 2, 21, Numbers{ 34, 35, 36 });
  particles.add(6, { -1, -2, -3 });
  return particles;
}

/// The zero image is 2^20 + 2^41 + 2^62, which is larger than 2^53: its bits are sent.
TEST(Exchange, by_hand)
{
  const double swapped = std::numeric_limits<double>::denorm_min(); // the bits of the integer 1
  const double no_image = std::bit_cast<double>(
    (std::uint64_t{ 1 } << 20) + (std::uint64_t{ 1 } << 41) + (std::uint64_t{ 1 } << 62));
  const BondedParticles particles = two();
  EXPECT_EQ(pack(particles, pfm, ParticleRange{ 0, 2 }),
    (Numbers{ 32, 1, 2, 3, 4, 5, 6, 21, 5, 23, 6291456, 24, 10, 11, 12, 13, 14, 15, 2, -1, swapped,
      2, 21, 31, 32, 33, 34, 35, 36, 0, 0, 0, //
      22, -1, -2, -3, 0, 0, 0, 0, 6, 1, no_image, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }));
  EXPECT_EQ(pack(particles, plain, std::vector<std::size_t>{ 1, 0 }),
    (Numbers{ 16, -1, -2, -3, 0, 0, 0, 0, 6, 1, no_image, 0, 0, 0, 0, 0, //
      26, 1, 2, 3, 4, 5, 6, 21, 5, 23, 6291456, 24, 2, -1, swapped, 2, 21, 31, 32, 33, 34, 35, 36,
      0, 0, 0 }));
}

TEST(Exchange, every_bit_comes_back)
{
  for (const auto& [most_bonds, values] :
    { std::pair(1, 0), std::pair(3, 2), std::pair(12, 14), std::pair(1, 1) })
  {
    for (const PackDialect dialect : { pfm, plain })
    {
      const BondedParticles particles = made_particles::make(200, most_bonds, values, 6);
      const Numbers buffer = pack(particles, dialect, ParticleRange{ 0, 200 });
      BondedParticles others(most_bonds + 1, values); // their room for bonds is their own
      EXPECT_EQ(granular::unpack_exchange(others, dialect, buffer), 200U);
      EXPECT_EQ(sent_bits(others, dialect), sent_bits(particles, dialect));
      EXPECT_EQ(bits_of(others)[7].reals.back(), 0U); // no force
      EXPECT_EQ(granular::unpack_exchange(others, dialect, buffer), 200U);
      EXPECT_EQ(others.size(), 400U);
    }
  }
}

TEST(Exchange, nothing)
{
  BondedParticles none(1, 0);
  EXPECT_TRUE(pack(none, pfm, ParticleRange{}).empty());
  EXPECT_EQ(granular::unpack_exchange(none, pfm, {}), 0U);
  EXPECT_EQ(none.capacity(), 0U);
}

TEST(Exchange, image_beyond_its_field)
{
  BondedParticles particles = made_particles::make(3, 1, 0, 1);
  Numbers buffer(granular::exchange_doubles(particles, pfm, ParticleRange{ 0, 3 }));
  for (const std::int32_t wrong : { (1 << 20), -(1 << 20) - 1 })
  {
    particles.image()[2].y = wrong;
    try
    {
      granular::pack_exchange(particles, pfm, ParticleRange{ 0, 3 }, buffer);
      FAIL();
    }
    catch (const granular::LimitError& error)
    {
      EXPECT_EQ(error.text(),
        "expected an image count from -1048576 to 1048575, got " + std::to_string(wrong) +
          " of particle 2");
    }
  }
}

// ---- damage ------------------------------------------------------------------------------------

/// What is said of a buffer; the object must then be as it was. Empty: it was unpacked.
template <class Failure = granular::FormatError>
std::string text_of(const Numbers& buffer, PackDialect dialect, std::int32_t most_bonds = 2)
{
  BondedParticles others(most_bonds, 3);
  others.add(1, { 1, 2, 3 });
  const auto before = bits_of(others);
  try
  {
    granular::unpack_exchange(others, dialect, buffer);
    return {};
  }
  catch (const Failure& error)
  {
    EXPECT_EQ(bits_of(others), before);
    EXPECT_EQ(others.capacity(), BondedParticles::growth);
    return error.text();
  }
}

TEST(Exchange, errors_by_hand)
{
  const Numbers good = pack(two(), plain, std::vector<std::size_t>{ 1, 0 });
  ASSERT_EQ(text_of(good, plain), "");
  const auto with = [&](std::size_t at, double value)
  {
    Numbers bad = good;
    bad[at] = value;
    return bad;
  };
  EXPECT_EQ(text_of(with(16, 27), plain),
    "expected the length of a record from 16 to the end, which is at double 42, in double 16 of "
    "the "
    "buffer, of its particle 1, got 27");
  EXPECT_EQ(text_of(with(16, 25), plain),
    "expected the length 26 of a record of 2 bonds with 3 history values in double 16 of the "
    "buffer, "
    "of its particle 1, got 25");
  EXPECT_EQ(text_of(with(28, 3), plain),
    "expected a number of bonds from 0 to 2 in double 28 of the buffer, of its particle 1, got 3");
  EXPECT_EQ(text_of(with(29, 1.5), plain),
    "expected a bond type, a whole number of 32 bits, in double 29 of the buffer, of its particle "
    "1, "
    "got 1.5");
  EXPECT_EQ(text_of(with(24, 1e10), plain),
    "expected a whole number of 32 bits in double 24 of the buffer, of its particle 1, got "
    "1e+10");
  EXPECT_EQ(text_of(with(26, -3), plain),
    "expected an image of three counts of 21 bits in double 26 of the buffer, of its particle 1, "
    "got -3");
  EXPECT_EQ(text_of<granular::UnsupportedError>(with(39, 2), plain),
    "expected no special neighbours in double 39 of the buffer, of its particle 1, got 2");
  EXPECT_EQ(text_of(with(41, -1), plain),
    "expected a number of special neighbours in double 41 of the buffer, of its particle 1, got "
    "-1");
  EXPECT_NE(text_of(good, pfm), "");
  EXPECT_NE(text_of(good, plain, 1), "");
}

/// A record with a list of special neighbours, as the programs would send it.
TEST(Exchange, special_neighbours_are_refused)
{
  Numbers buffer = pack(two(), pfm, ParticleRange{ 1, 1 });
  buffer[0] = 24;
  buffer[20] = 1;
  buffer[21] = 2;
  buffer.push_back(17);
  buffer.push_back(18);
  EXPECT_EQ(text_of<granular::UnsupportedError>(buffer, pfm),
    "expected no special neighbours in double 20 of the buffer, of its particle 0, got 1");
}

TEST(Exchange, every_truncation_is_refused)
{
  for (const PackDialect dialect : { pfm, plain })
  {
    const Numbers good = pack(two(), dialect, ParticleRange{ 0, 2 });
    const auto first = static_cast<std::size_t>(good[0]);
    for (std::size_t size = 1; size < good.size(); ++size)
    {
      const std::string text =
        text_of<granular::Error>({ good.begin(), good.begin() + std::ptrdiff_t(size) }, dialect);
      EXPECT_EQ(text.empty(), size == first) << size;
    }
    for (std::size_t begin = 1; begin < good.size(); ++begin)
    {
      const std::string text =
        text_of<granular::Error>({ good.begin() + std::ptrdiff_t(begin), good.end() }, dialect);
      EXPECT_EQ(text.empty(), begin == first) << begin;
    }
  }
}

/// Every double becomes another one: an error, or what packs into the same doubles again.
TEST(Exchange, every_changed_double_is_refused_or_kept)
{
  int refused = 0;
  int kept = 0;
  for (const PackDialect dialect : { pfm, plain })
  {
    const Numbers good = pack(two(), dialect, ParticleRange{ 0, 2 });
    for (std::size_t at = 0; at < good.size(); ++at)
    {
      for (const double value : { 0.0, -1.0, 0.5, std::numeric_limits<double>::quiet_NaN(),
             std::numeric_limits<double>::infinity(), 1e300, 1.0, 3.0, good[at] + 1, good[at] - 1,
             0x1p63, -0x1p63, 0x1p64, 4294967296.0 })
      {
        Numbers bad = good;
        bad[at] = value;
        BondedParticles others(2, 3);
        try
        {
          granular::unpack_exchange(others, dialect, bad);
          ++kept;
        }
        catch (const granular::Error& error)
        {
          EXPECT_NE(error.text().find(" of the buffer, of its particle "), std::string::npos);
          EXPECT_EQ(others.size(), 0U);
          ++refused;
          continue;
        }
        const Numbers again = pack(others, dialect, ParticleRange{ 0, others.size() });
        ASSERT_EQ(again.size(), bad.size());
        for (std::size_t i = 0; i < bad.size(); ++i)
        {
          ASSERT_EQ(std::bit_cast<std::uint64_t>(again[i]), std::bit_cast<std::uint64_t>(bad[i]))
            << at << ' ' << value;
        }
      }
    }
  }
  EXPECT_GT(refused, 200);
  EXPECT_GT(kept, 500);
}
}
