// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_random_packing_h
#define granular_packing_random_packing_h

#include "granular/common/progress.h"
#include "granular/packing/box_shape.h"
#include "granular/packing/radii.h"
#include "granular/packing/random_numbers.h"

#include <array>
#include <cstddef>
#include <cstdint>
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
}
#endif
