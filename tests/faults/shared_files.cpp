// SPDX-License-Identifier: BSD-3-Clause
// Runs in two threads that open and read the same files, while a third thread appends to one of them: each finds whole frames,
// right to the last row. For the thread sanitizer, and for memory over time with GRANULAR_LOAD=full in the environment.
#include "load.h"

#include "../c/handles.h"
#include "../support/own_folder.h"
#include "../support/series.h"

#include "granular.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace
{
std::int64_t rows_at(std::int64_t step)
{
  return 50 + step * 131 % 300;
}

std::string frame_of(std::int64_t step)
{
  return grains(step, ids_from(1, rows_at(step)));
}

/// What is wrong with a frame, or "".
std::string wrong_of(granular_run* run, std::int64_t number, bool sorted, std::int64_t stride)
{
  granular_request request;
  granular_request_init(&request);
  request.sort_by_id = sorted;
  request.stride = stride;
  request.threads = 1 + static_cast<int>(number % 3);
  granular_frame* frame = nullptr;
  if (granular_read(run, number, &request, &frame) != GRANULAR_OK)
  {
    return message();
  }
  const FrameHandle handle(frame, granular_release);
  granular_array ids = {};
  granular_array points = {};
  if (granular_array_named(frame, "id", &ids) != GRANULAR_OK ||
    granular_array_named(frame, "points", &points) != GRANULAR_OK)
  {
    return message();
  }
  const std::string where = " in frame " + std::to_string(number);
  if (ids.rows != rows_at(number) / stride)
  {
    return std::to_string(ids.rows) + " rows" + where;
  }
  for (std::int64_t i = 0; i < ids.rows; ++i)
  {
    if (static_cast<const std::int64_t*>(ids.data)[i] != stride * (i + 1) ||
      static_cast<const double*>(points.data)[3 * i] != static_cast<double>(number))
    {
      return "row " + std::to_string(i) + where;
    }
  }
  return "";
}

std::int64_t frames_of(granular_run* run)
{
  granular_run_facts facts = {};
  EXPECT_EQ(granular_run_info(run, &facts), GRANULAR_OK) << message();
  return facts.frames;
}

/// Opens, reads, follows and closes a run, again and again.
void follow(const std::string& pattern, unsigned seed, std::int64_t rounds, std::string& wrong)
{
  std::mt19937 random(seed);
  for (std::int64_t round = 0; round < rounds && wrong.empty(); ++round)
  {
    granular_open_options options;
    granular_open_options_init(&options);
    options.threads = 2;
    granular_run* opened = nullptr;
    const char* const name = pattern.c_str();
    if (granular_open(&name, 1, &options, &opened) != GRANULAR_OK)
    {
      wrong = message();
      return;
    }
    const RunHandle run(opened, granular_close);
    std::int64_t before = 0;
    for (int i = 0; i < 10 && wrong.empty(); ++i)
    {
      const std::int64_t frames = frames_of(opened);
      wrong =
        wrong_of(opened, static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(frames)),
          random() % 2 == 0, 1 + static_cast<std::int64_t>(random() % 4));
      if (frames < before)
      {
        wrong = "fewer frames than before";
      }
      before = frames;
      if (wrong.empty() && granular_refresh(opened, nullptr, nullptr, nullptr) != GRANULAR_OK)
      {
        wrong = message();
      }
    }
  }
}

using SharedFiles = OwnFolder;
}

TEST_F(SharedFiles, OfTwoRunsInTwoThreads)
{
  // the last one grows
  for (std::int64_t step = 0; step < 4; ++step)
  {
    this->write("run_" + std::to_string(step) + ".dump", frame_of(step));
  }
  const std::string growing = this->write("run_4.dump", frame_of(4));
  const std::string pattern = this->path("run_*.dump");
  std::int64_t next = 5;
  std::int64_t memory = 0;
  const std::int64_t descriptors = open_descriptors();
  for (const bool warm : { false, true })
  {
    const RunHandle followed = open_run(pattern);
    memory = warm ? status_of_process("VmRSS") : 0;
    std::atomic<bool> stop = false;
    std::thread appending(
      [&]
      {
        for (int i = 0; i < 200 && (i < 10 || !stop); ++i)
        {
          std::ofstream(growing, std::ios::binary | std::ios::app) << frame_of(next++);
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
      });
    const std::int64_t rounds = size_of_load(20, 1'000);
    std::string wrong[2];
    std::thread other(follow, pattern, 1, rounds, std::ref(wrong[1]));
    follow(pattern, 2, rounds, wrong[0]);
    other.join();
    stop = true;
    appending.join();
    EXPECT_EQ(wrong[0], "");
    EXPECT_EQ(wrong[1], "");
    EXPECT_EQ(granular_refresh(followed.get(), nullptr, nullptr, nullptr), GRANULAR_OK)
      << message();
    EXPECT_EQ(frames_of(followed.get()), next);
    EXPECT_EQ(wrong_of(followed.get(), next - 1, true, 1), "");
  }
  const std::int64_t grown = status_of_process("VmRSS") - memory;
  std::printf("load | two runs in two threads | %lld openings and 10 times as many frames each | "
              "%lld KiB more | %lld frames at last\n",
    static_cast<long long>(2 * size_of_load(20, 1'000)), static_cast<long long>(grown / 1024),
    static_cast<long long>(next));
  EXPECT_EQ(open_descriptors(), descriptors);
#ifndef GRANULAR_TEST_SANITIZED
  EXPECT_LT(grown, 8 * mebibyte);
#endif
}
