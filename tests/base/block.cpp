// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/block.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

using granular::Block;

TEST(Block, HandsItsMemoryOver)
{
  Block block(100);
  EXPECT_EQ(block.bytes(), 100u);
  std::memset(block.data(), 7, 100);
  block.shrink(10);
  EXPECT_EQ(block.bytes(), 10u);
  EXPECT_EQ(static_cast<const char*>(block.data())[9], 7);
  void* const data = block.release();
  EXPECT_NE(data, nullptr);
  EXPECT_EQ(block.bytes(), 0u);
  EXPECT_EQ(block.data(), nullptr);
  Block::free(data);
}

TEST(Block, OfNoBytesIsStillOne)
{
  Block block(0);
  EXPECT_NE(block.data(), nullptr);
  Block shrunk(8);
  shrunk.shrink(0);
  EXPECT_EQ(shrunk.bytes(), 0u);
  EXPECT_NE(shrunk.data(), nullptr);
  EXPECT_EQ(Block().data(), nullptr);
  Block::free(nullptr);
}

TEST(Block, Moves)
{
  Block a(16);
  const void* const data = a.data();
  Block b(std::move(a));
  EXPECT_EQ(b.data(), data);
  Block c(4);
  c = std::move(b);
  EXPECT_EQ(c.data(), data);
  EXPECT_EQ(c.bytes(), 16u);
}

TEST(Block, IsAlignedForDoubles)
{
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(Block(1000).data()) % alignof(double), 0u);
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(Block, MoreThanThereIs)
{
  EXPECT_THROW(Block(std::numeric_limits<std::size_t>::max() / 2), std::bad_alloc);
}
#endif
