// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/restart_record.h"

#include "made_particles.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace
{
using granular::BondedParticles;
using granular::FormatError;
using granular::LimitError;
using granular::RecordForm;
using granular::WholeNumbers;
using made_particles::bits_of;
using Numbers = std::vector<double>;

constexpr auto values = WholeNumbers::Values;
constexpr auto as_bits = WholeNumbers::Bits;

BondedParticles one(std::int32_t history_values)
{
  BondedParticles particles(3, history_values);
  particles.add(5, { 1, 2, 3 });
  particles.v()[0] = { 4, 5, 6 };
  particles.tag()[0] = 21;
  particles.mask()[0] = 23;
  particles.molecule()[0] = 24;
  particles.image()[0] = { 1, -512, -511 };
  const Numbers history(static_cast<std::size_t>(history_values), 0.5);
  particles.add_bond(0, -1, 22, history);
  particles.add_bond(0, 2, 20, history);
  return particles;
}

Numbers write(const BondedParticles& particles, std::size_t i, const RecordForm& form,
  const Numbers& fixes = {})
{
  Numbers record;
  granular::append_record(particles, i, form, fixes, record);
  return record;
}

Numbers with_bits(const Numbers& record, const std::vector<std::size_t>& places)
{
  Numbers changed = record;
  for (const std::size_t at : places)
  {
    changed[at] = std::bit_cast<double>(static_cast<std::int64_t>(record[at]));
  }
  return changed;
}

/// Of 10 bits: 513 + 0 x 2^10 + 1 x 2^20.
const Numbers by_hand = { 22, 1, 2, 3, 21, 5, 23, 1049089, 4, 5, 6, 24, 2, -1, 22, 2, 20, 2, 0.5,
  0.5, 0.5, 0.5 };

TEST(RestartRecord, by_hand)
{
  const BondedParticles particles = one(2);
  EXPECT_EQ(granular::record_doubles(particles, 0), 22U);
  EXPECT_EQ(write(particles, 0, {}), by_hand);
  EXPECT_EQ(write(particles, 0, { values, as_bits, 10 }), with_bits(by_hand, { 7 }));
  EXPECT_EQ(write(particles, 0, { as_bits, as_bits, 10 }), with_bits(by_hand, { 4, 5, 6, 7 }));
  Numbers expected = by_hand;
  expected[0] = 25;
  expected.insert(expected.end(), { 7, 8, 9 });
  EXPECT_EQ(write(particles, 0, {}, { 7, 8, 9 }), expected);

  EXPECT_EQ(write(one(0), 0, {}),
    (Numbers{ 17, 1, 2, 3, 21, 5, 23, 1049089, 4, 5, 6, 24, 2, -1, 22, 2, 20 }));
  BondedParticles bare(1, 12);
  bare.add(1, {});
  EXPECT_EQ(write(bare, 0, {}), // the zero image of 10 bits
    (Numbers{ 14, 0, 0, 0, 0, 1, 1, 537395712, 0, 0, 0, 0, 0, 12 }));
}

/// All that a record holds, read from a chunk of them, with and without what fixes add.
TEST(RestartRecord, every_bit_comes_back)
{
  for (const std::int32_t history_values : { 0, 1, 14 })
  {
    for (const RecordForm& form :
      { RecordForm{ values, values, 10 }, RecordForm{ values, as_bits, 10 },
        RecordForm{ as_bits, as_bits, 21 }, RecordForm{ as_bits, as_bits, 10 } })
    {
      BondedParticles particles = made_particles::make(60, 4, history_values, 9);
      const std::int32_t half = 1 << (form.image_bits - 1);
      const std::vector<std::int64_t> ids = { 0, -1, std::int64_t{ 1 } << 53, -5'000'000'000, 9 };
      Numbers chunk;
      for (std::size_t i = 0; i < particles.size(); ++i)
      {
        particles.type()[i] = i % 2 ? 1 : std::numeric_limits<std::int32_t>::max();
        particles.image()[i] = i % 2 ? granular::ImageCounts{ -half, half - 1, 0 }
                                     : granular::ImageCounts{ half - 1, -1, half - 1 };
        particles.molecule()[i] = ids[i % ids.size()];
        particles.x_mol()[i] = particles.v_mol()[i] = particles.f()[i] = {};
        particles.tag()[i] = form.numbers == values ? ids[i % ids.size()] : particles.tag()[i];
        for (std::int64_t& partner : particles.partners(i))
        {
          partner = ids[i % ids.size()];
        }
        granular::append_record(particles, i, form, Numbers(i % 3, 77), chunk);
      }
      BondedParticles others(4, history_values);
      std::size_t place = 0;
      for (std::size_t i = 0; i < particles.size(); ++i)
      {
        const auto read = granular::read_record(chunk, place, form, i % 3, others);
        EXPECT_EQ(read.fixes.size(), i % 3);
        EXPECT_TRUE(read.fixes.empty() || read.fixes[0] == 77);
        place += read.size;
      }
      EXPECT_EQ(place, chunk.size());
      EXPECT_EQ(bits_of(others), bits_of(particles));
    }
  }
}

template <class Failure, class Work>
std::string text_of(const Work& work)
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

TEST(RestartRecord, what_no_record_can_hold)
{
  const auto writing = [](const auto& change, const RecordForm& form)
  {
    BondedParticles particles = one(1);
    change(particles);
    Numbers records = { 1, 2 };
    const std::string text =
      text_of<LimitError>([&] { granular::append_record(particles, 0, form, {}, records); });
    EXPECT_TRUE(text.empty() || records == (Numbers{ 1, 2 }));
    return text;
  };
  const std::int64_t large = (std::int64_t{ 1 } << 53) + 1;
  const auto tag = [&](BondedParticles& particles) { particles.tag()[0] = -large; };
  EXPECT_EQ(writing(tag, {}),
    "expected a tag of at most 2^53 to write it as a value, got -9007199254740993 of particle 0");
  EXPECT_EQ(writing(tag, { as_bits, values, 10 }), "");
  EXPECT_NE(
    writing([&](auto& particles) { particles.molecule()[0] = large; }, { as_bits, as_bits, 10 }),
    "");
  EXPECT_NE(
    writing([&](auto& particles) { particles.partners(0)[1] = large; }, { as_bits, as_bits, 10 }),
    "");
  EXPECT_EQ(writing([](auto& particles) { particles.type()[0] = 0; }, {}),
    "expected a type from 1 of particle 0, got 0");
  EXPECT_EQ(writing([](auto& particles) { particles.image()[0].z = 512; }, {}),
    "expected an image count from -512 to 511, got 512 of particle 0");
  EXPECT_EQ(writing(
              [](auto& particles) {
                particles.image()[0] = { 0, -512, 512 };
              },
              { values, values, 21 }),
    "");
  // 2^62 and 1: more bits than a double has
  EXPECT_NE(writing(
              [](auto& particles) {
                particles.image()[0] = { 1, 0, 0 };
              },
              { values, values, 21 }),
    "");
  BondedParticles particles = one(1);
  Numbers records;
  EXPECT_EQ(text_of<LimitError>([&] { granular::append_record(particles, 1, {}, {}, records); }),
    "expected a particle below 1, got 1");
}

/// Reads a record behind two other doubles; the object must be as it was if that is refused.
std::string reading(const Numbers& record, std::size_t fixes = 0)
{
  Numbers chunk = { 99, 99 };
  chunk.insert(chunk.end(), record.begin(), record.end());
  BondedParticles particles(2, 2);
  particles.add(1, {});
  const auto before = bits_of(particles);
  const std::string text =
    text_of<FormatError>([&] { granular::read_record(chunk, 2, {}, fixes, particles); });
  EXPECT_TRUE(text.empty() || bits_of(particles) == before);
  return text;
}

/// Whether doubles behind the bonds are n_h and history or of fixes: only their number tells.
TEST(RestartRecord, what_is_of_fixes)
{
  // no bonds, then these; n_h is 12 and need not be there
  const auto fixes_of = [](const Numbers& behind, std::size_t count)
  {
    Numbers record = { 13, 0, 0, 0, 1, 1, 1, 537395712, 0, 0, 0, 0, 0 };
    record.insert(record.end(), behind.begin(), behind.end());
    record[0] = static_cast<double>(record.size());
    BondedParticles particles(2, 12);
    const auto fixes = granular::read_record(record, 0, {}, count, particles).fixes;
    return Numbers(fixes.begin(), fixes.end());
  };
  EXPECT_EQ(fixes_of({}, 0), Numbers{});
  EXPECT_EQ(fixes_of({ 12 }, 0), Numbers{});
  EXPECT_EQ(fixes_of({ 12 }, 1), Numbers{ 12 });
  EXPECT_EQ(fixes_of({ 12, 5 }, 1), Numbers{ 5 });
  EXPECT_EQ(fixes_of({ 12, 5 }, 2), (Numbers{ 12, 5 }));
  EXPECT_EQ(fixes_of({ 12, 12 }, 1), Numbers{ 12 });
  EXPECT_THROW(fixes_of({ 12, 5 }, 0), FormatError);
  EXPECT_THROW(fixes_of({ 11, 5 }, 1), FormatError);
  EXPECT_THROW(fixes_of({ 12, 5, 5 }, 1), FormatError);

  // a history that the object does not have is not of fixes, unless it is said to be
  BondedParticles particles(3, 0);
  for (std::size_t fixes = 0; fixes < 10; ++fixes)
  {
    if (fixes == 5)
    {
      EXPECT_EQ(granular::read_record(by_hand, 0, {}, fixes, particles).fixes.size(), fixes);
      continue;
    }
    EXPECT_THROW(granular::read_record(by_hand, 0, {}, fixes, particles), FormatError) << fixes;
  }
  EXPECT_EQ(particles.size(), 1U);
  EXPECT_NE(reading(by_hand, std::numeric_limits<std::size_t>::max()), "");
}

TEST(RestartRecord, errors_by_hand)
{
  const auto with = [](std::size_t at, double value)
  {
    Numbers bad = by_hand;
    bad[at] = value;
    return reading(bad);
  };
  const std::string place = ", in the record of particle 1 from double 2 on";
  EXPECT_EQ(reading(by_hand), "");
  EXPECT_EQ(with(0, 23), "expected the length of a record from 13 to 22, got 23" + place);
  EXPECT_EQ(with(0, 21.5), "expected the length of a record from 13 to 22, got 21.5" + place);
  EXPECT_NE(with(0, 12), "");
  EXPECT_NE(with(0, 21), "");
  EXPECT_NE(with(12, 1), "");
  EXPECT_NE(with(12, 3), ""); // more than there is room for
  EXPECT_NE(with(12, 1e9), "");
  EXPECT_NE(with(17, 3), "");
  EXPECT_EQ(with(6, 1e10), "expected a mask of 32 bits, got 10000000000" + place);
  EXPECT_EQ(with(13, 0.5), "expected a whole number of 64 bits, got 0.5" + place);
  EXPECT_NE(with(5, 0), "");
  EXPECT_EQ(
    with(7, 0x1p50), "expected an image of three counts of 10 bits, got 1125899906842624" + place);
  EXPECT_EQ(reading({}), "expected a record, got the end of the chunk" + place);
  EXPECT_NE(reading(by_hand, 1), "");
  EXPECT_NE(reading(by_hand, 23), "");
}

TEST(RestartRecord, every_truncation_and_changed_double)
{
  int refused = 0;
  for (std::size_t size = 0; size < by_hand.size(); ++size)
  {
    EXPECT_NE(reading({ by_hand.begin(), by_hand.begin() + std::ptrdiff_t(size) }), "");
  }
  for (std::size_t at = 0; at < by_hand.size(); ++at)
  {
    for (const double value : { 0.0, -1.0, 0.5, std::numeric_limits<double>::quiet_NaN(),
           std::numeric_limits<double>::infinity(), 1e300, by_hand[at] + 1, 0x1p63, -0x1p63 })
    {
      Numbers bad = by_hand;
      bad[at] = value;
      refused += reading(bad).empty() ? 0 : 1;
      bad.insert(bad.end(), { 3, 0.5 });
      bad[0] += 2;
      refused += reading(bad, 2).empty() ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 100);
}
}
