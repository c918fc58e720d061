// SPDX-License-Identifier: BSD-3-Clause
#include "../support/resident_memory.h"

#include "granular/memory/block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

using granular::Block;

namespace
{
constexpr std::size_t mib = std::size_t{ 1 } << 20;

/// Small ones, and those on both sides of where blocks are made in another way.
constexpr std::size_t sizes[] = { 0, 1, 63, 64, 1000, mib / 4 - 1, mib / 4, mib, 4 * mib - 64,
  4 * mib, 5 * mib + 7, 33 * mib };

std::uint64_t* numbers_of(const Block& block)
{
  return static_cast<std::uint64_t*>(block.data());
}

/// Every 8 bytes another number.
void fill(const Block& block)
{
  std::iota(numbers_of(block), numbers_of(block) + block.bytes() / 8, std::uint64_t{ 0 });
}

bool is_filled(const Block& block)
{
  for (std::size_t i = 0; i < block.bytes() / 8; ++i)
  {
    if (numbers_of(block)[i] != i)
    {
      return false;
    }
  }
  return true;
}
}

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

TEST(Block, IsAlignedForVectors)
{
  for (const std::size_t size : sizes)
  {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(Block(size).data()) % 64, 0u) << size;
  }
}

TEST(Block, CanBeFilledToTheEnd)
{
  for (const std::size_t size : sizes)
  {
    const Block block(size);
    std::memset(block.data(), 9, size);
    const auto* const bytes = static_cast<const char*>(block.data());
    EXPECT_TRUE(std::all_of(bytes, bytes + size, [](char byte) { return byte == 9; })) << size;
  }
}

TEST(Block, KeepsWhatItIsShrunkTo)
{
  for (const std::size_t size : sizes)
  {
    for (const std::size_t to : sizes)
    {
      if (to <= size)
      {
        Block block(size);
        fill(block);
        block.shrink(to);
        EXPECT_EQ(block.bytes(), to) << size;
        EXPECT_TRUE(is_filled(block)) << size << " to " << to;
        block.shrink(to / 3);
        EXPECT_TRUE(is_filled(block)) << size << " to " << to << " to " << to / 3;
      }
    }
  }
}

TEST(Block, IsFreedByAnotherThread)
{
  for (const std::size_t size : sizes)
  {
    void* const data = Block(size).release();
    std::thread([data] { Block::free(data); }).join();
  }
}

TEST(Block, FreesWhatMallocGave)
{
  // of every place in a page, where other blocks may have been before
  for (std::size_t i = 0; i < 1000; ++i)
  {
    std::vector<void*> all;
    for (std::size_t k = 0; k < 20; ++k)
    {
      all.push_back(std::malloc(16 * (i % 70) + k * 1000));
      all.push_back(Block(k * 20000).release());
    }
    for (void* const each : all)
    {
      Block::free(each);
    }
  }
}

TEST(Block, TakesMemoryOnlyForWhatIsTouched)
{
  if (!SystemTells().resident)
  {
    GTEST_SKIP() << "the system does not say what is in memory";
  }
  const Block block(512 * mib);
  std::memset(block.data(), 1, 10 * mib);
  const std::int64_t resident = resident_bytes(block.data(), block.bytes());
  EXPECT_GE(resident, 10 * 1024 * 1024);
  EXPECT_LE(resident, 12 * 1024 * 1024); // and the rest of a large page
}

TEST(Block, GivesBackWhatIsBehindItsNewEnd)
{
  if (!SystemTells().resident)
  {
    GTEST_SKIP() << "the system does not say what is in memory";
  }
  const auto heap = std::make_shared<granular::BlockPool>(0);
  for (const auto& [size, pool] : std::vector<std::pair<std::size_t, decltype(heap)>>{
         { 9 * mib, nullptr }, { 40 * mib, nullptr }, { 9 * mib, heap }, { 40 * mib, heap } })
  {
    Block block(size, pool);
    std::memset(block.data(), 1, size);
    const void* const all = block.data();
    const std::int64_t before = resident_bytes(all, size);
    EXPECT_GE(before, static_cast<std::int64_t>(size));
    block.shrink(size * 3 / 4);
    ASSERT_EQ(block.data(), all);
    EXPECT_LE(resident_bytes(all, size), static_cast<std::int64_t>(size * 3 / 4 + 2 * mib));
    EXPECT_LT(resident_bytes(all, size), before);
  }
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(Block, MoreThanThereIs)
{
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  for (const std::size_t size : { most, most / 2, most / 4 })
  {
    EXPECT_THROW(Block block(size), std::bad_alloc) << size;
  }
}
#endif
