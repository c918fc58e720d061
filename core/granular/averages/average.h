// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_average_h
#define granular_averages_average_h

#include "granular/averages/particle_cells.h"
#include "granular/averages/particle_loader.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/grid/cells.h"
#include "granular/grid/euler_grid.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
class FoundEnds;

/// The cells of a grid that a rank wants: those of a range with numbers in [first, last), in order.
struct WantedCells
{
  CellRange range;
  std::int64_t first = 0;
  std::int64_t last = 0;

  static WantedCells all(const EulerGrid& grid) noexcept;

  std::int64_t count(const EulerGrid& grid) const noexcept;

  /// Returns the index of a cell among the wanted ones, or -1.
  std::int64_t place(const EulerGrid& grid, const std::array<std::int64_t, 3>& cell) const noexcept;
};

struct EulerAverageRequest
{
  EulerGrid grid;
  WeightOptions cells;
  ParticleArrayNames arrays;
  WantedCells wanted;     ///< of this rank
  bool keep_sums = false; ///< fill EulerAverages::sums
  bool pressure = true; ///< false, without tensors or a temperature: no fluctuations are looked at
  bool tensors = false; ///< fill normal_stress and shear_stress without a stress of particles, too
  EulerFieldSet fields;
};

/// The sums behind averages over several frames: structure of arrays, of the wanted cells.
struct EulerSums
{
  std::vector<double> share;    ///< share of the particles in each cell: sum w
  std::vector<double> mass;     ///< sum w m [kg]
  std::vector<double> momentum; ///< sum w m v, three a cell [kg m/s]
  std::vector<double> volume;   ///< of the cell [m3]
  std::vector<double>
    ends; ///< of contacts: 2 for each between particles, 1 with a wall; empty without contacts
  std::vector<double> contacts; ///< that have a normal
  std::vector<double> normals;  ///< sums of its products, six a cell, or empty
};

/// Averages over the particles of a frame.
struct EulerAverages
{
  EulerCells cells; ///< the wanted ones
  EulerFields fields;
  EulerSums sums; ///< of the wanted ones, or empty
  std::int64_t outside =
    0; ///< particles that touch no cell; with Centre, particles whose centre is in none
  std::int64_t broken = 0; ///< particles that were left out: see ParticleLoader::load

  /// Makes room for so many cells, and for what is wanted of particles.
  void make_room(std::int64_t count, bool tensors, const EulerFieldSet& wanted);

  /// Makes room for what is wanted of contacts. stress: they have forces.
  void make_contact_room(std::int64_t count, bool stress, const EulerFieldSet& wanted);

  // Stores what sums in a volume give, where there is room for it: over particles (share, mass, momentum, radius, volume),
  // of fluctuation_terms, of the stress of contacts and the number of their ends, of products of their normals.
  void store_means(std::size_t cell, const double* all, const Vector3& mean, double of_volume);
  void store_fluctuations(std::size_t cell, const double* all, double mass, double of_volume);
  void store_contacts(std::size_t cell, const double* all, double share, double of_volume);
  void store_fabric(std::size_t cell, const double* all, double contacts);
};

/// Returns v - mean, or 0 if the difference may come from the rounding of the mean: its terms, sums and quotients are rounded
/// up to ten times. Otherwise one particle, or particles with one common velocity, would have a pressure.
inline double deviation(double v, double mean) noexcept
{
  const double difference = v - mean;
  return std::abs(difference) > 0x1p-49 * std::abs(mean) ? difference : 0;
}

/// Returns the mean velocity by the sums of masses and of the momentum, one after the other; 0 without a mass.
inline Vector3 mean_velocity(const double* mass_and_momentum) noexcept
{
  const double mass = mass_and_momentum[0];
  Vector3 mean = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    mean[axis] = mass > 0 ? mass_and_momentum[1 + axis] / mass : 0;
  }
  return mean;
}

/// Returns what a particle adds to the stress, xx yy zz xy xz yz, and its mass times the square of its velocity, about a mean.
inline std::array<double, 7> fluctuation_terms(
  double mass, const double* velocity, const Vector3& mean) noexcept
{
  const double x = deviation(velocity[0], mean[0]);
  const double y = deviation(velocity[1], mean[1]);
  const double z = deviation(velocity[2], mean[2]);
  return { -mass * x * x, -mass * y * y, -mass * z * z, -mass * x * y, -mass * x * z, -mass * y * z,
    mass * (x * x + y * y + z * z) };
}

/// Averages the particles of a frame over the cells of a grid. With the share w of a particle in a cell, its mass m, radius r,
/// velocity v, stress times volume S, and V the volume of the cell:
///   v_avg = sum w m v / sum w m; radius = sum w r / sum w; volume fraction = volume of the particles in the cell / V;
///   stress = sum (-w m (v - v_avg)(v - v_avg) + w S) / V; pressure = -trace(stress) / 3
/// as fix ave/euler of LIGGGHTS has it, where w is 1 or 0: the particles of one moment, no average over time. Without S
/// the stress is that of the fluctuations of velocity alone; components of v - v_avg count as 0 up to 2^-49 v_avg, which
/// rounding may make: particles of one velocity have no pressure. Where particles overlap one another their common volume
/// counts for each of them.
///
/// With a kernel the share of a particle is the value of the kernel at the centre of the cell over the sum of these values: see
/// SmoothCells. Granular temperature: sum w m |v - v_avg|^2 / (3 sum w m).
///
/// Cells are lo <= x < hi; the last along an axis has x <= hi. Positions and images: see AbsolutePositions and ParticleCells;
/// an image is on that side of a face on which the exact image of its position in the box is, which is less than an ulp off.
/// Sums are those of exact arithmetic, rounded once, of terms that are rounded doubles (of stresses: to 2^-192 of the term of
/// a particle as heavy and as fast as all in the cell together): the results are the same, bit for bit, for any order of rows,
/// threads and ranks.
///
/// The ranks have a part of the particles each; share_header has been called. Throws, on all: Error: rows without
/// points, overlap without radii, arrays of other sizes; LimitError where the memory that is available does not
/// suffice; Cancelled. Collective.
EulerAverages average_in_cells(const FrameView& frame, const EulerAverageRequest& request,
  Communicator& ranks, const Executor& executor, Notices& notices, Progress& progress);

/// Checks what is known of the particles of all ranks, and tells what is not. Returns their number. Throws Error: rows without
/// points, arrays that differ between ranks, no radii where they are needed. Collective.
std::int64_t check_particles(const FrameView& frame, const ParticleSources& sources,
  const ParticleArrayNames& arrays, bool need_radius, Communicator& ranks, Notices& notices);

/// Returns the largest radius of the particles of all ranks; 0 without particles. Throws Error, on all ranks, if there are no
/// radii. Collective.
double largest_radius(
  const FrameView& frame, const ParticleArrayNames& arrays, Communicator& ranks);

/// Adds the contacts to averages in cells: their stress, which is branch_a force_b over the volume, shared among the cells along
/// the branch vector, by length or by the kernel of the request; with walls from the wall to the centre. Fields: contact stress;
/// coordination: ends of contacts that count (2, with a wall 1) over particles, both by their parts in the cell; fabric: mean
/// product of normals of these contacts, trace 1. With sums if the request keeps them, which coordination needs. Contacts without
/// forces have no stress: the fields are empty. What averages know of particles stays: see add_contact_stress.
///
/// contacts: of this rank; may be anywhere. Those without a line (see ContactEnds::has_line) are left out. Sums as
/// average_in_cells has them; terms of stresses are rounded to 2^-117 of the weakest contact, or less. Throws Error,
/// LimitError, Cancelled. Collective.
void average_contacts(const FoundEnds& contacts, const Box* box, const EulerAverageRequest& request,
  Communicator& ranks, const Executor& executor, Progress& progress, EulerAverages& averages);

/// Adds the contact stress to stress and pressure, and keeps what they were without it as the kinetic part.
void add_contact_stress(EulerCells& cells, EulerFields& fields);

struct PointAverageRequest
{
  Kernel kernel{ KernelShape::Gaussian, 1 };
  ParticleArrayNames arrays;
  bool pressure = true; ///< false, without tensors or a temperature: no fluctuations are looked at
  bool tensors = false; ///< fill normal_stress and shear_stress
  EulerFieldSet fields;
};

/// Averages the particles of a frame, and their contacts, at any points by a smoothing kernel: as average_in_cells does, with
/// kernel / volume of the kernel in place of w / V, and the mean of the kernel over the line for contacts. The integral of the
/// density over all space is the mass. Particles and contacts have periodic images, but not in a general box.
///
/// points: x y z of each, absolute, of this rank; the result has an entry for each, in order, and no centres. A point that is
/// not finite gets zeros. Sums are correctly rounded, of terms that are rounded doubles: the same for any order of rows,
/// threads and ranks. Throws Error, LimitError, Cancelled, on all ranks. Collective.
EulerAverages average_at_points(const FrameView& frame, std::span<const double> points,
  const FoundEnds* contacts, const PointAverageRequest& request, Communicator& ranks,
  const Executor& executor, Notices& notices, Progress& progress);
}
#endif
