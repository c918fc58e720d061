// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_paths_h
#define granular_paths_paths_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/frame.h"
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
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// The paths of particles through frames: for each particle its places, one in each frame in which it is. On several ranks
/// each has its own particles, and lower ranks have smaller ids.
struct Paths
{
  std::vector<FrameHeader> headers; ///< of all frames
  std::vector<std::int64_t> ids;    ///< of the particles of this rank, ascending
  std::vector<std::int64_t> begins; ///< first place of each particle, and the end: ids + 1
  std::vector<std::int32_t> frames; ///< frame of each place
  std::vector<double> points;       ///< x y z of each place: unwrapped, minus the origin
  std::vector<PathArray> arrays; ///< words of each place; integers only if all frames have integers
  std::vector<double> shown;     ///< on request: x y z of each place as its frame has it
  Vector3 shown_origin = {};     ///< that was subtracted from these
  std::vector<std::int64_t>
    crossings; ///< on request: box vectors that bring each place, as shown, next to the one before

  std::int64_t places() const noexcept { return static_cast<std::int64_t>(frames.size()); }
};

/// Options for joining frames.
struct PathJoin
{
  Vector3 origin = {};    ///< subtracted from the points
  bool crossings = false; ///< fill Paths::shown and Paths::crossings
  /// Called for an id that repeats in a frame; throws if it can name the file and the rows. May be empty.
  std::function<void(std::int64_t id, std::size_t frame)> name_rows = {};
  Vector3 frames_origin = {}; ///< that was subtracted from the points of the frames
};

/// Joins the frames that this rank has loaded: as many on all ranks, of which each has some particles; a frame that is whole
/// on one rank is empty on the others. Frames are used up.
///
/// Paths are continuous: each begins where the frame has the particle, in the box or outside, and goes on by image counts
/// where frames have them, otherwise to the nearest image of the place before. Displacements are those of places with all
/// image counts, also where a box grows. Unwrapped points stay as they are. A point
/// has its box vectors added exactly and is rounded once, minus the origin. A notice counts the steps without image counts
/// that are longer than a quarter of a period, of which some may be wrong.
///
/// Throws Error on all ranks if an id repeats in a frame, with both rows; if no frame with particles has a wanted array, or
/// if frames differ in its size; Cancelled. Collective.
Paths join_frames(std::vector<PathFrame> frames, const PathJoin& join, Communicator& ranks,
  Notices& notices, Progress& progress);

/// Returns the notice that so many steps without image counts are longer than a quarter of a period.
Notice note_long_steps(std::int64_t steps);

/// Points along paths, drawn as polylines without gaps in time.
struct PathLines
{
  static constexpr std::int64_t most_periods = 64; ///< of a step that is drawn where lines are cut

  std::vector<double> points;       ///< x y z
  std::vector<std::int64_t> places; ///< of each point: its place, or the one before it
  std::vector<double> parts; ///< of the way from that place to the next, 0 to 1; empty: all 0
  std::vector<std::int64_t> begins; ///< first point of each line, and the end: lines + 1
  std::vector<std::int64_t> paths;  ///< of each line: the particle
  std::vector<double>
    lengths; ///< of each line: of the whole stretch without gaps that it is a part of
};

/// Makes lines of the paths: one for each stretch without gaps, of one point or more. With crossings in the paths they stay
/// in the box, cut at the periodic faces, minus the origin. A step across more than most_periods is not drawn.
PathLines draw_paths(const Paths& paths, const Vector3& origin);

/// Returns the speed at each place: the length of the steps from the place before and to the place after, divided by the
/// time that they take; 0 for a stretch of one place. times: of all frames.
std::vector<double> find_speeds(const Paths& paths, std::span<const double> times);

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
