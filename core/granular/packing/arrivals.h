// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_arrivals_h
#define granular_packing_arrivals_h

#include "granular/packing/adsorption_grid.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace granular
{
/// The particles of one size class that arrive in a round, which is a span of time. They are a Poisson process in space
/// and time: on each line of cells a random number with this mean, each particle at a random place and time. All are
/// drawn from hashes, so every rank and thread draws the same.
class Arrivals
{
public:
  /// mean: up to 512.
  Arrivals(const AdsorptionGrid& grid, std::size_t size_class, std::uint64_t seed, double mean);

  std::size_t size_class;
  std::size_t level;
  AdsorptionGrid::Cells cells;
  double radius;
  double mean;
  std::uint64_t last =
    std::numeric_limits<std::uint64_t>::max(); ///< moments after this one do not count

  /// Returns the number of particles that arrive on a line of a layer.
  std::uint64_t count(std::int64_t layer, std::int64_t line) const noexcept;

  /// Returns the arrival time of a particle; no two times of a round are equal.
  std::uint64_t moment(std::int64_t layer, std::int64_t line, std::uint64_t arrival) const noexcept;

  /// Returns the place of the particle that arrives at a time, between 0 and 1 in the cells along each axis of the
  /// grid.
  Vector3 place(std::int64_t layer, std::int64_t line, std::uint64_t moment) const noexcept;

private:
  std::uint64_t number(std::int64_t layer, std::int64_t line) const noexcept
  {
    return static_cast<std::uint64_t>(layer * cells[1] + line);
  }

  std::uint64_t counts_seed_;
  std::uint64_t moments_seed_;
  std::vector<double> up_to_; ///< the probability of at most so many on a line
};
}
#endif
