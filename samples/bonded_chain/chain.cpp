// SPDX-License-Identifier: BSD-3-Clause
// A chain of bonded particles in the memory of a simulation code: two ranks share it, send each other copies and particles, and
// write restart records. Here both ranks are objects of one program; a code on many ranks sends the buffers by MPI.
#include <granular_bonds.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace
{
const int particles_in_all = 6;
const int history_values = 3;

/// Ends the program with the message of the library.
void need(granular_bonds_status status)
{
  if (status != GRANULAR_BONDS_OK)
  {
    std::fprintf(stderr, "%s\n", granular_bonds_last_error());
    std::exit(1);
  }
}

granular_bonds* create()
{
  granular_bonds* particles = nullptr;
  need(granular_bonds_create(2, history_values, &particles));
  need(granular_bonds_grow(particles, 0)); // room for 10,000 at once
  return particles;
}

granular_bonds_arrays arrays_of(granular_bonds* particles)
{
  granular_bonds_arrays arrays;
  need(granular_bonds_view(particles, &arrays));
  return arrays;
}

/// Adds a particle of the chain, with bonds to those beside it and a history of its own.
void add(granular_bonds* particles, int tag)
{
  const double x[3] = { 0.5 * tag, 0, 0 };
  size_t row = 0;
  need(granular_bonds_add(particles, 1, x, &row));
  arrays_of(particles).tag[row] = tag;
  for (int partner = tag - 1; partner <= tag + 1; partner += 2)
  {
    const double history[history_values] = { 0.1 * tag, 0.2 * partner, 0 };
    if (partner >= 1 && partner <= particles_in_all)
    {
      need(granular_bonds_add_bond(particles, row, 1, partner, history));
    }
  }
}

/// Packs rows for another rank.
std::vector<double> pack(granular_bonds* particles, int kind, const std::vector<int32_t>& rows)
{
  size_t doubles = 0;
  need(granular_bonds_pack(
    particles, kind, 0, rows.size(), rows.data(), nullptr, nullptr, 0, &doubles));
  std::vector<double> buffer(doubles);
  need(granular_bonds_pack(
    particles, kind, 0, rows.size(), rows.data(), nullptr, buffer.data(), buffer.size(), &doubles));
  return buffer;
}

void unpack(granular_bonds* particles, int kind, size_t first, const std::vector<double>& buffer)
{
  need(
    granular_bonds_unpack(particles, kind, first, nullptr, buffer.data(), buffer.size(), nullptr));
}

void print(const char* rank, granular_bonds* particles)
{
  const granular_bonds_arrays a = arrays_of(particles);
  double history = 0;
  int bonds = 0;
  std::printf("%s:", rank);
  for (size_t i = 0; i < a.size; ++i)
  {
    std::printf(" %d", static_cast<int>(a.tag[i]));
    bonds += a.bonds[i];
    for (int k = 0; k < a.bonds[i] * history_values; ++k)
    {
      history += a.history[i * 2 * history_values + static_cast<size_t>(k)];
    }
  }
  std::printf("\n  %d bonds, history %4.1f\n", bonds, history);
}
}

int main()
{
  granular_bonds* const left = create();
  granular_bonds* const right = create();
  for (int tag = 1; tag <= particles_in_all; ++tag)
  {
    add(tag <= 3 ? left : right, tag);
  }

  // the right rank needs a copy of particle 3, the last one of the left rank, behind its own; then only its new position
  const std::vector<int32_t> at_the_border(1, 2);
  const size_t own = arrays_of(right).size;
  std::vector<double> buffer = pack(left, GRANULAR_BONDS_BORDER, at_the_border);
  std::printf("border: %d doubles\n", static_cast<int>(buffer.size()));
  unpack(right, GRANULAR_BONDS_BORDER, own, buffer);
  arrays_of(left).x[3 * 2] = 1.75;
  buffer = pack(left, GRANULAR_BONDS_COMM, at_the_border);
  std::printf("comm: %d doubles\n", static_cast<int>(buffer.size()));
  unpack(right, GRANULAR_BONDS_COMM, own, buffer);
  std::printf("copy of particle %d at %.2f\n", static_cast<int>(arrays_of(right).tag[own]),
    arrays_of(right).x[3 * own]);

  // the force on the copy goes back
  arrays_of(right).f[3 * own] = -8;
  size_t doubles = 0;
  buffer.resize(3);
  need(granular_bonds_pack(
    right, GRANULAR_BONDS_REVERSE, own, 1, nullptr, nullptr, buffer.data(), 3, &doubles));
  need(granular_bonds_unpack(
    left, GRANULAR_BONDS_REVERSE, 0, at_the_border.data(), buffer.data(), 3, nullptr));
  std::printf("force on particle 3: %.1f\n", arrays_of(left).f[3 * 2]);

  // particle 3 goes to the right rank, with its bonds; copies end first
  need(granular_bonds_resize(right, own));
  buffer = pack(left, GRANULAR_BONDS_EXCHANGE, at_the_border);
  std::printf("exchange: %d doubles\n", static_cast<int>(buffer.size()));
  unpack(right, GRANULAR_BONDS_EXCHANGE, own, buffer);
  need(granular_bonds_remove(left, 2));
  print("left", left);
  print("right", right);

  // the records of a restart file, and what is read from them
  std::vector<double> records(1000);
  size_t size = 0;
  for (size_t row = 0; row < arrays_of(right).size; ++row)
  {
    need(granular_bonds_pack_record(
      right, row, nullptr, nullptr, 0, records.data() + size, records.size() - size, &doubles));
    size += doubles;
  }
  std::printf("restart: %d doubles\n", static_cast<int>(size));
  granular_bonds* const restarted = create();
  for (size_t place = 0; place < size; place += doubles)
  {
    need(granular_bonds_unpack_record(
      restarted, nullptr, 0, records.data() + place, size - place, &doubles));
  }
  print("restarted", restarted);
  std::printf("memory: %d bytes\n", static_cast<int>(arrays_of(restarted).memory));
  for (granular_bonds* const particles : { left, right, restarted })
  {
    granular_bonds_destroy(particles);
  }
  return 0;
}
