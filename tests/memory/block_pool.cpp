// SPDX-License-Identifier: BSD-3-Clause
#include "../support/resident_memory.h"

#include "granular/memory/block.h"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

using granular::Block;
using granular::BlockPool;

namespace
{
constexpr std::size_t mib = std::size_t{ 1 } << 20;

std::shared_ptr<BlockPool> make_pool(std::size_t limit = 1024 * mib)
{
  return std::make_shared<BlockPool>(limit);
}

/// Makes a block, fills it, and gives the address it had.
const void* come_and_go(std::size_t bytes, const std::shared_ptr<BlockPool>& pool)
{
  const Block block(bytes, pool);
  std::memset(block.data(), 5, bytes);
  return block.data();
}
}

TEST(BlockPool, GivesMemoryThatCameBack)
{
  const auto pool = make_pool();
  for (const std::size_t bytes : { mib / 12, mib, 3 * mib, 24 * mib })
  {
    const void* const first = come_and_go(bytes, pool);
    EXPECT_EQ(come_and_go(bytes, pool), first) << bytes;
    EXPECT_EQ(come_and_go(bytes + bytes / 10, pool), first) << "a run that grows";
    EXPECT_EQ(come_and_go(bytes - bytes / 10, pool), first) << "a run that shrinks";
    pool->clear();
  }
}

TEST(BlockPool, GivesWhatWasReleasedAndFreedByAnotherThread)
{
  const auto pool = make_pool();
  Block block(8 * mib, pool);
  void* const data = block.release();
  EXPECT_EQ(pool->idle_bytes(), 0u);
  std::thread([data] { Block::free(data); }).join();
  EXPECT_EQ(Block(8 * mib, pool).data(), data);
}

TEST(BlockPool, GivesNothingTwice)
{
  const auto pool = make_pool();
  come_and_go(8 * mib, pool);
  const Block a(8 * mib, pool);
  const Block b(8 * mib, pool);
  EXPECT_NE(a.data(), b.data());
  EXPECT_EQ(pool->idle_bytes(), 0u);
}

TEST(BlockPool, LeavesSmallBlocksToMalloc)
{
  const auto pool = make_pool();
  come_and_go(0, pool);
  come_and_go(1000, pool);
  come_and_go(60 * 1000, pool);
  EXPECT_EQ(pool->idle_bytes(), 0u);
}

TEST(BlockPool, GivesTheOneThatFitsBest)
{
  const auto pool = make_pool();
  Block small(8 * mib, pool);
  Block middle(12 * mib, pool);
  Block large(24 * mib, pool);
  const void* const wanted = middle.data();
  small = Block();
  large = Block();
  middle = Block();
  EXPECT_EQ(Block(11 * mib, pool).data(), wanted);
}

TEST(BlockPool, GivesNoBlockThatWouldWasteMemory)
{
  const auto pool = make_pool();
  Block large(32 * mib, pool);
  std::memset(large.data(), 1, large.bytes());
  const void* const data = large.data();
  large = Block();
  EXPECT_NE(Block(16 * mib, pool).data(), data);
  EXPECT_EQ(Block(24 * mib, pool).data(), data);
}

TEST(BlockPool, CountsMemoryAndNotAddressSpace)
{
  const auto pool = make_pool();
  Block most(640 * mib, pool); // the most there can be
  std::memset(most.data(), 1, 10 * mib);
  most.shrink(10 * mib);
  const void* const data = most.data();
  most = Block();
  EXPECT_GE(pool->idle_bytes(), 10 * mib);
  EXPECT_LE(pool->idle_bytes(), 12 * mib);
  // fits a small request as well as one for the most there can be
  EXPECT_EQ(Block(8 * mib, pool).data(), data);
  EXPECT_EQ(Block(640 * mib, pool).data(), data);
}

TEST(BlockPool, CountsNoLessThanIsInMemory)
{
  if (!SystemTells().resident)
  {
    GTEST_SKIP() << "the system does not say what is in memory";
  }
  for (const std::size_t size : { 3 * mib, 64 * mib })
  {
    const auto pool = make_pool();
    Block block(size, pool);
    std::memset(block.data(), 1, size / 32 * 20);
    const void* const data = block.data();
    const std::int64_t filled = resident_bytes(data, size);
    block.shrink(size / 32 * 19);
    ASSERT_EQ(block.data(), data);
    block = Block();
    const std::int64_t kept = resident_bytes(data, size);
    EXPECT_LT(kept, filled) << size;
    EXPECT_GE(kept, static_cast<std::int64_t>(size / 32 * 19));
    EXPECT_LE(kept, static_cast<std::int64_t>(pool->idle_bytes()) + 4096);
  }
}

TEST(BlockPool, KeepsNoMoreThanItsLimit)
{
  const auto pool = make_pool(20 * mib);
  EXPECT_EQ(pool->limit(), 20 * mib);
  std::vector<Block> blocks;
  for (int i = 0; i < 5; ++i)
  {
    blocks.emplace_back(8 * mib, pool);
  }
  const void* const last = blocks.back().data();
  for (Block& block : blocks)
  {
    block = Block();
    EXPECT_LE(pool->idle_bytes(), pool->limit());
  }
  EXPECT_GE(pool->idle_bytes(), 16 * mib); // the last two
  EXPECT_EQ(Block(8 * mib, pool).data(), last);
  come_and_go(30 * mib, pool); // too large to be kept, and no reason to drop the others
  EXPECT_GE(pool->idle_bytes(), 16 * mib);
  EXPECT_LE(pool->idle_bytes(), pool->limit());
}

TEST(BlockPool, OfNoLimitKeepsNothing)
{
  const auto pool = make_pool(0);
  come_and_go(8 * mib, pool);
  EXPECT_EQ(pool->idle_bytes(), 0u);
}

TEST(BlockPool, FreesWhatTwoFramesDidNotUse)
{
  const auto pool = make_pool();
  const void* const used = come_and_go(8 * mib, pool);
  come_and_go(64 * mib, pool); // of a frame that was larger
  for (int frame = 0; frame < 2; ++frame)
  {
    pool->next_frame();
    EXPECT_EQ(come_and_go(8 * mib, pool), used);
  }
  EXPECT_LT(pool->idle_bytes(), 10 * mib);
  EXPECT_GE(pool->idle_bytes(), 8 * mib);
  pool->next_frame();
  EXPECT_GE(pool->idle_bytes(), 8 * mib);
  pool->next_frame();
  EXPECT_EQ(pool->idle_bytes(), 0u);
}

TEST(BlockPool, ServesFramesThatAreFreedOneOrTwoFramesLater)
{
  // as a pipeline does it: the last frame is held until its successor is through
  const auto pool = make_pool();
  std::deque<Block> shown;
  std::vector<const void*> addresses;
  for (int frame = 0; frame < 8; ++frame)
  {
    pool->next_frame();
    shown.emplace_back(8 * mib, pool);
    addresses.push_back(shown.back().data());
    if (shown.size() == 3)
    {
      shown.pop_front();
    }
  }
  for (std::size_t frame = 3; frame < addresses.size(); ++frame)
  {
    EXPECT_EQ(addresses[frame], addresses[frame - 3]);
  }
}

TEST(BlockPool, LendsWhatWaitsToTheSystem)
{
  if (!SystemTells().lent)
  {
    GTEST_SKIP() << "the system does not say what it may take";
  }
  const std::int64_t before = lent_bytes();
  const auto pool = make_pool();
  const void* const data = come_and_go(32 * mib, pool);
  EXPECT_GE(lent_bytes() - before, static_cast<std::int64_t>(30 * mib));
  const Block block(32 * mib, pool);
  EXPECT_EQ(block.data(), data);
  std::memset(block.data(), 6, block.bytes());
  EXPECT_LE(lent_bytes() - before, 0) << "what is in use is not the system's";
}

TEST(BlockPool, DropsEverything)
{
  const auto pool = make_pool();
  Block a(8 * mib, pool);
  come_and_go(16 * mib, pool);
  pool->clear();
  EXPECT_EQ(pool->idle_bytes(), 0u);
  std::memset(a.data(), 1, a.bytes()); // is still there
  a = Block();
  EXPECT_GE(pool->idle_bytes(), 8 * mib);
}

TEST(BlockPool, MayGoBeforeItsBlocks)
{
  auto pool = make_pool();
  Block block(8 * mib, pool);
  void* const data = Block(16 * mib, pool).release();
  const std::weak_ptr<BlockPool> gone = pool;
  pool.reset();
  EXPECT_TRUE(gone.expired());
  std::memset(block.data(), 1, block.bytes());
  std::memset(data, 1, 16 * mib);
  block.shrink(6 * mib);
  block = Block();
  Block::free(data);
  EXPECT_LE(resident_bytes(data, 16 * mib), 0) << "freed: the address is nobody's";
}

TEST(BlockPool, WhatIsShrunkToLittleMovesAndTheRestComesBack)
{
  const auto pool = make_pool();
  Block block(8 * mib, pool);
  const void* const data = block.data();
  std::memset(block.data(), 3, block.bytes());
  block.shrink(1000);
  EXPECT_NE(block.data(), data);
  EXPECT_EQ(static_cast<const char*>(block.data())[999], 3);
  EXPECT_EQ(Block(8 * mib, pool).data(), data);
}

TEST(BlockPool, IsSharedByThreads)
{
  // each fills its blocks with a number of its own, and another one looks and frees them
  const auto pool = make_pool(6 * mib);
  std::mutex mutex;
  std::vector<std::pair<Block, char>> passed;
  bool right = true;
  const auto work = [&](char mark)
  {
    for (std::size_t i = 0; i < 200; ++i)
    {
      Block block(mib / 4 + (i * 7 % 11) * (mib / 8), pool);
      std::memset(block.data(), mark, block.bytes());
      if (i % 3 == 0)
      {
        block.shrink(block.bytes() / 2 + 1);
      }
      if (i % 5 == 0)
      {
        pool->next_frame();
      }
      if (i % 31 == 0)
      {
        pool->clear();
      }
      std::pair<Block, char> taken;
      {
        const std::lock_guard lock(mutex);
        passed.emplace_back(std::move(block), mark);
        std::swap(taken, passed[i % passed.size()]);
        std::swap(passed[i % passed.size()], passed.back());
        passed.pop_back();
        right = right && pool->idle_bytes() <= pool->limit();
      }
      const auto* const bytes = static_cast<const char*>(taken.first.data());
      if (bytes[0] != taken.second || bytes[taken.first.bytes() - 1] != taken.second)
      {
        const std::lock_guard lock(mutex);
        right = false;
      }
    }
  };
  std::vector<std::thread> threads;
  for (const char mark : { 'a', 'b', 'c', 'd' })
  {
    threads.emplace_back(work, mark);
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_TRUE(right);
  EXPECT_TRUE(passed.empty());
}

TEST(BlockPool, IsKnownByItsLargeBlocks)
{
  const auto pool = make_pool();
  Block block(8 * mib, pool);
  EXPECT_EQ(block.pool(), pool);
  block.shrink(mib);
  EXPECT_EQ(block.pool(), pool);
  EXPECT_EQ(Block(8 * mib).pool(), nullptr);
  EXPECT_EQ(Block(100, pool).pool(), nullptr) << "small ones are malloc's";
  EXPECT_EQ(Block().pool(), nullptr);
}
