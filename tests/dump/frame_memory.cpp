// SPDX-License-Identifier: BSD-3-Clause
// Memory that runs out at any allocation while a frame is read: std::bad_alloc, never a hang; what is
// read next is whole. In a program of its own, because it replaces operator new.
#include "../support/binary_dumps.h"
#include "../support/dumps.h"
#include "../support/frame_content.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
std::atomic<bool> counting = false;
std::atomic<int> left = 0;
std::atomic<bool> all_behind = false; ///< fail, too

bool fails() noexcept
{
  if (!counting)
  {
    return false;
  }
  const int now = left.fetch_sub(1);
  return now == 0 || (now < 0 && all_behind);
}
}

// not inline: the compiler would take malloc and delete for a mismatch
__attribute__((noinline)) void* operator new(std::size_t bytes)
{
  void* const memory = fails() ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
  if (memory == nullptr)
  {
    throw std::bad_alloc();
  }
  return memory;
}

__attribute__((noinline)) void operator delete(void* memory) noexcept
{
  std::free(memory);
}

__attribute__((noinline)) void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

namespace
{
using granular::DumpRequest;
using granular::Notices;

/// Whether so few allocations were enough.
bool read_with(const Dump& dump, const DumpRequest& request, int allocations, bool failing_on)
{
  std::string result = "whole";
  Notices notices;
  granular::Progress progress;
  left = allocations;
  all_behind = failing_on;
  counting = true;
  try
  {
    dump.read(request, 0, progress);
    counting = false;
  }
  catch (const std::bad_alloc&)
  {
    counting = false;
    result = "out of memory";
  }
  catch (...)
  {
    counting = false;
    throw;
  }
  const bool enough = left >= 0;
  // an allocation that failed is an error, but for a thread that the others can do without
  EXPECT_TRUE(!enough || result == "whole");
  EXPECT_TRUE(!failing_on || enough || result == "out of memory");
  return enough;
}

void expect_no_hang(const Dump& dump, const DumpRequest& plain)
{
  const Outcome whole = outcome_of(
    [&](const DumpRequest& request, Notices&) { return dump.read(request).frame; }, plain);
  ASSERT_EQ(whole.error, "");
  for (const int threads : { 1, 2, 4 })
  {
    for (const bool failing_on : { false, true })
    {
      const DumpRequest request = in_chunks(plain, threads, 400);
      int allocations = 0;
      while (!read_with(dump, request, allocations, failing_on))
      {
        ++allocations;
        ASSERT_LT(allocations, 5000);
      }
      EXPECT_GT(allocations, 20);
      EXPECT_EQ(
        outcome_of(
          [&](const DumpRequest& asked, Notices&) { return dump.read(asked).frame; }, request)
          .difference(whole),
        "");
    }
  }
}
}

TEST(FrameMemory, Text)
{
  std::string rows;
  for (int row = 0; row < 60; ++row)
  {
    rows += std::to_string(row) + " 1 0 0 0 wet\n";
  }
  const Dump dump(one_frame("id type x y z state", rows));
  expect_no_hang(dump, {});
  DumpRequest part = all_requests()[8];
  part.pieces = 2;
  part.piece = 1;
  expect_no_hang(
    Dump(one_frame("type x y z state", replaced(rows, " 1 0 0 0 wet", " 0 0 0 wet"))), part);
}

/// A column that is widened: it is read twice.
TEST(FrameMemory, Binary)
{
  const binary::Form& form = binary::form("plain, little-endian");
  binary::Frame frame = binary::grains(form, 1, 30);
  frame.chunks[2][1] = 1.5;
  expect_no_hang(Dump(binary::write(form, { frame }).bytes, binary::grain_columns), everything());
}
