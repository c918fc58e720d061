// SPDX-License-Identifier: BSD-3-Clause
// How much of a restart file is read for what is wanted of it.
#include "restart_runs.h"

#include "../support/counting_source.h"

#include "granular/bytes/byte_source.h"
#include "granular/formats/restart/restart_reader.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace
{
using restart_builder::RestartBuilder;

constexpr std::int64_t mib = std::int64_t{ 1 } << 20;

/// Grains in a box of their own, some 17 MiB.
RestartBuilder many_particles()
{
  RestartBuilder builder;
  builder.chunks = { {}, {} };
  builder.grid = { 2, 1, 1 };
  for (std::int64_t id = 1; id <= 130'000; ++id)
  {
    restart_builder::Particle particle;
    particle.tag = id;
    builder.chunks[id % 3 == 0 ? 1 : 0].push_back(restart_builder::granular_record(particle));
  }
  return builder;
}

/// A chain, some 17 MiB.
RestartBuilder many_bonds()
{
  std::vector<BondedParticle> particles;
  for (std::int64_t id = 1; id <= 36'000; ++id)
  {
    particles.push_back({ id, {}, 0.5 });
    if (id % 2 == 0)
    {
      particles.back().bonds.push_back({ 1, id - 1, std::vector<double>(12, 0.5) });
    }
    if (id > 2)
    {
      particles.back().bonds.push_back({ 1, 1, std::vector<double>(12, 0.5) });
    }
  }
  return bonded_file(particles, 12);
}

struct Read
{
  std::int64_t size = 0;
  std::int64_t bytes = 0;
  std::int64_t rows = 0;
};

/// What is read of a file for its columns, or for a piece of it.
Read read_of(const std::string& bytes, const granular::Request* request)
{
  granular::Notices notices;
  granular::Progress progress;
  const granular::RestartLayout layout =
    granular::read_layout(*granular::open_memory(bytes), notices, progress);
  const CountingSource source(bytes);
  std::int64_t rows = 0;
  if (request)
  {
    rows = granular::read_restart(
      source, layout, granular::automatic_history, *request, notices, progress)
             .rows.rows;
  }
  else
  {
    granular::find_restart_columns(source, layout, notices, progress);
  }
  return { static_cast<std::int64_t>(bytes.size()), source.bytes_read(), rows };
}
}

TEST(RestartReading, ColumnsOfTheFirstRecords)
{
  for (const RestartBuilder& builder : { many_particles(), many_bonds() })
  {
    const Read read = read_of(builder.file(), nullptr);
    ASSERT_GT(read.size, 12 * mib);
    EXPECT_LT(read.bytes, 2 * mib);
  }
}

TEST(RestartReading, AllOnce)
{
  for (const RestartBuilder& builder : { many_particles(), many_bonds() })
  {
    const std::string bytes = builder.file();
    for (const int threads : { 1, 3 })
    {
      granular::Request request;
      request.threads = threads;
      const Read read = read_of(bytes, &request);
      EXPECT_EQ(read.rows, builder.records());
      EXPECT_LT(read.bytes, read.size + read.size / 10 + 2 * mib) << threads;
    }
  }
}

// Those behind are not read, but for one block of each thread.
TEST(RestartReading, TheFirstPiece)
{
  const std::string bytes = many_particles().file();
  for (const int threads : { 1, 3 })
  {
    granular::Request request;
    request.threads = threads;
    request.pieces = 100;
    const Read read = read_of(bytes, &request);
    EXPECT_EQ(read.rows, 1300);
    EXPECT_LT(read.bytes, (2 + threads) * mib) << threads;
  }
}
