// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_contact_sums_h
#define granular_contacts_contact_sums_h

#include "granular/common/progress.h"
#include "granular/contacts/contact_ends.h"
#include "granular/contacts/contact_rows.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// A symmetric tensor: xx yy zz xy xz yz, as compute stress/atom orders them.
using SymmetricTensor = std::array<double, 6>;

/// Returns the principal values, the largest first, to some ulps of the one that is largest in magnitude; nan if the tensor
/// is not finite.
Vector3 principal_values(SymmetricTensor tensor) noexcept;

/// Returns the equivalent stress of R. von Mises: sqrt(3/2 s:s) with the deviator s.
double von_mises(SymmetricTensor tensor) noexcept;

struct ContactSumsRequest
{
  bool force = true;
  bool torque = true;
  bool fabric = true;
  bool stress = true;
  bool principal_stress = false;
  bool von_mises = false;
  bool friction = false;
  int least_contacts = 0; ///< particles with fewer are rattlers; 0: nobody asks for them
  ContactOptions options = {};
  std::string radius = "radius"; ///< array of radii, or of diameters under that name
  int threads = 1;               ///< at least 1; changes no result
  /// [B] of sums while they grow; with less, contacts are looked through more often; changes no result
  std::size_t memory = std::size_t{ 1 } << 30;
  std::shared_ptr<BlockPool> pool; ///< source of the memory; may be null
};

/// Sums of the contacts of each particle of this rank, in their order, and 0 where it has none. What nobody asked for, or what
/// contacts without forces do not tell, is empty.
struct ContactSums
{
  Block coordination; ///< std::int32_t: contacts that count
  Block force;        ///< three doubles: sum of the forces on the particle [N]
  Block torque;       ///< three: sum of the torques on it [N m]
  Block
    fabric; ///< six, xx yy zz xy xz yz: mean over the contacts that count of the products of the normal [-]
  Block stress;           ///< six: sum of arm_a force_b, negative in compression [N m]
  Block principal_stress; ///< three: principal values of stress over volume, the largest first [Pa]
  Block von_mises;        ///< a double: equivalent stress of these [Pa]
  std::vector<Block>
    friction; ///< of each input, a double a row: see ContactEnds::friction; nan where the row is left out
  Block rattlers; ///< unsigned char: 1 for a rattler
  Block backbone; ///< std::int32_t: coordination among those that are no rattlers, 0 for rattlers
  std::int64_t particles = 0; ///< of all ranks, without duplicates
  std::int64_t contacts = 0;  ///< that count at particles, over all of these
  std::int64_t rattling = 0;  ///< particles
  std::int64_t bearing = 0;   ///< contacts as above, without rattlers
  std::int64_t missing =
    0; ///< rows of all ranks with a particle that is not there; the other one gets its part
  std::int64_t unplaced =
    0; ///< of these, rows without ends: the other one gets the force alone, and counts the contact
  std::int64_t broken =
    0; ///< rows of all ranks that are left out: a number of theirs, or of their particles, is not usable
  std::int64_t repeated = 0; ///< particles with the id of an earlier one, which is taken
};

/// Sums the contacts of each particle. Particles have an integer array `id`, and may be on other ranks than their contacts;
/// duplicates (ghosts) get no sums. Each input of contacts has the same arrays on all ranks.
///
/// The torque about the centre is the given one; the other particle of a pair gets what makes the moment of both that of the
/// two forces: branch x force - torque. Without given torques it is arm x force. Stress: see compute stress/atom of LAMMPS,
/// which takes half the branch vector as the arm; divided by the volume it is the stress of the particle, and the sum over all
/// particles is that of branch_a force_b over all contacts, for any arms.
///
/// Terms are rounded doubles; sums are correctly rounded, so that order, threads and ranks cannot matter. Throws Error, on all
/// ranks: particles without ids, or without radii where a stress is divided by the volume,
/// arrays that differ between ranks, contacts with walls without places, a least force or overlap that nothing
/// tells; Cancelled; std::bad_alloc. Collective.
ContactSums sum_contacts(const FrameView& particles, std::span<const ContactRows> inputs,
  const ContactSumsRequest& request, Communicator& ranks, Progress& progress);
}
#endif
