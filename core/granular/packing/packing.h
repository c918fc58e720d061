// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_packing_h
#define granular_packing_packing_h

#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/packing/radii.h"
#include "granular/particles/table.h"

#include <cstdint>
#include <optional>
#include <string>

namespace granular
{
enum class Arrangement : std::uint8_t
{
  Random,
  SimpleCubic,
  FaceCentredCubic,
  Chain ///< one straight row of particles along the first box vector, in the middle of the box
};

/// The wanted particles. At least one of particles and box must be given.
struct PackingRequest
{
  Arrangement arrangement = Arrangement::Random;
  std::int64_t particles = 0;        ///< 0: as many as the box holds
  std::optional<Box> box;            ///< none: a box is made for the particles
  Vector3 corner = {};               ///< of a box that is made
  std::string boundary = "ff ff ff"; ///< of the box: see checked_boundary
  RadiusChoice radii;
  double solid_fraction =
    0.2; ///< random particles, where particles or box are not given: volume of
         ///< particles by that of the box
  double spacing =
    1; ///< all but random: distance of nearest neighbours by the largest diameter, >= 1
  double speed = 0; ///< standard deviation of each component of the velocities, >= 0
  std::uint64_t seed = 1;
  int piece = 0; ///< part of the particles, of `pieces` in all: see make_packing
  int pieces = 1;
  int threads = 1;     ///< at least 1; changes no result
  bool ranges = false; ///< true: find the ranges of points and arrays
};

/// Particles that are made where neither their number nor a box is given.
inline constexpr std::int64_t particles_without_box = 1000;

/// Returns an arrangement or choice of radii by its number in properties. Throws LimitError for others, as in states of earlier versions.
Arrangement arrangement_of(std::int64_t number);
RadiusChoice::Kind radii_of(std::int64_t number);

/// Returns the box of properties: its corner, lengths and tilts xy xz yz; nothing for lengths of 0. Throws LimitError for tilts without
/// lengths, and lengths that are not all greater than 0.
std::optional<Box> find_box(const Vector3& origin, const Vector3& lengths, const Vector3& tilts);

class PackingPlan;

/// Makes particles that do not overlap, as a frame of timestep 0 with the columns id type x y z radius vx vy vz; a chain also
/// has mol, which is 1. Each particle is a function of the request and of its number. The parts hold each particle once, in
/// the order of their ids, which count from 1, and are of equal size; threads and pieces change nothing else. Random particles
/// are those of random sequential adsorption: one after the other is placed at a random position, the largest first, and
/// stays if it overlaps no earlier one. They are numbered by cells of a grid, along the highest axis of the box at last.
///
/// Particles are entirely inside the box; along periodic axes only centres are, and images do not overlap particles either.
/// Random particles do not touch; neighbours of a lattice of spacing 1 touch within the rounding of coordinates. In a box that
/// holds a lattice or a chain only just, radii are less than asked for by that rounding. A chain begins one radius inside the
/// face; a chain longer than the box is an error.
///
/// Throws LimitError for impossible requests: values out of bounds, a box without room, random particles without a position or
/// more than 10^7 of them;
/// Cancelled; std::bad_alloc.
Table make_packing(const PackingRequest& request, Progress& progress);

/// Makes particles, and, if the factor is not 0, bonds as lines: see make_bonds. Throws what both throw; MemoryError that says what helps.
Tables make_packing(const PackingRequest& request, double bond_factor, PartialProgress& progress);

/// Makes the piece of a plan. Every rank has the whole plan.
Table make_packing(const PackingPlan& plan, Progress& progress);
}
#endif
