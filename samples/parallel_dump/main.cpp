// SPDX-License-Identifier: BSD-3-Clause
// parallel_dump FILE [gather | mpi-io]
//
// A simulation whose processes write one `dump atom` together: scaled coordinates and image counts, in
// the order of the ids, so that the file does not depend on the number of processes. A name that ends in
// .bin gives a binary file. The simulation is a toy - particles fly through a periodic box and meet
// nobody - but its atoms lie in memory as those of a real one do.
#include "granular/formats/dump/write/dump_writer.h"
#include "granular/mpi/mpi_communicator.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace
{
constexpr int all_atoms = 500;
constexpr int last_step = 400;
constexpr int steps_between_frames = 100;
constexpr double time_step = 1.0 / 128;
constexpr double low = -1; // the box is a cube
constexpr double high = 4;

/// The atoms of one process; x, v and image have three numbers of each.
struct Atoms
{
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> type;
  std::vector<double> x;
  std::vector<double> v;
  std::vector<std::int32_t> image;
};

/// A number from 0 to 1, without 1, that looks like chance.
double hashed(std::int64_t n)
{
  return static_cast<double>(n * 2654435761 % 1048576) / 1048576;
}

/// Every size-th atom is this process'; a real code would go by where they are.
Atoms make_atoms(int rank, int size)
{
  Atoms atoms;
  for (std::int64_t id = 1 + rank; id <= all_atoms; id += size)
  {
    atoms.id.push_back(id);
    atoms.type.push_back(id % 5 == 0 ? 2 : 1);
    for (std::int64_t axis = 0; axis < 3; ++axis)
    {
      atoms.x.push_back(low + (high - low) * hashed(17 * id + 5 * axis));
      atoms.v.push_back(4 * hashed(23 * id + 7 * axis) - 2);
      atoms.image.push_back(0);
    }
  }
  return atoms;
}

/// Moves the atoms by one step, and back into the box those that left it.
void move(Atoms& atoms)
{
  for (std::size_t i = 0; i < atoms.x.size(); ++i)
  {
    atoms.x[i] += time_step * atoms.v[i];
    const int crossed = atoms.x[i] < low ? -1 : atoms.x[i] >= high ? 1 : 0;
    atoms.x[i] -= crossed * (high - low);
    atoms.image[i] += crossed;
  }
}

void simulate(const std::string& path, granular::ParallelMode mode, granular::Communicator& ranks)
{
  granular::DumpFormat format;
  format.style = granular::DumpStyle::Atom;
  format.atom = { .scaled = true, .image = true };
  format.binary = granular::is_binary_name(path);
  format.compression = granular::compression_of_name(path);
  format.numbers = granular::parse_number_format("shortest");
  format.sort_by_id = true;

  granular::FrameHeader header;
  header.box = granular::Box::from_bounds({ low, low, low }, { high, high, high });
  header.box.boundary = "pp pp pp";

  granular::DumpWriter writer(path, format, { .mode = mode }, ranks);
  granular::Notices notices; // what a user should know but loses nothing; here: none
  granular::Progress nobody_asks;

  Atoms atoms = make_atoms(ranks.rank(), ranks.size());
  for (int step = 0; step <= last_step; ++step)
  {
    if (step % steps_between_frames == 0)
    {
      header.timestep = step;
      const granular::AtomRows rows{ static_cast<std::int64_t>(atoms.id.size()), atoms.id.data(),
        atoms.type.data(), atoms.x.data(), atoms.image.data() };
      writer.write(granular::view_atoms(rows, header), notices, nobody_asks);
    }
    move(atoms);
  }
  writer.finish(); // until here the file has another name
}

/// An error on one process is thrown on all of them: they leave together, and one says why.
bool run(const std::string& path, granular::ParallelMode mode)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  try
  {
    simulate(path, mode, ranks);
    return true;
  }
  catch (const granular::Error& error)
  {
    if (ranks.rank() == 0)
    {
      std::fprintf(stderr, "%s\n", error.what());
    }
    return false;
  }
}
}

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  const std::string how = argc > 2 ? argv[2] : "gather";
  const bool done = argc > 1 &&
    run(argv[1], how == "mpi-io" ? granular::ParallelMode::MpiIo : granular::ParallelMode::Gather);
  MPI_Finalize();
  return done ? 0 : 1;
}
