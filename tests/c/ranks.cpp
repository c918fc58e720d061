// SPDX-License-Identifier: BSD-3-Clause
// Threads as ranks, each with a run of its own: together they get what one process alone gets.
#include "handles.h"

#include "../support/thread_ranks.h"

#include <algorithm>
#include <functional>
#include <set>

namespace
{
int all_gather(const void* mine, void* all, std::size_t bytes, void* user)
{
  auto* to = static_cast<char*>(all);
  for (const std::string& part : static_cast<granular::Communicator*>(user)->all_gather(
         { static_cast<const char*>(mine), bytes }))
  {
    EXPECT_EQ(part.size(), bytes);
    to = std::ranges::copy(part, to).out;
  }
  return 0;
}

/// Does work on each rank, and returns what it makes there.
std::vector<std::string> on_all(
  int size, const std::function<std::string(const granular_ranks& ranks)>& work)
{
  std::vector<std::string> made(static_cast<std::size_t>(size));
  run_ranks(size,
    [&](granular::Communicator& ranks)
    {
      made[static_cast<std::size_t>(ranks.rank())] =
        work({ ranks.rank(), ranks.size(), all_gather, &ranks });
    });
  return made;
}

void take_text(const granular_error* remark, void* user)
{
  *static_cast<std::string*>(user) += std::string(remark->message) + remark->topic + "\n";
}

/// The bytes of an array of the last frame of a file behind its type, or the error, and all remarks.
std::string read_last(const std::string& path, const granular_ranks* ranks,
  const granular_request& given, const char* name, std::string& remarks)
{
  granular_open_options options;
  granular_open_options_init(&options);
  options.ranks = ranks;
  options.notice = take_text;
  options.user = &remarks;
  granular_request request = given;
  request.notice = take_text;
  request.user = &remarks;
  granular_run* opened = nullptr;
  const char* const paths = path.c_str();
  granular_frame* read = nullptr;
  if (granular_open(&paths, 1, &options, &opened) != GRANULAR_OK ||
    granular_read(opened, -1, &request, &read) != GRANULAR_OK)
  {
    granular_close(opened);
    return message();
  }
  const RunHandle run(opened, granular_close);
  const FrameHandle frame(read, granular_release);
  const granular_array array = array_of(frame, name);
  const std::size_t value = array.type == GRANULAR_FLOAT64 || array.type == GRANULAR_INT64 ? 8 : 4;
  return { static_cast<const char*>(array.data),
    value * static_cast<std::size_t>(array.rows * array.components) };
}
}

TEST(CRanks, TheirPartsAreTheWhole)
{
  for (const auto& [name, array, sort] :
    { std::tuple{ "grains.dump", "v", 0 }, { "grains.dump", "id", 1 },
      { "ortho_image.bin", "points", 0 }, { "local/contacts.dump", "ends", 0 },
      { "data_file/full.data", "id", 0 }, { "data_file/full.data", "points", 1 } })
  {
    granular_request request;
    granular_request_init(&request);
    request.sort_by_id = sort;
    std::string remarks_of_one;
    const std::string whole = read_last(good(name), nullptr, request, array, remarks_of_one);
    for (const int size : { 1, 2, 5 })
    {
      std::vector<std::string> remarks(static_cast<std::size_t>(size));
      const std::vector<std::string> parts = on_all(size,
        [&, name = name, array = array](const granular_ranks& ranks)
        {
          return read_last(
            good(name), &ranks, request, array, remarks[static_cast<std::size_t>(ranks.rank)]);
        });
      std::string joined;
      for (const std::string& part : parts)
      {
        joined += part;
      }
      EXPECT_TRUE(joined == whole) << name << " on " << size;
      EXPECT_TRUE(std::ranges::all_of(
        remarks, [&](const std::string& each) { return each == remarks_of_one; }))
        << remarks.back();
    }
  }
}

TEST(CRanks, AnErrorOfOneIsThatOfAll)
{
  const std::string path = std::string(GRANULAR_OUTPUT) + "/broken.dump";
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n9000\nITEM: BOX BOUNDS pp pp pp\n0 "
                     "1\n0 1\n0 1\nITEM: ATOMS id x y z\n";
  for (int row = 0; row < 9000; ++row)
  {
    text += row == 8000 ? "1 0 zero 0\n" : "1 0 0 0\n";
  }
  std::ofstream(path) << text;
  granular_request request;
  granular_request_init(&request);
  const auto expect_same = [&](const std::string& file, const std::string& expected)
  {
    const std::vector<std::string> errors = on_all(3,
      [&](const granular_ranks& ranks)
      {
        std::string remarks;
        return read_last(file, &ranks, request, "points", remarks);
      });
    EXPECT_EQ(std::set(errors.begin(), errors.end()).size(), 1U);
    EXPECT_NE(errors.front().find(expected), std::string::npos) << errors.front();
  };
  expect_same(path, ":8010: column 'y': ");
  expect_same("no/such.dump", "no/such.dump");
  request.piece = 3;
  request.pieces = 3;
  expect_same(good("grains.dump"), "expected a piece below the number of pieces, 3, got 3");
}

TEST(CRanks, ThatCannotBe)
{
  const auto expect_refused = [](const granular_ranks& ranks, granular_status expected)
  {
    granular_open_options options;
    granular_open_options_init(&options);
    options.ranks = &ranks;
    granular_run* run = nullptr;
    const std::string path = good("grains.dump");
    const char* const paths = path.c_str();
    EXPECT_EQ(granular_open(&paths, 1, &options, &run), expected);
    EXPECT_NE(message().find("all_gather"), std::string::npos) << message();
  };
  const auto fails = [](const void*, void*, std::size_t, void*) { return 7; };
  expect_refused({ 0, 2, nullptr, nullptr }, GRANULAR_BAD_ARGUMENT);
  expect_refused({ 2, 2, fails, nullptr }, GRANULAR_BAD_ARGUMENT);
  expect_refused({ 0, 2, fails, nullptr }, GRANULAR_OTHER_ERROR);
}
