// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_packing_plan_h
#define granular_packing_packing_plan_h

#include "granular/common/progress.h"
#include "granular/memory/block.h"
#include "granular/packing/lattice.h"
#include "granular/packing/packing.h"
#include "granular/packing/radii.h"
#include "granular/packing/random_numbers.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace granular
{
/// Random sequential adsorption: one particle after the other, the largest first, is placed at a random position where it
/// overlaps no earlier one. The positions depend on box, radii and seed alone, so every rank makes the same ones.
class RandomPacking
{
public:
  /// More particles would take one core too long.
  static constexpr std::int64_t most_particles = 10'000'000;

  /// box must live as long as this. Throws LimitError if some particle finds no position; Cancelled.
  RandomPacking(const BoxShape& box, const Radii& radii, std::uint64_t seed, Progress& progress);

  /// Returns a particle. Rows follow the cells of the largest particles, slowest along the highest axis of the box.
  PlacedParticle particle(std::int64_t row) const noexcept;

  /// Calls visit for every particle that is nearer to another one than a distance, and for some that are not.
  void visit_near(std::int64_t row, double distance, const VisitNear& visit) const;

private:
  static constexpr std::uint32_t none = 0xffffffff;

  struct Particle
  {
    Vector3 at; ///< from the origin of the box
    std::uint32_t size;
    std::uint32_t next; ///< in the same cell, or none
  };

  /// Cells for the particles of one size, about as large as two of them.
  struct Grid
  {
    double radius;
    std::size_t begin;      ///< among the cells of all grids
    CellCounts counts = {}; ///< along each box vector
    CellCounts strides = {};
  };

  struct Try
  {
    Vector3 at;
    std::vector<std::pair<std::uint32_t, PeriodicImage>> near; ///< cells
  };

  bool place_all(RandomNumbers numbers, std::int64_t& tries_left, Progress& progress);
  void place_group(std::uint32_t size, std::size_t end, RandomNumbers& numbers);
  bool fits(const Try& wanted, double radius) const noexcept;
  void add_grid(const SizeClass& size);
  void add(Particle particle);
  std::size_t cell_of(const Grid& grid, const Vector3& at) const noexcept;
  template <class Visit>
  void each_cell(const Vector3& at, double distance, bool of_size, const Visit& visit) const;
  void number_by_cells();
  [[noreturn]] void give_up(std::int64_t most) const;

  const BoxShape& box_;
  double gap_; ///< between particles: rounding of their coordinates may take it
  std::vector<SizeClass> sizes_;
  std::int64_t wanted_; ///< particles
  std::vector<Try> group_;
  std::vector<Grid> grids_;
  std::vector<std::uint32_t> first_; ///< particle of each cell of all grids
  std::vector<Particle> particles_;
};

/// A straight row of particles along the first box vector, in the middle of the box, which begins one radius inside the low
/// face. Where rounding could bring neighbours nearer than the distance, they are farther apart by as much, if the box has
/// room.
class Chain
{
public:
  /// distance: of neighbours. particles: 0 for as many as the box holds. Throws LimitError if they do not fit.
  Chain(const BoxShape& box, double distance, double radius, std::int64_t particles);

  std::int64_t particles() const noexcept { return particles_; }

  /// Returns the position of a particle in the box of the constructor.
  Vector3 point(std::int64_t row, const BoxShape& box) const noexcept;

  /// Returns a distance that no two particles and images are nearer than, in exact arithmetic.
  double nearest() const noexcept { return nearest_; }

  /// Returns the lengths of a box. Across periodic axes images are as far away as particles are from each other.
  static Vector3 lengths_for(
    const std::array<bool, 3>& periodic, double distance, double radius, std::int64_t particles);

private:
  std::int64_t particles_;
  double first_; ///< scaled coordinate along the chain
  double step_;
  double nearest_;
  double exact_first_ = 0; ///< coordinate along the chain, if all coordinates are doubles
  double exact_step_ = 0;  ///< 0: they are not
};

/// The plan of a request: its box, and the number, sizes and positions of particles. It is the same on all ranks whose
/// requests are the same except for pieces and threads.
class PackingPlan
{
public:
  /// Throws LimitError for impossible requests; Cancelled.
  PackingPlan(const PackingRequest& request, Progress& progress);

  PackingPlan(const PackingPlan&) = delete;
  PackingPlan& operator=(const PackingPlan&) = delete;

  PackingRequest request;
  Box box;
  BoxShape shape;
  std::int64_t particles = 0;
  std::int64_t first = 0; ///< row of the piece
  std::int64_t last = 0;  ///< the row after the piece

  PlacedParticle particle(std::int64_t row) const noexcept;

  /// Calls visit for every particle that is nearer to another one than a distance, and for some that are not: rows of a
  /// lattice may be beyond its particles. Not for chains.
  void visit_near(std::int64_t row, double distance, const VisitNear& visit) const;

private:
  Radii radii_;
  double nearest_ =
    HUGE_VAL; ///< no two particles of a lattice or chain are nearer: larger radii are cut to half of it
  std::optional<Lattice> lattice_;
  std::optional<Chain> chain_;
  std::optional<RandomPacking> random_;
};

/// Bonds between particles, in the order of (id1, id2).
struct GrainBonds
{
  std::int64_t count = 0;
  Block id1;   ///< std::int64_t
  Block id2;   ///< std::int64_t, greater than id1
  Block btype; ///< std::int32_t: 1
  Block
    equilibrium_length; ///< double: the distance of the two centres, or of the nearest image: computed
                        ///< from the centres and box vectors, not from the rounded image
  Block points; ///< 2 x 3 doubles a bond: the centre of id1, and id2's image nearest to it, rounded
};

/// Bonds the particles of a plan; not collective. In a chain consecutive particles are bonded, for any factor. In other
/// arrangements all pairs are bonded whose centres are no farther apart than the factor, 1 to 3, times the sum of the radii,
/// within rounding: at 1, the neighbours of a lattice of spacing 1. Periodic images count, and of several images of a pair the
/// nearest, so a pair has at most one bond, and a particle none with itself; among equally near images the one moved by fewer
/// box vectors counts.
///
/// A bond belongs to the piece of its lower id; the piece holds all its bonds, and pieces and threads change nothing else.
///
/// Throws LimitError for other factors; Cancelled; std::bad_alloc.
GrainBonds make_bonds(const PackingPlan& plan, double factor, Progress& progress);
}
#endif
