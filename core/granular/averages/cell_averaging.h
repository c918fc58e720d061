// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_cell_averaging_h
#define granular_averages_cell_averaging_h

#include "granular/averages/average.h"
#include "granular/averages/chosen_averages.h"
#include "granular/averages/time_average.h"
#include "granular/grid/euler_grid.h"

#include <array>
#include <functional>
#include <optional>
#include <utility>

namespace granular
{
/// Cells and weights as users choose them.
struct ChosenCells
{
  EulerGridRequest grid = {};        ///< but for lo, hi and cutoff
  double relative_size = 3;          ///< of Cutoff: in largest diameters
  std::array<double, 6> bounds = {}; ///< see find_bounds
  std::optional<int> profile;        ///< axis along which there are cells; the others have one
  KernelBounds kernel_bounds = KernelBounds::None;
  bool images = true; ///< particles have periodic ones
  bool time_average = false;

  /// Returns true if the number of cells follows from a frame: its box, or its particles.
  bool need_frame() const;

  /// Returns the grid; without particles, where none are needed, bounds that are not given are 0 to 1. Throws Error for a relative_size that
  /// is not above 0, and what find_bounds and make_euler_grid throw. Collective.
  EulerGrid make_grid(
    const FrameView* particles, const ParticleArrayNames& names, Communicator& ranks) const;
};

/// Averages in cells, over one or more frames.
class CellAveraging : private Averaging
{
public:
  using Want = std::function<WantedCells(const EulerGrid&)>;

  CellAveraging(
    ChosenAverages chosen, const ChosenCells& cells, Communicator& ranks, Notices& notices)
    : Averaging(std::move(chosen), ranks, notices)
    , cells_(cells)
  {
  }

  /// Adds a frame; several only for an average over time. want: returns the wanted cells of this rank. Throws Error for a stress array
  /// beside contacts, and what average_in_cells, average_contacts, ContactInput, find_bounds and make_euler_grid throw. all: the ranks of
  /// all pieces. Collective.
  void add(
    const AverageInput& input, const Want& want, Communicator& all, PartialProgress& progress);

  const EulerGrid& grid() const noexcept { return grid_; } ///< of the last frame

  EulerFrame finish();

private:
  const ChosenCells cells_;
  EulerGrid grid_;
  EulerAverages last_;
  TimeAverage sums_;
};
}
#endif
