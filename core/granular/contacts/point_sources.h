// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_point_sources_h
#define granular_contacts_point_sources_h

#include "granular/common/progress.h"
#include "granular/contacts/find_ends.h"
#include "granular/contacts/near_points.h"
#include "granular/euler/grain_values.h"
#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// A grain, or an image of it.
struct NearGrain
{
  Vector3 place;
  Vector3 velocity;
  double mass;
  double radius;
  double volume;
};

/// A contact, or an image of it.
struct NearLine
{
  Vector3 start;
  Vector3 branch;
  Vector3 force; ///< on the first end; of a wall reversed
  Vector3 normal;
  double ends;   ///< that count
  double counts; ///< 1 or 0
};

/// Particles that reach the points of this rank, of all ranks and with periodic images.
struct PointSources
{
  std::vector<NearGrain> grains;
  std::vector<NearLine> lines;
  std::int64_t broken = 0; ///< grains of all ranks that are left out: see GrainValues::load
};

Extent extent_of(const NearGrain& grain) noexcept;
Extent extent_of(const NearLine& line) noexcept;

/// Brings what touches an extent to this rank. contacts may be null. Throws LimitError for too many images; Cancelled. Collective.
PointSources find_point_sources(const FrameView& frame, const GrainSources& sources,
  const FoundEnds* contacts, const Extent& wanted, Communicator& ranks, Progress& progress);
}
#endif
