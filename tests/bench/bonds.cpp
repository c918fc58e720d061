// SPDX-License-Identifier: BSD-3-Clause
// Bonded particles into messages for other ranks and into records of restart files, and out of them, against memcpy of as many doubles.
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

constexpr int record = -1; ///< kind of the records of restart files, beside those of messages

/// Packs all particles and returns the number of doubles; null: only their number.
std::size_t pack(
  const granular_bonds* particles, int kind, std::size_t count, double* buffer, std::size_t room)
{
  std::size_t doubles = 0;
  if (kind != record)
  {
    granular_bonds_pack(particles, kind, 0, count, nullptr, nullptr, buffer, room, &doubles);
    return doubles;
  }
  std::size_t length = 0;
  for (std::size_t i = 0; i < count; ++i, doubles += length)
  {
    granular_bonds_pack_record(particles, i, nullptr, nullptr, 0,
      buffer ? buffer + doubles : nullptr, room - doubles, &length);
  }
  return doubles;
}

/// Returns the number of particles that came out.
std::size_t unpack(granular_bonds* particles, int kind, const std::vector<double>& buffer)
{
  std::size_t count = 0;
  granular_bonds_resize(particles, 0);
  if (kind != record)
  {
    granular_bonds_unpack(particles, kind, 0, nullptr, buffer.data(), buffer.size(), &count);
    return count;
  }
  for (std::size_t at = 0, length = 0; at < buffer.size(); at += length, ++count)
  {
    if (granular_bonds_unpack_record(particles, nullptr, 0, buffer.data() + at, buffer.size() - at,
          &length) != GRANULAR_BONDS_OK)
    {
      break;
    }
  }
  return count;
}

/// Rows one after the other are packed, unpacked into new rows, of which the memory has been used before, or copied.
void measure(benchmark::State& state, int kind, const std::string& way)
{
  const auto count = static_cast<std::size_t>(state.range(0));
  const bool bonds = kind == GRANULAR_BONDS_EXCHANGE || kind == record;
  const Particles particles = make_chain(count, bonds);
  const Particles others = make_chain(count, bonds);
  std::vector<double> buffer(pack(particles.get(), kind, count, nullptr, 0));
  std::vector<double> copy(buffer.size());
  const auto packs = [&]
  { return pack(particles.get(), kind, count, buffer.data(), buffer.size()) == buffer.size(); };
  const auto unpacks = [&] { return unpack(others.get(), kind, buffer) == count; };
  bool right = packs() && unpacks();
  pack(others.get(), kind, count, copy.data(), copy.size());
  right = right &&
    std::memcmp(copy.data(), buffer.data(), buffer.size() * sizeof(double)) ==
      0; // every bit comes back
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
      right = (way == "pack" ? packs() : unpacks()) && right;
    }
  }
  if (!right)
  {
    state.SkipWithError("particles or bits are lost");
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
}

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  constexpr std::pair<const char*, int> kinds[] = { { "comm", GRANULAR_BONDS_COMM },
    { "comm_vel", GRANULAR_BONDS_COMM_VELOCITY }, { "border", GRANULAR_BONDS_BORDER },
    { "border_hybrid", GRANULAR_BONDS_BORDER_HYBRID }, { "exchange", GRANULAR_BONDS_EXCHANGE },
    { "record", record } };
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
