// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_random_grains_h
#define granular_packing_random_grains_h

#include "granular/common/progress.h"
#include "granular/packing/adsorption.h"
#include "granular/packing/adsorption_grid.h"
#include "granular/packing/grain_rows.h"
#include "granular/packing/radii.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace granular
{
/// Particles at random positions: exactly random sequential adsorption, the largest first. Particles of a size arrive until
/// their number is reached; only that moment depends on the whole box. Any rows are then found from the arrivals near them.
class RandomGrains
{
public:
  /// Lets the particles of all classes arrive. Collective: each rank finds those of its shelves, and the ranks count. box and
  /// radii must live as long as this. Throws LimitError if some find no position; Cancelled.
  RandomGrains(const BoxShape& box, const Radii& radii, std::uint64_t seed, Communicator& ranks,
    int threads, Progress& progress);

  /// Finds some of the particles. Not collective. Throws Cancelled.
  void place(const GrainRows& rows, int threads, Progress& progress) const;

  /// Returns ranges of later rows that contain every particle within a distance of a particle in `rows`.
  std::vector<RowRange> rows_near(const RowRange& rows, double distance) const;

private:
  using Shelves = RowRange;

  static constexpr double least_margin = 8; ///< largest diameters: at 0.3 it is rarely more

  /// What finds the grains of some shelves.
  struct Part
  {
    Shelves shelves;
    double margin = least_margin;
    std::unique_ptr<Adsorption> found;
  };

  void follow(Part& part, const Executor& executor, Progress& progress) const;
  bool adsorb_all(Communicator& ranks, double& tries, const Executor& executor, Progress& progress);
  bool adsorb(std::size_t size_class, Communicator& ranks, double& tries, const Executor& executor,
    PartialProgress& progress);
  double arrivals_on_a_line(
    std::size_t size_class, std::int64_t missing, double staying) const noexcept;
  void count(Communicator& ranks);
  [[noreturn]] void give_up() const;
  std::int64_t shelf_of(std::int64_t row) const noexcept;
  void place(const Adsorption& found, std::int64_t shelf, const GrainRows& rows) const;

  const Radii& radii_;
  AdsorptionGrid grid_;
  std::uint64_t seed_;
  std::int64_t rounds_begun_ = 0;
  std::vector<Arrivals> rounds_;
  std::int64_t most_ = 0;            ///< grains of the attempt that had most
  std::vector<std::int64_t> rows_;   ///< before each shelf
  std::vector<std::int64_t> counts_; ///< of each class before each shelf
  Part own_;
};
}
#endif
