// SPDX-License-Identifier: BSD-3-Clause
// Records of particles that change their rank.
#include "../support/hard_case.h"
#include "bonds.h"

#include <utility>

using namespace bonds;

namespace
{
constexpr int exchange = GRANULAR_BONDS_EXCHANGE;

Object two()
{
  Object particles = create(2, 3, 2);
  const granular_bonds_arrays a = arrays_of(particles);
  set(a.x, 1, 2, 3);
  set(a.v, 4, 5, 6);
  set(a.f, 7, 8, 9);
  set(a.x_mol, 10, 11, 12);
  set(a.v_mol, 13, 14, 15);
  a.tag[0] = 21;
  a.type[0] = 5;
  a.mask[0] = 23;
  a.molecule[0] = 24;
  a.image[0] = a.image[2] = -1048576;
  a.image[1] = -1048576 + 3; // 3 x 2^21
  const double first[] = { 31, 32, 33 };
  const double second[] = { 34, 35, 36 };
  expect_ok(granular_bonds_add_bond(particles.get(), 0, -1, 4607182418800017408, first));
  expect_ok(granular_bonds_add_bond(particles.get(), 0, 2, 21, second));
  set(a.x + 3, -1, -2, -3);
  a.type[1] = 6;
  return particles;
}

/// Returns the error of a buffer, after which the object must be as it was. Empty: it was unpacked.
std::string text_of(
  const Numbers& buffer, int dialect, granular_bonds_status expected, std::int32_t most_bonds = 2)
{
  const Object others = make(1, most_bonds, 3, 1);
  const auto before = bits_of(others);
  const std::string text = message_of(unpack(others, exchange + dialect, 1, buffer), expected);
  if (expected != GRANULAR_BONDS_OK)
  {
    EXPECT_EQ(bits_of(others), before);
    EXPECT_EQ(arrays_of(others).capacity, 10000U);
  }
  return text;
}
}

/// The zero image is 2^20 + 2^41 + 2^62, which is larger than 2^53: its bits are sent.
TEST(BondExchange, ByHand)
{
  const double swapped = Doubles::denorm_min(); // the bits of the integer 1
  const double no_image = std::bit_cast<double>(
    (std::uint64_t{ 1 } << 20) + (std::uint64_t{ 1 } << 41) + (std::uint64_t{ 1 } << 62));
  const Object particles = two();
  EXPECT_EQ(pack_all(particles, exchange),
    (Numbers{ 32, 1, 2, 3, 4, 5, 6, 21, 5, 23, 6291456, 24, 10, 11, 12, 13, 14, 15, 2, -1, swapped,
      2, 21, 31, 32, 33, 34, 35, 36, 0, 0, 0, //
      22, -1, -2, -3, 0, 0, 0, 0, 6, 1, no_image, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }));
  const std::int32_t rows[] = { 1, 0 };
  EXPECT_EQ(pack(particles, exchange + plain, 0, 2, rows),
    (Numbers{ 16, -1, -2, -3, 0, 0, 0, 0, 6, 1, no_image, 0, 0, 0, 0, 0, //
      26, 1, 2, 3, 4, 5, 6, 21, 5, 23, 6291456, 24, 2, -1, swapped, 2, 21, 31, 32, 33, 34, 35, 36,
      0, 0, 0 }));
}

/// All but the force, and what WITH-BONDS does not send.
TEST(BondExchange, EveryBitComesBack)
{
  HardCase changed("messages",
    "bonded particles that change their rank, all fields, bonds and histories: NaN payloads, -0, "
    "denormals, ids beyond 2^53; changed ones",
    "particles", 0);
  for (const auto& [most_bonds, values] :
    { std::pair(1, 0), std::pair(3, 2), std::pair(12, 14), std::pair(1, 1) })
  {
    for (const int dialect : { pfm, plain })
    {
      const Object particles = make(200, most_bonds, values, 6);
      const Numbers buffer = pack_all(particles, exchange + dialect);
      const granular_bonds_arrays a = arrays_of(particles);
      std::fill_n(a.f, 600, 0.0);
      for (double* const not_sent : { a.x_mol, a.v_mol })
      {
        std::fill_n(not_sent, dialect == plain ? 600 : 0, 0.0);
      }
      const Object others = create(most_bonds + 1, values, 3); // their room for bonds is their own
      std::size_t count = 0;
      expect_ok(granular_bonds_unpack(
        others.get(), exchange + dialect, 3, nullptr, buffer.data(), buffer.size(), &count));
      EXPECT_EQ(count, 200U);
      const auto sent = bits_of(particles);
      const auto came = bits_of(others);
      for (std::size_t i = 0; i < 200; ++i)
      {
        changed.add(came[3 + i] == sent[i] ? 0 : 1);
      }
    }
  }
}

TEST(BondExchange, ImageBeyondItsField)
{
  const Object particles = make(3, 1, 0, 1);
  Numbers buffer(100);
  std::size_t doubles = 0;
  for (const std::int32_t wrong : { (1 << 20), -(1 << 20) - 1 })
  {
    arrays_of(particles).image[3 * 2 + 1] = wrong;
    EXPECT_EQ(message_of(granular_bonds_pack(particles.get(), exchange, 0, 3, nullptr, nullptr,
                           buffer.data(), 100, &doubles),
                GRANULAR_BONDS_LIMIT_ERROR),
      "expected an image count from -1048576 to 1048575, got " + std::to_string(wrong) +
        " of particle 2");
  }
}

TEST(BondExchange, ErrorsByHand)
{
  const std::int32_t rows[] = { 1, 0 };
  const Numbers good = pack(two(), exchange + plain, 0, 2, rows);
  EXPECT_EQ(text_of(good, plain, GRANULAR_BONDS_OK), "");
  const auto with =
    [&](std::size_t at, double value, granular_bonds_status status = GRANULAR_BONDS_FORMAT_ERROR)
  {
    Numbers bad = good;
    bad[at] = value;
    return text_of(bad, plain, status);
  };
  const auto place = [](int at)
  { return " in double " + std::to_string(at) + " of the buffer, of its particle 1, got "; };
  EXPECT_EQ(with(16, 27),
    "expected the length of a record from 16 to the end, which is at double 42," + place(16) +
      "27");
  EXPECT_EQ(with(16, 25),
    "expected the length 26 of a record of 2 bonds with 3 history values" + place(16) + "25");
  EXPECT_EQ(with(28, 3), "expected a number of bonds from 0 to 2" + place(28) + "3");
  EXPECT_EQ(with(29, 1.5), "expected a bond type, a whole number of 32 bits," + place(29) + "1.5");
  EXPECT_EQ(with(24, 1e10), "expected a whole number of 32 bits" + place(24) + "1e+10");
  EXPECT_EQ(with(26, -3), "expected an image of three counts of 21 bits" + place(26) + "-3");
  EXPECT_EQ(
    with(39, 2, GRANULAR_BONDS_UNSUPPORTED), "expected no special neighbours" + place(39) + "2");
  EXPECT_EQ(with(41, -1), "expected a number of special neighbours" + place(41) + "-1");
  text_of(good, pfm, GRANULAR_BONDS_FORMAT_ERROR);
  text_of(good, plain, GRANULAR_BONDS_FORMAT_ERROR, 1);

  Numbers list =
    pack(two(), exchange, 1, 1); // of special neighbours, as the programs would send it
  list[0] = 24;
  list[20] = 1;
  list[21] = 2;
  list.insert(list.end(), { 17, 18 });
  text_of(list, pfm, GRANULAR_BONDS_UNSUPPORTED);
}

TEST(BondExchange, EveryTruncationIsRefused)
{
  for (const int dialect : { pfm, plain })
  {
    const Numbers good = pack_all(two(), exchange + dialect);
    const auto first = static_cast<std::ptrdiff_t>(good[0]);
    for (std::ptrdiff_t cut = 1; cut < std::ssize(good); ++cut)
    {
      for (const Numbers& part :
        { Numbers(good.begin(), good.begin() + cut), Numbers(good.begin() + cut, good.end()) })
      {
        const Object others = create(2, 3);
        EXPECT_EQ(unpack(others, exchange + dialect, 0, part) == GRANULAR_BONDS_OK, cut == first);
        EXPECT_EQ(arrays_of(others).size, cut == first ? 1U : 0U);
      }
    }
  }
}

/// Every double becomes another one: an error, or what packs into the same doubles again.
TEST(BondExchange, EveryChangedDoubleIsRefusedOrKept)
{
  int refused = 0;
  int kept = 0;
  for (const int dialect : { pfm, plain })
  {
    const Numbers good = pack_all(two(), exchange + dialect);
    for (std::size_t at = 0; at < good.size(); ++at)
    {
      for (const double value : { 0.0, -1.0, 0.5, Doubles::quiet_NaN(), Doubles::infinity(), 1e300,
             1.0, 3.0, good[at] + 1, good[at] - 1, 0x1p63, -0x1p63, 0x1p64, 4294967296.0 })
      {
        Numbers bad = good;
        bad[at] = value;
        const Object others = create(2, 3);
        if (unpack(others, exchange + dialect, 0, bad) != GRANULAR_BONDS_OK)
        {
          EXPECT_EQ(arrays_of(others).size, 0U);
          ++refused;
          continue;
        }
        EXPECT_EQ(bits_of(pack_all(others, exchange + dialect)), bits_of(bad))
          << at << ' ' << value;
        ++kept;
      }
    }
  }
  EXPECT_GT(refused, 200);
  EXPECT_GT(kept, 500);
}
