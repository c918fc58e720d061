// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_square_displacements_h
#define granular_paths_square_displacements_h

#include "granular/common/error.h"
#include "granular/geometry/box.h"
#include "granular/geometry/reproducible_sum.h"
#include "granular/lines/id_finder.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/unwrap.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace granular
{
/// The mean square displacement of particles from the first frame that has any to each later one, in memory for two frames.
class SquareDisplacements
{
public:
  /// Means over the particles of all ranks that are in both frames; nan if there are none, or a square is not finite.
  struct Means
  {
    std::int64_t count = 0;
    Vector3 axes = {}; ///< of the squares of x, y, z
    double total = 0;  ///< of the squares of the length
  };

  /// origin: that was subtracted from the points of the frames.
  SquareDisplacements(Communicator& ranks, const Executor& executor, const Vector3& origin = {})
    : ranks_(ranks)
    , executor_(executor)
    , origin_(origin)
  {
  }

  /// Adds the next frame, of which each rank has some particles, and which is used up. Displacements are those of unwrapped places, as join_frames
  /// has them, each rounded once; squares are rounded once and summed exactly. name_rows: see PathJoin. Throws Error on all
  /// ranks if an id repeats; Cancelled. Collective.
  Means add(
    PathFrame& frame, const std::function<void(std::int64_t id)>& name_rows, Progress& progress);

  /// Returns the number of frames before the first one that has particles.
  std::size_t empty_frames() const noexcept { return empty_frames_; }

  /// Returns the number of steps that are longer than a quarter of a period, without image counts, on all ranks. Collective.
  std::int64_t count_long_steps() const;

private:
  using NameRows = std::function<void(std::int64_t id)>;
  static constexpr std::size_t sums = 4; ///< of the squares of x, y, z and of the length

  /// A particle of the first frame.
  struct Particle
  {
    PathState state;
    Vector3 start = {}; ///< its place in the first frame
  };

  /// Values of some particles.
  struct Chunk
  {
    std::vector<double> points; ///< x y z: later the displacements
    std::vector<double> counts;
    std::int64_t long_steps = 0;
    std::array<std::int64_t, sums>
      odd = {}; ///< of each sum, terms that are not finite: they are left out of it
  };

  void find_places(const PathFrame& frame, const NameRows& name_rows, Progress& progress);
  Chunk find_squares(const PathFrame& frame, Progress& progress);
  void move_chunk(const PathFrame& frame, std::size_t begin, std::size_t count, Chunk& chunk);

  Communicator& ranks_;
  const Executor& executor_;
  Vector3 origin_;
  std::vector<std::int64_t> first_ids_; ///< of ranks: see share_out
  IdFinder finder_;                     ///< of the particles of the first frame
  std::vector<Particle> particles_;
  Unwrapper unwrapper_;
  // of a frame; their memory is used for the next one
  std::vector<std::int64_t> places_; ///< of each row: its particle
  std::vector<std::int64_t> rows_;   ///< of each particle: its row, or -1
  std::vector<SumScale::Terms> terms_;
  std::int64_t long_steps_ = 0;
  std::size_t empty_frames_ = 0;
};
}
#endif
