// SPDX-License-Identifier: BSD-3-Clause
// Bonded particles into messages for other ranks and out of them, against memcpy of as many bytes, in turns.
#include "bench.h"

#include "granular_bonds.h"

#include <algorithm>
#include <cstring>
#include <memory>

namespace bench
{
namespace
{
using Particles = std::unique_ptr<granular_bonds, decltype(&granular_bonds_destroy)>;

/// A chain; with bonds, two of twelve history values a particle.
Particles make_chain(std::size_t count, bool bonds)
{
  granular_bonds* made = nullptr;
  granular_bonds_create(bonds ? 2 : 1, bonds ? 12 : 0, &made);
  granular_bonds_resize(made, count);
  granular_bonds_arrays a;
  granular_bonds_view(made, &a);
  const std::vector<double> history(12, 0.25);
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto id = static_cast<std::int64_t>(i) + 1;
    a.x[3 * i] = static_cast<double>(i);
    a.tag[i] = id;
    a.type[i] = 1 + static_cast<std::int32_t>(i % 3);
    a.molecule[i] = id / 10;
    for (std::int64_t partner = bonds ? id - 1 : id + 2; partner < id + 2; partner += 2)
    {
      granular_bonds_add_bond(made, i, 1, partner, history.data());
    }
  }
  return { made, granular_bonds_destroy };
}

/// Rows one after the other are packed, and unpacked into new rows, of which the memory has been used before.
void measure(benchmark::State& state, int kind, std::size_t count)
{
  const bool exchange = kind == GRANULAR_BONDS_EXCHANGE;
  const Particles particles = make_chain(count, exchange);
  const Particles others = make_chain(count, exchange);
  std::size_t doubles = 0;
  granular_bonds_pack(particles.get(), kind, 0, count, nullptr, nullptr, nullptr, 0, &doubles);
  std::vector<double> buffer(doubles), copy(doubles);
  Rounds rounds;
  rounds.add("pack",
    [&]
    {
      return granular_bonds_pack(particles.get(), kind, 0, count, nullptr, nullptr, buffer.data(),
               doubles, &doubles) == GRANULAR_BONDS_OK;
    });
  rounds.add("unpack",
    [&]
    {
      std::size_t unpacked = 0;
      granular_bonds_resize(others.get(), 0);
      granular_bonds_unpack(
        others.get(), kind, 0, nullptr, buffer.data(), buffer.size(), &unpacked);
      return unpacked == count;
    });
  rounds.add("memcpy",
    [&]
    {
      std::memcpy(copy.data(), buffer.data(), buffer.size() * sizeof(double));
      benchmark::DoNotOptimize(copy.data());
      benchmark::ClobberMemory();
      return true;
    });
  const int repeats = static_cast<int>(std::max<std::size_t>(1, 400'000 / count));
  if (!rounds.run_all(state, "particles are lost", static_cast<double>(count), repeats))
  {
    return;
  }
  for (const char* const way : { "pack", "unpack", "memcpy" })
  {
    tell(state, way, 1e9 * median(rounds.of(way)), "ns/particle");
    tell(state, std::string(way) + " against memcpy",
      median_ratio(rounds.of(way), rounds.of("memcpy")), "1");
  }
}
}

void add_benchmarks(const Size& size)
{
  constexpr const char* names[] = { "comm", "comm_vel", "border", "border_vel", "border_hybrid",
    "reverse", "exchange" };
  for (const std::int64_t count : { size.pick(10'000, 100), size.pick(1'000'000, 1'000) })
  {
    for (const int kind : { GRANULAR_BONDS_COMM, GRANULAR_BONDS_COMM_VELOCITY,
           GRANULAR_BONDS_BORDER, GRANULAR_BONDS_BORDER_HYBRID, GRANULAR_BONDS_EXCHANGE })
    {
      add("bonds/" + std::string(names[kind]) + ", " + std::to_string(count) + " particles", 55,
        [kind, count](benchmark::State& state)
        { measure(state, kind, static_cast<std::size_t>(count)); });
    }
  }
}
}
