// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_point_sources_h
#define granular_averages_point_sources_h

#include "granular/averages/particle_loader.h"
#include "granular/common/progress.h"
#include "granular/contacts/find_ends.h"
#include "granular/geometry/box.h"
#include "granular/grid/euler_grid.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// A box along the axes; empty if a lo is not below or at its hi.
struct Extent
{
  Vector3 lo = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vector3 hi = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };

  bool empty() const noexcept { return !(lo[0] <= hi[0]); }
  bool meets(const Extent& other) const noexcept;
  void include(const Vector3& point) noexcept;
  Extent grown(double by) const noexcept; ///< rounded outwards
};

/// Returns the extent of the finite ones among points x y z.
Extent extent_of(std::span<const double> points) noexcept;

/// Things by the bins of a part of space that they reach into.
class Bins
{
public:
  /// things: how far each reaches. edge: of a bin, above 0; larger if there would be too many.
  Bins(const Extent& whole, double edge, std::span<const Extent> things);

  /// Returns the things that may reach a point of the whole; none for other points.
  std::span<const std::uint32_t> near(const Vector3& point) const noexcept;

private:
  CellRange range(const Extent& extent) const noexcept;

  Extent whole_;
  Vector3 per_edge_ = {};
  CellRange all_;
  std::vector<std::int64_t> starts_;
  std::vector<std::uint32_t> things_;
};

/// A particle, or an image of it.
struct NearParticle
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
  std::vector<NearParticle> particles;
  std::vector<NearLine> lines;
  std::int64_t broken = 0; ///< particles of all ranks that are left out: see ParticleLoader::load
};

Extent extent_of(const NearParticle& particle) noexcept;
Extent extent_of(const NearLine& line) noexcept;

/// Brings what touches an extent to this rank. contacts may be null. Throws LimitError for too many images; Cancelled. Collective.
PointSources find_point_sources(const FrameView& frame, const ParticleSources& sources,
  const FoundEnds* contacts, const Extent& wanted, Communicator& ranks, Progress& progress);
}
#endif
