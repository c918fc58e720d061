// SPDX-License-Identifier: BSD-3-Clause
// Bonded particles into buffers for other processes and out of them, against memcpy of as many bytes from one
// buffer to another, in turns.
#include "bench.h"

#include "granular/bonds/exchange_packing.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace bench
{
namespace
{
using granular::BondedParticles;
using granular::PackDialect;
using granular::PackRoutine;
using granular::ParticleRange;

constexpr granular::PeriodicShift no_shift;

struct Case
{
  const char* name;
  PackRoutine routine;
  PackDialect dialect;
};

constexpr Case cases[] = {
  { "comm", PackRoutine::Comm, PackDialect::Pfm },
  { "comm_plain", PackRoutine::Comm, PackDialect::WithBonds },
  { "comm_velocity", PackRoutine::CommVelocity, PackDialect::Pfm },
  { "comm_velocity_plain", PackRoutine::CommVelocity, PackDialect::WithBonds },
  { "border", PackRoutine::Border, PackDialect::Pfm },
  { "border_plain", PackRoutine::Border, PackDialect::WithBonds },
  { "border_velocity", PackRoutine::BorderVelocity, PackDialect::Pfm },
};

constexpr Case new_cases[] = {
  { "border_new", PackRoutine::Border, PackDialect::Pfm },
  { "border_new_plain", PackRoutine::Border, PackDialect::WithBonds },
  { "border_velocity_new", PackRoutine::BorderVelocity, PackDialect::Pfm },
};

/// Two bonds with twelve history values a particle, as in a chain.
BondedParticles make_chain(std::size_t count, bool bonds)
{
  BondedParticles particles(bonds ? 2 : 1, bonds ? 12 : 0);
  particles.resize(count);
  const std::vector<double> history(12, 0.25);
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto id = static_cast<std::int64_t>(i);
    particles.x()[i] = { static_cast<double>(i), 0.5, -1 };
    particles.tag()[i] = id + 1;
    particles.type()[i] = 1 + static_cast<std::int32_t>(i % 3);
    particles.molecule()[i] = id / 10;
    for (std::int64_t side = bonds ? 0 : 2; side < 2; ++side)
    {
      particles.add_bond(i, 1, id + 2 * side, history);
    }
  }
  return particles;
}

/// Runs pack and unpack against a copy of the buffer, and tells it.
void measure(benchmark::State& state, std::size_t count, std::vector<double>& buffer,
  const std::function<bool()>& pack, const std::function<bool()>& unpack)
{
  std::vector<double> copy(buffer.size());
  const int repeats = static_cast<int>(std::max<std::size_t>(1, 400'000 / count));
  Rounds rounds;
  rounds.add("pack", pack);
  rounds.add("unpack", unpack);
  rounds.add("memcpy",
    [&]
    {
      std::memcpy(copy.data(), buffer.data(), buffer.size() * sizeof(double));
      benchmark::DoNotOptimize(copy.data());
      benchmark::ClobberMemory();
      return true;
    });
  if (!rounds.run_all(state, "a particle is not what it was", static_cast<double>(count), repeats))
  {
    return;
  }
  for (const char* const what : { "pack", "unpack" })
  {
    tell(state, what, 1e9 * median(rounds.of(what)), "ns/particle");
    tell(state, std::string("speed of ") + what + " against memcpy",
      median_ratio(rounds.of("memcpy"), rounds.of(what)), "1");
    tell(state, std::string("spread of ") + what,
      spread_of_ratio(rounds.of("memcpy"), rounds.of(what)), "1");
  }
  tell(state, "memcpy", 1e9 * median(rounds.of("memcpy")), "ns/particle");
}

void one_routine(benchmark::State& state, const Case& each, std::size_t count)
{
  BondedParticles particles = make_chain(count, false);
  std::vector<double> buffer(count * granular::packed_doubles(each.routine, each.dialect));
  const ParticleRange all{ 0, count };
  measure(
    state, count, buffer,
    [&]
    {
      granular::pack(particles, each.routine, each.dialect, all, no_shift, buffer);
      return buffer[buffer.size() - buffer.size() / count] == static_cast<double>(count - 1);
    },
    [&]
    {
      granular::unpack(particles, each.routine, each.dialect, all, buffer);
      return particles.x()[count - 1][0] == static_cast<double>(count - 1);
    });
}

/// New copies of particles, behind those that there are: what setting up a border does.
void new_copies(benchmark::State& state, const Case& each, std::size_t count)
{
  BondedParticles particles = make_chain(count, false);
  particles.grow(2 * count);
  std::vector<double> buffer(count * granular::packed_doubles(each.routine, each.dialect));
  granular::pack(
    particles, each.routine, each.dialect, ParticleRange{ 0, count }, no_shift, buffer);
  const auto add = [&]
  {
    particles.resize(count);
    granular::unpack(particles, each.routine, each.dialect, { count, count }, buffer);
    return particles.size() == 2 * count;
  };
  add(); // touches the memory
  measure(
    state, count, buffer,
    [&]
    {
      granular::pack(
        particles, each.routine, each.dialect, ParticleRange{ 0, count }, no_shift, buffer);
      return true;
    },
    add);
}

void exchange(benchmark::State& state, std::size_t count)
{
  const BondedParticles particles = make_chain(count, true);
  BondedParticles others(2, 12);
  others.grow(count);
  const ParticleRange all{ 0, count };
  std::vector<double> buffer(granular::exchange_doubles(particles, PackDialect::Pfm, all));
  measure(
    state, count, buffer,
    [&]
    {
      granular::pack_exchange(particles, PackDialect::Pfm, all, buffer);
      return true;
    },
    [&]
    {
      others.clear();
      return granular::unpack_exchange(others, PackDialect::Pfm, buffer) == count &&
        others.partners(count - 1)[0] == particles.partners(count - 1)[0];
    });
}
}

void add_benchmarks(const Size& size)
{
  const std::int64_t most = size.pick(size.large ? 10'000'000 : 1'000'000, 1'000);
  for (std::int64_t count = std::min<std::int64_t>(most, 10'000); count <= most; count *= 10)
  {
    const auto particles = static_cast<std::size_t>(count);
    const std::int64_t rounds = size.pick(count < 1'000'000 ? 51 : 15, 1);
    const std::string suffix = "/" + std::to_string(count);
    for (const Case& each : cases)
    {
      add(std::string("bonds/pack_") + each.name + suffix, rounds,
        [&each, particles](benchmark::State& state) { one_routine(state, each, particles); });
    }
    for (const Case& each : new_cases)
    {
      add(std::string("bonds/pack_") + each.name + suffix, rounds,
        [&each, particles](benchmark::State& state) { new_copies(state, each, particles); });
    }
    add("bonds/pack_exchange" + suffix, rounds,
      [particles](benchmark::State& state) { exchange(state, particles); });
  }
}
}
