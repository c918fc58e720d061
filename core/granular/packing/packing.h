// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_packing_h
#define granular_packing_packing_h

#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/packing/radii.h"
#include "granular/particles/dump_frame.h"

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
  Hexagonal,
  Chain,      ///< one straight row of grains along the first box vector, in the middle of the box
  FibreBundle ///< parallel chains, in closest packing
};

/// Which grains are wanted. At least one of grains and box must be given.
struct PackingRequest
{
  Arrangement arrangement = Arrangement::Random;
  std::int64_t grains = 0;           ///< 0: as many as the box holds
  std::optional<Box> box;            ///< none: one is made for the grains
  Vector3 corner = {};               ///< of a box that is made
  std::string boundary = "ff ff ff"; ///< of the box: see checked_boundary
  RadiusChoice radii;
  double solid_fraction = 0.2; ///< random grains, where grains or box are not given: volume of
                               ///< grains by that of the box
  double spacing =
    1; ///< all but random: distance of nearest neighbours by the largest diameter, >= 1
  std::int64_t grains_per_fibre = 20; ///< of a bundle, >= 1; its last fibre may have fewer
  double speed = 0; ///< standard deviation of each component of the velocities, >= 0
  std::uint64_t seed = 1;
  int piece = 0; ///< the part of the grains that is wanted, of `pieces` in all: see make_packing
  int pieces = 1;
  int threads = 1;     ///< >= 1; changes no result
  bool ranges = false; ///< whether to find the ranges of points and arrays
};

class PackingPlan;

/// Makes grains that do not overlap one another: as a frame of timestep 0 with the columns id type x y z
/// radius vx vy vz, and mol, the number of its fibre from 1 on, of chains and bundles. Each is a function of the request and of its number: the parts hold each grain once,
/// in the order of their ids, which count from 1, and are equal in number; threads and pieces
/// change nothing else. Random grains are those of random sequential adsorption: one after the other comes to a random place,
/// the largest first, and stays if it overlaps none before; those of a range of radii in classes a twentieth wide, each
/// with the room of the largest of its class. They are numbered along the highest axis of the box.
///
/// Grains are wholly inside the box, but for periodic axes: there centres are, and images do not overlap
/// grains either. Random grains do not touch; coordinates are rounded, and neighbours of a lattice of
/// spacing 1 touch as far as that allows. A fibre begins a radius inside the face, is never stretched, and
/// an error if it is longer than the box.
///
/// Throws LimitError for what cannot be: values out of bounds, a box without room, random grains that find
/// no place; Cancelled; std::bad_alloc.
DumpFrame make_packing(const PackingRequest& request, Progress& progress);

/// The same, where several ranks share the work: each makes its own part, and of random grains those around it. The plan is
/// collective, this is not.
DumpFrame make_packing(const PackingPlan& plan, Progress& progress);
}
#endif
