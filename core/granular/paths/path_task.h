// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_path_task_h
#define granular_paths_path_task_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"
#include "granular/particles/request.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/paths.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// The particles of an input, frame by frame.
class FrameLoader
{
public:
  virtual ~FrameLoader() = default;

  /// Returns the times of all frames; none if the input has no times, and then one frame.
  virtual const std::vector<double>& times() const = 0;

  std::size_t size() const { return this->times().empty() ? 1 : this->times().size(); }

  /// Loads frames, of which each rank has some particles. Throws the core's errors; Cancelled. Collective.
  virtual std::vector<PathFrame> load(const std::vector<std::size_t>& numbers,
    const PathRequest& request, Notices& notices, PartialProgress& progress) = 0;

  /// Loads this rank's part of one frame, with all threads. spent: a frame that is no longer needed, whose memory is used
  /// again. Collective.
  virtual PathFrame load_part(std::size_t number, const PathRequest& request, Notices& notices,
    PartialProgress& progress, PathFrame spent) = 0;

  /// Throws Error that names the first two rows with an id in a frame, if it can name the file. Not collective.
  virtual void name_rows(std::int64_t /*id*/, std::size_t /*number*/) const {}
};

/// The wanted particles and frames: see vtkGranularPathAlgorithm.
struct PathChoice
{
  std::string ids;
  std::int64_t every_nth = 1;
  std::int64_t samples = 0; ///< 0: all; -1: a few
  std::int64_t seed = 0;
  std::array<double, 6> region = { 1, -1, 1, -1, 1, -1 }; ///< in the selection frame
  std::int64_t selection_frame = -1;                      ///< negative numbers count from the end
  std::array<double, 2> window = { 1, -1 };
  std::int64_t stride = 1;
  std::string arrays; ///< names: see share_names
};

/// The common part of all that follows particles: the choice of particles, frames and arrays.
class PathTask
{
public:
  /// group: the ranks that load all frames together. shown: the frame that tells the origin of the points, and the names that "*"
  /// stands for; its header is shared. Throws Error if a frame does not exist. Collective.
  PathTask(FrameLoader& frames, PathChoice choice, const FrameView& shown, Communicator& group,
    Communicator& ranks, Notices& notices, PartialProgress& progress);

  /// Leaves so many of the particles if a few are wanted: of the selection frame, or of the middle one if that is empty. Collective.
  void choose_few(std::size_t few);

  /// Leaves the last frame at or before a time, and so many before it.
  void keep_tail(double time, std::int64_t tail);

  /// Loads the frames. Collective.
  std::vector<PathFrame> load() { return frames.load(numbers, request, notices, progress); }

  /// Joins frames to paths of this rank. Uses them up. Collective.
  Paths join(std::vector<PathFrame> loaded, bool crossings);

  /// Tells which ids that were named by themselves are not among the ids of the ranks. Collective.
  void note_absent(const std::vector<std::int64_t>& ids);

  /// Returns the times of the chosen frames: those of the input, or 0 if it has none.
  std::vector<double> times() const;

  FrameLoader& frames;
  Communicator& group;
  Notices& notices;
  PartialProgress& progress;
  PathRequest request;
  std::vector<std::size_t> numbers; ///< of the chosen frames
  Vector3 origin = {};              ///< of the points of the input

private:
  void choose_frames();
  std::size_t choose_particles(bool has_region, std::size_t samples, std::int64_t wanted);

  PathChoice choice_;
};
}
#endif
