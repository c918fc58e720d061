// SPDX-License-Identifier: BSD-3-Clause
// Bonded particles into messages for other ranks and out of them, against memcpy of as many doubles.
#include "granular_bonds.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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

/// Rows one after the other are packed, unpacked into new rows, of which the memory has been used before, or copied.
void measure(benchmark::State& state, int kind, const std::string& way)
{
  const auto count = static_cast<std::size_t>(state.range(0));
  const Particles particles = make_chain(count, kind == GRANULAR_BONDS_EXCHANGE);
  const Particles others = make_chain(count, kind == GRANULAR_BONDS_EXCHANGE);
  std::size_t doubles = 0;
  granular_bonds_pack(particles.get(), kind, 0, count, nullptr, nullptr, nullptr, 0, &doubles);
  std::vector<double> buffer(doubles);
  std::vector<double> copy(doubles);
  const auto pack = [&]
  {
    return granular_bonds_pack(particles.get(), kind, 0, count, nullptr, nullptr, buffer.data(),
             doubles, &doubles) == GRANULAR_BONDS_OK;
  };
  const auto unpack = [&]
  {
    std::size_t unpacked = 0;
    granular_bonds_resize(others.get(), 0);
    granular_bonds_unpack(others.get(), kind, 0, nullptr, buffer.data(), buffer.size(), &unpacked);
    return unpacked == count;
  };
  bool right = pack() && unpack();
  for (auto _ : state)
  {
    if (way == "memcpy")
    {
      std::memcpy(copy.data(), buffer.data(), buffer.size() * sizeof(double));
      benchmark::DoNotOptimize(copy.data());
      benchmark::ClobberMemory();
    }
    else
    {
      right = (way == "pack" ? pack() : unpack()) && right;
    }
  }
  if (!right)
  {
    state.SkipWithError("particles are lost");
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
}

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  constexpr std::pair<const char*, int> kinds[] = { { "comm", GRANULAR_BONDS_COMM },
    { "comm_vel", GRANULAR_BONDS_COMM_VELOCITY }, { "border", GRANULAR_BONDS_BORDER },
    { "border_hybrid", GRANULAR_BONDS_BORDER_HYBRID }, { "exchange", GRANULAR_BONDS_EXCHANGE } };
  for (const auto& [name, kind] : kinds)
  {
    for (const char* const way : { "memcpy", "pack", "unpack" })
    {
      benchmark::RegisterBenchmark((std::string(name) + "/" + way).c_str(),
        [kind = kind, way](benchmark::State& state) { measure(state, kind, way); })
        ->Arg(10'000)
        ->Arg(1'000'000);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
