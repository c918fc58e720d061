// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_average_h
#define granular_euler_average_h

#include "granular/base/communicator.h"
#include "granular/base/error.h"
#include "granular/base/executor.h"
#include "granular/base/progress.h"
#include "granular/dump/frame_view.h"
#include "granular/euler/cells.h"
#include "granular/euler/euler_grid.h"
#include "granular/euler/grain_cells.h"
#include "granular/euler/grain_values.h"

#include <array>
#include <cstdint>
#include <vector>

namespace granular
{
/// Cells of a grid that a process wants: those of a range whose numbers are in [first, last), in the order of these.
struct WantedCells
{
  CellRange range;
  std::int64_t first = 0;
  std::int64_t last = 0;

  static WantedCells all(const EulerGrid& grid) noexcept;

  std::int64_t count(const EulerGrid& grid) const noexcept;

  /// Which of the wanted ones a cell is, or -1.
  std::int64_t place(const EulerGrid& grid, const std::array<std::int64_t, 3>& cell) const noexcept;
};

struct EulerAverageRequest
{
  EulerGrid grid;
  GrainCells::Options cells;
  GrainArrays arrays;
  WantedCells wanted;     ///< of this process
  bool keep_sums = false; ///< fill mass and momentum
};

/// Averages over the grains of a frame.
struct EulerAverages
{
  EulerCells cells;             ///< the wanted ones
  std::vector<double> mass;     ///< of the grains in each cell, as far as they are in it [kg]
  std::vector<double> momentum; ///< three a cell [kg m/s]
  std::int64_t outside = 0;     ///< grains that are in no cell
  std::int64_t broken = 0;      ///< grains that were left out: see GrainValues::load
};

/// Averages the grains of a frame over the cells of a grid. With the share w of a grain in a cell, its mass m, radius r,
/// velocity v, stress times volume S, and V the volume of the cell:
///   v_avg = sum w m v / sum w m; radius = sum w r / sum w; volume fraction = volume of the grains in the cell / V;
///   stress = sum (-w m (v - v_avg)(v - v_avg) + w S) / V; pressure = -trace(stress) / 3
/// as fix ave/euler of LIGGGHTS has it, where w is 1 or 0: the grains of one moment, no average over time. Without S
/// the stress is that of the fluctuations of velocity alone.
///
/// Cells are lo <= x < hi; the last along an axis has x <= hi. Positions and images: see AbsolutePositions and GrainCells.
/// Sums are those of exact arithmetic, rounded once, of terms that are rounded doubles (of stresses: to 2^-192 of the largest
/// there can be): the results are the same, bit for bit, for any order of rows, threads and ranks.
///
/// The ranks have a part of the grains each; share_header has been called. Throws, on all: Error: rows without
/// points, overlap without radii, arrays of other sizes; LimitError where the memory that is available does not
/// suffice; Cancelled. Collective.
EulerAverages average_in_cells(const FrameView& frame, const EulerAverageRequest& request,
  Communicator& ranks, const Executor& executor, Notices& notices, Progress& progress);

/// The largest radius of the grains of all ranks; 0 without grains. Throws Error, on all, where there are no radii. Collective.
double largest_radius(const FrameView& frame, const GrainArrays& arrays, Communicator& ranks);

/// Averages over frames, which must have the same cells: v_avg = sum of momenta / sum of masses; of all other values
/// the mean, where each frame, also one in which the cell is empty, has the same weight.
class TimeAverage
{
public:
  /// Of averages with sums. Throws Error if the cells are others.
  void add(const EulerAverages& frame);

  std::int64_t frames() const noexcept { return frames_; }
  EulerCells cells() const; ///< 0 cells without frames

private:
  std::int64_t frames_ = 0;
  std::vector<double> centres_;
  std::vector<CompensatedSum> mass_;
  std::vector<CompensatedSum> momentum_;
  std::vector<std::vector<CompensatedSum>> means_; ///< by euler_arrays(); empty: not known
};
}
#endif
