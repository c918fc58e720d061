// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_time_average_h
#define granular_averages_time_average_h

#include "granular/averages/average.h"
#include "granular/geometry/compensated.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace granular
{
/// Averages over frames, which must have the same cells. The particles of all frames are taken as one set, in a volume as
/// large as that of the cell in all frames, empty ones among them. With sums over frames and particles, F the number of
/// frames and V the volume of the cell:
///   v_avg = sum w m v / sum w m; radius = sum w r / sum w; volume fraction = sum of volumes / (F V);
///   stress = sum (-w m (v - v_avg)(v - v_avg) + w S) / (F V); pressure = -trace(stress) / 3
/// v_avg is that of all frames, so that stress and pressure hold what the mean velocity of a cell fluctuates over time, too.
class TimeAverage
{
public:
  /// Adds averages with sums. Throws Error if the cells differ, or if some frames have forces of contacts and others have not.
  void add(const EulerAverages& frame);

  std::int64_t frames() const noexcept { return frames_; }
  EulerCells cells() const; ///< 0 cells without frames

  /// Returns the fields of the frames: densities and contact stresses are means over time, others ratios of sums over particles
  /// or contacts of all frames.
  EulerFields fields() const;

private:
  /// Sums of a cell.
  struct Sums
  {
    CompensatedSum share;
    CompensatedSum radius; ///< sum w r
    CompensatedSum mass;
    std::array<CompensatedSum, 3> momentum;
    std::array<CompensatedSum, 6>
      apart; ///< mass times products of what frames' velocities differ by: see stress_axes
    CompensatedSum volume_fraction;
    CompensatedSum pressure;
    std::array<CompensatedSum, 6> stress;
    double volume = 0; ///< of the cell

    void add_velocities(double mass, const double* momentum);
  };

  using FrameSums = std::vector<CompensatedSum>; ///< over frames, one value after the other

  void add_fields(const EulerAverages& frame);

  std::int64_t frames_ = 0;
  bool stress_ = false;        ///< is known
  std::optional<bool> forces_; ///< contacts have some; frames without contacts do not tell
  std::vector<double> centres_;
  std::vector<Sums> sums_;
  std::array<FrameSums, 4> means_; ///< of the fields that are means over time: see mean_fields
  FrameSums energy_;               ///< sum w m |v - v_avg|^2
  FrameSums ends_;
  FrameSums contacts_;
  FrameSums normals_;
  bool coordination_ = false; ///< is wanted
};
}
#endif
