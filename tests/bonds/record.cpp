// SPDX-License-Identifier: BSD-3-Clause
// Records of restart files.
#include "../support/hard_case.h"
#include "bonds.h"

using namespace bonds;

namespace
{
Object one(std::int32_t history_values)
{
  Object particles = create(3, history_values, 1);
  const granular_bonds_arrays a = arrays_of(particles);
  set(a.x, 1, 2, 3);
  set(a.v, 4, 5, 6);
  a.tag[0] = 21;
  a.type[0] = 5;
  a.mask[0] = 23;
  a.molecule[0] = 24;
  a.image[0] = 1;
  a.image[1] = -512;
  a.image[2] = -511;
  const Numbers history(3, 0.5);
  expect_ok(granular_bonds_add_bond(particles.get(), 0, -1, 22, history.data()));
  expect_ok(granular_bonds_add_bond(particles.get(), 0, 2, 20, history.data()));
  return particles;
}

/// The image has 10 bits a count: 513 + 0 x 2^10 + 1 x 2^20.
const Numbers by_hand = { 22, 1, 2, 3, 21, 5, 23, 1049089, 4, 5, 6, 24, 2, -1, 22, 2, 20, 2, 0.5,
  0.5, 0.5, 0.5 };

constexpr granular_bonds_form image_as_bits = { 0, 1, 10 };
constexpr granular_bonds_form all_as_bits = { 1, 1, 10 };

Words with_bits(const Numbers& record, const std::vector<std::size_t>& places)
{
  Words words = bits_of(record);
  for (const std::size_t at : places)
  {
    words[at] = static_cast<std::uint64_t>(record[at]);
  }
  return words;
}

granular_bonds_status read(const Object& particles, const Numbers& chunk, std::size_t fixes = 0)
{
  return granular_bonds_unpack_record(
    particles.get(), nullptr, fixes, chunk.data(), chunk.size(), nullptr);
}

/// Returns the error of a record, after which the object must be as it was. Empty: it was read.
std::string reading(const Numbers& record, std::size_t fixes = 0)
{
  const Object particles = make(1, 2, 2, 1);
  const auto before = bits_of(particles);
  const granular_bonds_status status = read(particles, record, fixes);
  if (status == GRANULAR_BONDS_OK)
  {
    return "";
  }
  EXPECT_EQ(bits_of(particles), before);
  return message_of(status, GRANULAR_BONDS_FORMAT_ERROR);
}
}

TEST(BondRecords, ByHand)
{
  const Object particles = one(2);
  EXPECT_EQ(pack_record(particles, 0), by_hand);
  EXPECT_EQ(bits_of(pack_record(particles, 0, &image_as_bits)), with_bits(by_hand, { 7 }));
  EXPECT_EQ(bits_of(pack_record(particles, 0, &all_as_bits)), with_bits(by_hand, { 4, 5, 6, 7 }));
  Numbers expected = by_hand;
  expected[0] = 25;
  expected.insert(expected.end(), { 7, 8, 9 });
  EXPECT_EQ(pack_record(particles, 0, nullptr, { 7, 8, 9 }), expected);

  EXPECT_EQ(pack_record(one(0), 0),
    (Numbers{ 17, 1, 2, 3, 21, 5, 23, 1049089, 4, 5, 6, 24, 2, -1, 22, 2, 20 }));
  const Object bare = create(1, 12, 1);
  arrays_of(bare).type[0] = 1;
  EXPECT_EQ(pack_record(bare, 0), // the zero image of 10 bits
    (Numbers{ 14, 0, 0, 0, 0, 1, 1, 537395712, 0, 0, 0, 0, 0, 12 }));
}

/// All that a record holds, read from a chunk of them, with and without what fixes add.
TEST(BondRecords, EveryBitComesBack)
{
  HardCase changed("messages",
    "restart records of bonded particles in all forms: NaN payloads, -0, denormals, the largest "
    "ids and images that fit; changed particles",
    "particles", 0);
  const std::vector<std::int64_t> ids = { 0, -1, std::int64_t{ 1 } << 53, -5'000'000'000, 9 };
  for (const std::int32_t history_values : { 0, 1, 14 })
  {
    for (const granular_bonds_form& form : { granular_bonds_form{ 0, 0, 10 }, image_as_bits,
           granular_bonds_form{ 1, 1, 21 }, all_as_bits })
    {
      const Object particles = make(60, 4, history_values, 9);
      const granular_bonds_arrays a = arrays_of(particles);
      for (const auto& not_sent : { a.x_mol, a.v_mol, a.f })
      {
        std::fill_n(not_sent, 180, 0.0);
      }
      const std::int32_t half = 1 << (form.image_bits - 1);
      Numbers chunk;
      for (std::size_t i = 0; i < a.size; ++i)
      {
        a.type[i] = i % 2 ? 1 : Limits32::max();
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          a.image[3 * i + axis] = (i + axis) % 3 == 0 ? 0 : (i + axis) % 3 == 1 ? half - 1 : -half;
        }
        a.molecule[i] = ids[i % ids.size()];
        a.tag[i] = form.integers_as_bits ? a.tag[i] : ids[i % ids.size()];
        std::fill_n(a.partners + 4 * i, 4, ids[(i + 1) % ids.size()]);
        const Numbers record = pack_record(particles, i, &form, Numbers(i % 3, 77));
        chunk.insert(chunk.end(), record.begin(), record.end());
      }
      const Object others = create(4, history_values);
      std::size_t place = 0;
      for (std::size_t i = 0; i < a.size; ++i)
      {
        std::size_t doubles = 0;
        expect_ok(granular_bonds_unpack_record(
          others.get(), &form, i % 3, chunk.data() + place, chunk.size() - place, &doubles));
        EXPECT_TRUE(i % 3 == 0 || chunk[place + doubles - 1] == 77);
        place += doubles;
      }
      EXPECT_EQ(place, chunk.size());
      const auto sent = bits_of(particles);
      const auto came = bits_of(others);
      for (std::size_t i = 0; i < a.size; ++i)
      {
        changed.add(came[i] == sent[i] ? 0 : 1);
      }
    }
  }
}

TEST(BondRecords, NumbersThatNoRecordCanHold)
{
  const auto writing = [](const auto& change, const granular_bonds_form& form,
                         granular_bonds_status status = GRANULAR_BONDS_LIMIT_ERROR)
  {
    const Object particles = one(1);
    change(arrays_of(particles));
    Numbers record(20);
    std::size_t doubles = 0;
    return message_of(granular_bonds_pack_record(particles.get(), 0, &form, nullptr, 0,
                        record.data(), record.size(), &doubles),
      status);
  };
  const granular_bonds_form usual = { 0, 0, 10 };
  const granular_bonds_form wide = { 0, 0, 21 };
  const std::int64_t large = (std::int64_t{ 1 } << 53) + 1;
  const auto tag = [&](const granular_bonds_arrays& a) { a.tag[0] = -large; };
  EXPECT_EQ(writing(tag, usual),
    "expected a tag of at most 2^53 to write it as a value, got -9007199254740993 of particle 0");
  writing(tag, all_as_bits, GRANULAR_BONDS_OK);
  writing([&](const granular_bonds_arrays& a) { a.molecule[0] = large; }, all_as_bits);
  writing([&](const granular_bonds_arrays& a) { a.partners[1] = large; }, all_as_bits);
  EXPECT_EQ(writing([](const granular_bonds_arrays& a) { a.type[0] = 0; }, usual),
    "expected a type from 1 of particle 0, got 0");
  EXPECT_EQ(writing([](const granular_bonds_arrays& a) { a.image[2] = 512; }, usual),
    "expected an image count from -512 to 511, got 512 of particle 0");
  const auto image = [](std::int32_t x, std::int32_t z)
  {
    return [=](const granular_bonds_arrays& a)
    {
      a.image[0] = x;
      a.image[1] = x == 0 ? -512 : 0;
      a.image[2] = z;
    };
  };
  writing(image(0, 512), wide, GRANULAR_BONDS_OK);
  writing(image(1, 0), wide); // 2^62 and 1: more bits than a double has
  for (const int bits : { 0, 9, 20, 64 })
  {
    EXPECT_EQ(
      writing([](const granular_bonds_arrays&) {}, { 0, 0, bits }, GRANULAR_BONDS_BAD_ARGUMENT),
      "expected 10 or 21 bits of an image count, got " + std::to_string(bits));
  }
  std::size_t doubles = 0;
  EXPECT_EQ(message_of(granular_bonds_pack_record(
                         one(1).get(), 1, nullptr, nullptr, 0, nullptr, 0, &doubles),
              GRANULAR_BONDS_BAD_ARGUMENT),
    "expected a particle below 1, got 1");
  Numbers small(19);
  EXPECT_EQ(message_of(granular_bonds_pack_record(
                         one(1).get(), 0, nullptr, nullptr, 0, small.data(), 19, &doubles),
              GRANULAR_BONDS_BAD_ARGUMENT),
    "expected room for 20 doubles, got 19");
}

/// Doubles behind the bonds are n_h and history, or of fixes: only their number tells.
TEST(BondRecords, DoublesOfFixes)
{
  // no bonds, then these; n_h is 12 and need not be there
  const auto status_of = [](const Numbers& behind, std::size_t fixes)
  {
    Numbers record = { 13, 0, 0, 0, 1, 1, 1, 537395712, 0, 0, 0, 0, 0 };
    record.insert(record.end(), behind.begin(), behind.end());
    record[0] = static_cast<double>(record.size());
    return read(create(2, 12), record, fixes);
  };
  expect_ok(status_of({}, 0));
  expect_ok(status_of({ 12 }, 0));
  expect_ok(status_of({ 12 }, 1));
  expect_ok(status_of({ 12, 5 }, 1));
  expect_ok(status_of({ 12, 5 }, 2));
  expect_ok(status_of({ 12, 12 }, 1));
  message_of(status_of({ 12, 5 }, 0), GRANULAR_BONDS_FORMAT_ERROR);
  message_of(status_of({ 11, 5 }, 1), GRANULAR_BONDS_FORMAT_ERROR);
  message_of(status_of({ 12, 5, 5 }, 1), GRANULAR_BONDS_FORMAT_ERROR);

  // a history that the object does not have is not of fixes, unless it is said to be
  const Object particles = create(3, 0);
  for (std::size_t fixes = 0; fixes < 10; ++fixes)
  {
    message_of(read(particles, by_hand, fixes),
      fixes == 5 ? GRANULAR_BONDS_OK : GRANULAR_BONDS_FORMAT_ERROR);
  }
  EXPECT_NE(reading(by_hand, std::numeric_limits<std::size_t>::max()), "");
}

TEST(BondRecords, ErrorsByHand)
{
  const auto with = [](std::size_t at, double value)
  {
    Numbers bad = by_hand;
    bad[at] = value;
    return reading(bad);
  };
  const std::string place = ", in the record of particle 1";
  EXPECT_EQ(reading(by_hand), "");
  EXPECT_EQ(with(0, 23), "expected the length of a record from 13 to 22, got 23" + place);
  EXPECT_EQ(with(0, 21.5), "expected the length of a record from 13 to 22, got 21.5" + place);
  for (const auto& [at, value] : std::vector<std::pair<std::size_t, double>>{
         { 0, 12 }, { 0, 21 }, { 12, 1 }, { 12, 3 }, { 12, 1e9 }, { 17, 3 }, { 5, 0 } })
  {
    EXPECT_NE(with(at, value), "") << at << ' ' << value;
  }
  EXPECT_EQ(with(6, 1e10), "expected a mask of 32 bits, got 10000000000" + place);
  EXPECT_EQ(with(13, 0.5), "expected a whole number of 64 bits, got 0.5" + place);
  EXPECT_EQ(
    with(7, 0x1p50), "expected an image of three counts of 10 bits, got 1125899906842624" + place);
  EXPECT_EQ(reading({}), "expected a record, got the end of the chunk" + place);
  EXPECT_NE(reading(by_hand, 1), "");
  EXPECT_NE(reading(by_hand, 23), "");
}

TEST(BondRecords, EveryTruncationAndChangedDouble)
{
  int refused = 0;
  for (std::size_t size = 0; size < by_hand.size(); ++size)
  {
    EXPECT_NE(reading({ by_hand.begin(), by_hand.begin() + std::ptrdiff_t(size) }), "");
  }
  for (std::size_t at = 0; at < by_hand.size(); ++at)
  {
    for (const double value : { 0.0, -1.0, 0.5, Doubles::quiet_NaN(), Doubles::infinity(), 1e300,
           by_hand[at] + 1, 0x1p63, -0x1p63 })
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
