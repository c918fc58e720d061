// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/bond_record.h"

#include "../support/error_of.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace
{
using granular::BondBlock;
using granular::FormatError;
using granular::ImageCounts;
using granular::look_at_bonds;
using granular::WholeNumbers;

constexpr std::int64_t most_bonds = 6;

/// The 13 doubles before the first bond, then these.
std::vector<double> block_of(double bonds, const std::vector<double>& more)
{
  std::vector<double> block = { 0, 0.1, 0.2, 0.3, 1, 1, 1, 537395712, 0, 0, 0, 0, bonds };
  block.insert(block.end(), more.begin(), more.end());
  block[0] = static_cast<double>(block.size());
  return block;
}

std::string error_of(
  const std::vector<double>& block, bool may_have_more, std::int64_t history_values)
{
  return ::error_of<FormatError>(
    [&] { look_at_bonds(block, may_have_more, history_values, most_bonds); });
}
}

TEST(BondRecord, WholeNumbers)
{
  std::vector<double> block(11, 0.5);
  for (const double value : { 1., 7., 2147483647. })
  {
    block[5] = value;
    EXPECT_EQ(granular::whole_numbers_of(block), WholeNumbers::Values);
  }
  for (const std::int64_t bits : { std::int64_t{ 1 }, std::int64_t{ 2147483647 } })
  {
    block[5] = std::bit_cast<double>(bits);
    EXPECT_EQ(granular::whole_numbers_of(block), WholeNumbers::Bits);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value :
    { 0., -0., -1., 0.5, nan, 1e300, 2147483648., std::bit_cast<double>(std::int64_t{ 1 } << 31) })
  {
    block[5] = value;
    EXPECT_THROW(granular::whole_numbers_of(block), FormatError) << value;
  }
  EXPECT_EQ(
    granular::to_whole(-0x1p63, WholeNumbers::Values), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(granular::to_whole(0x1p53, WholeNumbers::Values), std::int64_t{ 1 } << 53);
  EXPECT_EQ(granular::to_whole(std::bit_cast<double>(std::int64_t{ -5 }), WholeNumbers::Bits), -5);
  for (const double value : { 0.5, 0x1p63, nan, -std::numeric_limits<double>::infinity() })
  {
    EXPECT_THROW(granular::to_whole(value, WholeNumbers::Values), FormatError) << value;
  }
}

TEST(BondRecord, Images)
{
  EXPECT_EQ(granular::unpack_image(537395712, 10),
    ImageCounts()); // of particles that never left, in real files
  for (const int bits : { 10, 21 })
  {
    const std::int32_t half = 1 << (bits - 1);
    for (const ImageCounts& counts :
      { ImageCounts{ -half, half - 1, 0 }, ImageCounts{ half - 1, 0, -half },
        ImageCounts{ 0, -half, half - 1 }, ImageCounts{ 1, -2, 3 } })
    {
      EXPECT_EQ(granular::unpack_image(granular::pack_image(counts, bits), bits), counts);
    }
    EXPECT_THROW(granular::pack_image({ half, 0, 0 }, bits), granular::LimitError);
    EXPECT_THROW(granular::pack_image({ 0, 0, -half - 1 }, bits), granular::LimitError);
  }
  // 3 -4 0, as LIGGGHTS writes it
  EXPECT_EQ(granular::pack_image({ 3, -4, 0 }, 10), 537391619);
}

TEST(BondRecord, Bonds)
{
  const auto two = block_of(2, { 1, 7, 2, 8 });
  BondBlock found = look_at_bonds(two, false, -1, most_bonds);
  EXPECT_EQ(found.bonds, 2);
  EXPECT_EQ(found.history_values, 0);
  EXPECT_EQ(found.size, 17u);
  EXPECT_EQ(found.pairs[3], 8);

  const auto history = block_of(2, { 1, 7, 2, 8, 3, 10, 11, 12, 13, 14, 15 });
  for (const std::int64_t known : { -1, 3 })
  {
    found = look_at_bonds(history, false, known, most_bonds);
    EXPECT_EQ(found.history_values, 3);
    EXPECT_EQ(found.size, history.size());
    EXPECT_EQ(found.history[5], 15);
  }
  // with what a fix has behind
  auto more = history;
  more.insert(more.end(), { 2, 0.5 });
  EXPECT_EQ(look_at_bonds(more, true, 3, most_bonds).size, history.size());
  EXPECT_EQ(look_at_bonds(more, true, 0, most_bonds).size, 17u);
}

TEST(BondRecord, NoBonds)
{
  EXPECT_EQ(look_at_bonds(block_of(0, {}), false, -1, most_bonds).size, 13u);
  EXPECT_EQ(look_at_bonds(block_of(0, {}), false, 12, most_bonds).history_values, 0);
  EXPECT_EQ(look_at_bonds(block_of(0, { 12 }), false, -1, most_bonds).history_values, 12);
  EXPECT_EQ(look_at_bonds(block_of(0, { 12, 2, 0.5 }), true, 12, most_bonds).size, 14u);
  // the next double is not it, but of a fix
  EXPECT_EQ(look_at_bonds(block_of(0, { 2, 0.5 }), true, 12, most_bonds).size, 13u);
  EXPECT_EQ(look_at_bonds(block_of(0, { 2, 0.5 }), true, -1, most_bonds).size, 13u);
}

TEST(BondRecord, WhatIsWrong)
{
  for (const double bonds : { -1., 0.5, 7., 1e300, std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_NE(
      error_of(block_of(bonds, {}), true, -1).find("from 0 to 6 in double 12"), std::string::npos)
      << bonds;
  }
  EXPECT_NE(error_of({ 1, 2, 3 }, true, -1).find("at least 13 doubles"), std::string::npos);
  EXPECT_NE(
    error_of(block_of(2, { 1, 7, 2 }), true, -1).find("at most 1 bonds"), std::string::npos);
  EXPECT_NE(error_of(block_of(1, { 1, 7, 4, 1, 2, 3, 4 }), false, 3).find("3 as in other records"),
    std::string::npos);
  EXPECT_NE(error_of(block_of(1, { 1, 7 }), false, 3).find("got the end"), std::string::npos);
  EXPECT_NE(error_of(block_of(1, { 1, 7, 3, 1, 2 }), true, 3).find("for which there is room"),
    std::string::npos);
  EXPECT_NE(error_of(block_of(1, { 1, 7, 3, 1, 2, 3, 4 }), false, 3).find("expected 19 doubles"),
    std::string::npos);
  EXPECT_NE(
    error_of(block_of(1, { 1, 7, 3 }), false, 0).find("expected 15 doubles"), std::string::npos);
}
