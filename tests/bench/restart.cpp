// SPDX-License-Identifier: BSD-3-Clause
// Restart files: particles and bonds to arrays, against reading the bytes of the file and no more; and how long it takes
// to find out where particles begin.
#include "bench.h"

#include "../restart/restart_builder.h"

#include "granular/bytes/byte_source.h"
#include "granular/memory/block_pool.h"
#include "granular/memory/mapping.h"
#include "granular/restart/restart_layout.h"
#include "granular/restart/restart_reader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace bench
{
namespace
{
using namespace granular;

struct Case
{
  const char* name;
  std::int64_t records;
  bool bonds;
  int threads;
  std::size_t junk; ///< bytes of a force field in front of the particles
};

constexpr std::int64_t grains_a_fibre = 10;
constexpr int contact_history = 14; ///< doubles that a fix adds to a grain

/// A record as programs write it: of fibres, or of a grain with some contact history.
restart_builder::Record make_record(std::int64_t i, bool bonds)
{
  restart_builder::Grain grain;
  grain.tag = i + 1;
  grain.x = { 1e-3 * static_cast<double>(i % 1000), 1e-3 * static_cast<double>(i / 1000 % 1000),
    1e-3 * static_cast<double>(i / 1'000'000) };
  grain.bits = true;
  restart_builder::Record record = restart_builder::granular_record(grain, 5e-4, { 1, 2, 3 });
  if (bonds)
  {
    const std::int64_t place = i % grains_a_fibre;
    std::vector<restart_builder::BondOf> held;
    for (const std::int64_t side : { -1, 1 })
    {
      if (place + side >= 0 && place + side < grains_a_fibre)
      {
        held.push_back({ 1, i + 1 + side, std::vector<double>(14, static_cast<double>(side)) });
      }
    }
    grain.bits = false;
    record = restart_builder::join({ record, restart_builder::bond_block(grain, held, 14) });
  }
  else
  {
    record.push_back(contact_history);
    record.insert(record.end(), contact_history - 1, 0.25);
  }
  record[0] = static_cast<double>(record.size());
  return record;
}

/// A file that is written record by record, and removed again.
class RestartFile
{
public:
  explicit RestartFile(const Case& each)
    : path_(std::string(GRANULAR_OUTPUT) + "/bench.restart")
  {
    restart_builder::RestartBuilder builder;
    builder.hi = { 1, 1, 1e3 };
    builder.atoms = each.records;
    builder.processes = 1;
    if (each.bonds)
    {
      builder.atom_style = "hybrid";
      builder.styles = { "granular", "bond/gran" };
      builder.bond_styles = { { 1, 2 } };
    }
    else
    {
      builder.peratom_fixes = { { "contacthistory", "contacthistory", contact_history } };
    }
    std::ofstream out(path_, std::ios::binary);
    std::string head = builder.base();
    head.insert(head.size() - builder.fixes().size(), each.junk, '\1');
    out.write(head.data(), static_cast<std::streamsize>(head.size()));
    std::int64_t doubles = 0;
    for (std::int64_t i = 0; i < each.records; ++i)
    {
      doubles += static_cast<std::int64_t>(make_record(i, each.bonds).size());
    }
    const auto count = static_cast<std::int32_t>(doubles);
    out.write(reinterpret_cast<const char*>(&count), sizeof count);
    for (std::int64_t i = 0; i < each.records; ++i)
    {
      const restart_builder::Record record = make_record(i, each.bonds);
      out.write(reinterpret_cast<const char*>(record.data()),
        static_cast<std::streamsize>(record.size() * sizeof(double)));
    }
    bytes_ = static_cast<std::int64_t>(out.tellp());
  }
  RestartFile(const RestartFile&) = delete;
  RestartFile& operator=(const RestartFile&) = delete;
  ~RestartFile() { std::remove(path_.c_str()); }

  const std::string& path() const noexcept { return path_; }
  std::int64_t bytes() const noexcept { return bytes_; }

private:
  std::string path_;
  std::int64_t bytes_ = 0;
};

/// The whole file, into fresh memory that holds all of it, or into some that is used again and again.
bool read_plainly(const ByteSource& source, std::int64_t bytes, bool whole)
{
  const std::size_t piece = std::size_t{ 1 } << 20;
  // not by malloc, which keeps what was given back
  const Mapping fresh = whole ? map_memory(static_cast<std::size_t>(bytes)) : Mapping();
  static std::vector<char> reused(piece);
  char* const memory = whole ? static_cast<char*>(fresh.base) : reused.data();
  std::int64_t done = 0;
  while (memory && done < bytes)
  {
    done += static_cast<std::int64_t>(source.read(done, memory + (whole ? done : 0),
      std::min<std::size_t>(piece, static_cast<std::size_t>(bytes - done))));
  }
  benchmark::DoNotOptimize(memory);
  unmap_memory(fresh);
  return done == bytes;
}

void measure(benchmark::State& state, const Case& each)
{
  const RestartFile file(each);
  const std::unique_ptr<ByteSource> source = open_file(file.path());
  Notices notices;
  Progress progress;
  RestartLayout layout;
  RestartRequest request;
  request.lines.pool = std::make_shared<BlockPool>(std::size_t{ 4 } << 30);
  request.lines.threads = each.threads;
  Rounds rounds(wall);
  rounds.add("reused", [&] { return read_plainly(*source, file.bytes(), false); });
  rounds.add("whole", [&] { return read_plainly(*source, file.bytes(), true); });
  rounds.add("find",
    [&]
    {
      layout = read_layout(*source, notices, progress);
      return layout.records == each.records;
    });
  layout = read_layout(*source, notices, progress);
  const std::int64_t bonds = each.bonds ? each.records / grains_a_fibre * (grains_a_fibre - 1) : 0;
  rounds.add("read",
    [&]
    {
      const RestartFrame frame = read_restart(*source, layout, request, notices, progress);
      return frame.particles.rows == each.records && frame.bonds.table.rows == bonds;
    });
  const auto bytes = static_cast<double>(file.bytes());
  for (auto _ : state)
  {
    if (!rounds.run(bytes) || !notices.empty())
    {
      fail(state, "particles or bonds are not those that were written");
      return;
    }
    state.SetIterationTime(rounds.of("read").back() * bytes);
  }
  tell(state, "file", bytes / (1 << 20), "MiB");
  tell(state, "find", median(rounds.of("find")) * bytes, "s");
  for (const char* const name : { "reused", "whole", "read" })
  {
    tell(state, name, 1e-9 / median(rounds.of(name)), "GB/s");
  }
  tell(state, "ns", 1e9 * median(rounds.of("read")) * bytes / static_cast<double>(each.records),
    "ns/particle");
  tell(state, "read against whole", median_ratio(rounds.of("whole"), rounds.of("read")), "1");
  tell(state, "read against reused", median_ratio(rounds.of("reused"), rounds.of("read")), "1");
}
}

void add_benchmarks(const Size& size)
{
  const std::int64_t most = size.pick(1'000'000, 1'000);
  std::vector<Case> cases = {
    { "grains, 10^4", size.pick(10'000, 100), false, 1, 0 },
    { "grains", most, false, 1, 0 },
    { "grains, 2 threads", most, false, 2, 0 },
    { "fibres, 10^4", size.pick(10'000, 100), true, 1, 0 },
    { "fibres", most / 2, true, 1, 0 },
    { "fibres, 2 threads", most / 2, true, 2, 0 },
    { "fibres behind 200 MB", most / 2, true, 1,
      static_cast<std::size_t>(size.pick(200'000'000, 20'000)) },
  };
  if (size.large || !size.full)
  {
    cases.push_back({ "grains, 1 GiB", size.pick(4'330'000, 2'000), false, 2, 0 });
  }
  for (const Case& each : cases)
  {
    add(std::string("restart/") + each.name, size.pick(9, 1),
      [each](benchmark::State& state) { measure(state, each); });
  }
}
}
