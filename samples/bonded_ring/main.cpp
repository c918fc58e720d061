// SPDX-License-Identifier: BSD-3-Clause
// bonded_ring
//
// Fibres of bonded particles fly through a periodic box that is cut into a slab for each process. A particle that
// leaves its slab goes to the next process, with its bonds and their history; at the end the first process
// looks whether every bond and value is where it should be. The simulation is a toy: nobody meets anybody.
#include "granular/bonds/exchange_packing.h"
#include "granular/mpi/mpi_communicator.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <vector>

namespace
{
constexpr std::int64_t fibres = 8;
constexpr std::int64_t fibre_particles = 25;
constexpr int steps = 1500;
constexpr double time_step = 1.0 / 64;
constexpr double box_length = 16;
constexpr std::int32_t history_values = 12;
constexpr auto dialect = granular::PackDialect::WithBonds;

using Buffer = std::vector<double>;

/// All fibres, which are closed, by tag from 1; each flies at its own speed. Numbers that add up without rounding.
granular::BondedParticles make_fibres()
{
  granular::BondedParticles particles(2, history_values);
  Buffer history(history_values);
  for (std::int64_t k = 0; k < fibres * fibre_particles; ++k)
  {
    const std::int64_t place = k % fibre_particles;
    const std::size_t i = particles.add(1, { static_cast<double>(place) / 2, 0, 0 });
    particles.tag()[i] = k + 1;
    particles.v()[i] = { 1 + static_cast<double>(k / fibre_particles) / 8, 0, 0 };
    for (const std::int64_t step : { fibre_particles - 1, std::int64_t{ 1 } })
    {
      std::iota(history.begin(), history.end(), 0.1 + static_cast<double>(1000 * k + step));
      particles.add_bond(i, 1, 1 + k - place + (place + step) % fibre_particles, history);
    }
  }
  return particles;
}

/// Moves all by one step, and gives the rows of those that left the slab.
std::vector<std::size_t> move(granular::BondedParticles& particles, int rank, int size)
{
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    double& x = particles.x()[i][0];
    x += time_step * particles.v()[i][0];
    if (x >= box_length)
    {
      x -= box_length;
      ++particles.image()[i].x;
    }
    if (int(x / box_length * size) != rank)
    {
      left.push_back(i);
    }
  }
  return left;
}

/// Hands particles to another process, and takes those that come.
void hand_over(granular::Communicator& ranks, granular::BondedParticles& particles,
  const std::vector<std::size_t>& rows, int to)
{
  Buffer buffer(granular::exchange_doubles(particles, dialect, rows));
  granular::pack_exchange(particles, dialect, rows, buffer);
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
  {
    particles.remove(*row); // from behind: the last one, which takes the row, stays
  }
  std::vector<std::int64_t> going(static_cast<std::size_t>(ranks.size())), coming(going);
  const std::vector<std::int64_t> eight(going.size(), 8);
  going[static_cast<std::size_t>(to)] = static_cast<std::int64_t>(buffer.size() * sizeof(double));
  ranks.exchange(reinterpret_cast<const char*>(going.data()), eight,
    reinterpret_cast<char*>(coming.data()), eight);
  const auto bytes = std::accumulate(coming.begin(), coming.end(), std::int64_t{ 0 });
  Buffer came(static_cast<std::size_t>(bytes) / sizeof(double));
  ranks.exchange(reinterpret_cast<const char*>(buffer.data()), going,
    reinterpret_cast<char*>(came.data()), coming);
  granular::do_together(ranks, [&] { granular::unpack_exchange(particles, dialect, came); });
}

/// How many of the particles are where they should be, with their bonds as they were made.
std::int64_t count_right(const granular::BondedParticles& particles)
{
  const granular::BondedParticles made = make_fibres();
  std::int64_t right = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const auto k = static_cast<std::size_t>(particles.tag()[i]) - 1;
    const double flown = steps * time_step * made.v()[k][0];
    const bool there =
      particles.x()[i][0] + box_length * particles.image()[i].x == made.x()[k][0] + flown;
    right += there && std::ranges::equal(particles.partners(i), made.partners(k)) &&
        std::ranges::equal(particles.history(i), made.history(k))
      ? 1
      : 0;
  }
  return right;
}
}

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  std::int64_t counts[] = { 0, 0 };
  {
    granular::MpiCommunicator ranks(MPI_COMM_WORLD);
    const int rank = ranks.rank();
    granular::BondedParticles particles = make_fibres();
    for (std::size_t i = particles.size(); i-- > 0;)
    {
      if (int(particles.x()[i][0] / box_length * ranks.size()) != rank)
      {
        particles.remove(i);
      }
    }
    for (int step = 0; step < steps; ++step)
    {
      const std::vector<std::size_t> rows = move(particles, rank, ranks.size());
      counts[0] += static_cast<std::int64_t>(rows.size());
      hand_over(ranks, particles, rows, (rank + 1) % ranks.size());
    }
    std::vector<std::size_t> all(rank == 0 ? 0 : particles.size());
    std::iota(all.begin(), all.end(), std::size_t{ 0 });
    hand_over(ranks, particles, all, 0);
    counts[1] = rank == 0 ? count_right(particles) : 0;
    ranks.sum(counts);
    if (rank == 0)
    {
      std::printf("%d processes, %d of %d particles right, handed over %d times\n", ranks.size(),
        static_cast<int>(counts[1]), static_cast<int>(fibres * fibre_particles),
        static_cast<int>(counts[0]));
    }
  }
  MPI_Finalize();
  return counts[1] == fibres * fibre_particles ? 0 : 1;
}
