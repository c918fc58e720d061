// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_contact_rows_h
#define granular_contacts_contact_rows_h

#include "granular/geometry/box.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace granular
{
/// The contacts of this rank, one a row, in memory of others. An empty span: not known.
struct ContactRows
{
  std::size_t count = 0;
  std::span<const std::int64_t> id1; ///< particle at the first end; empty: a wall
  std::span<const std::int64_t> id2; ///< particle at the second end
  std::span<const double>
    ends; ///< x y z of the first and the second end: centres of particles, or the point of a wall that is touched. Particles
          ///< that are known, and whose box is, are where they are themselves
  std::span<const double> force;         ///< three on the first particle, of walls on the particle
  std::span<const double> tangential;    ///< three: the part of the force across the branch vector
  std::span<const double> torque;        ///< three on the same particle
  std::span<const double> contact_point; ///< x y z, of any image
  std::span<const double> overlap;       ///< one a row
  std::optional<Box> box = {};           ///< counts where the particles have none
};

/// Facts that all ranks share about the contacts of one input.
struct ContactKinds
{
  bool walls = false;
  bool ends = false;
  bool force = false;
  bool tangential = false;
  bool torque = false;
  bool contact_point = false;
  bool overlap = false;
};
}
#endif
