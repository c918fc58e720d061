// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPathTask_h
#define vtkGranularPathTask_h

#include "vtkGranularPathAlgorithm.h"

#include "private/dump/input_frames.h"
#include "private/request/request_task.h"

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/paths.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

class vtkAlgorithm;

namespace vtkGranularPrivate
{
/**
 * The particles of an algorithm's input, frame by frame: read from the files of a dump reader, only the columns that are
 * wanted, or else requested from the pipeline.
 */
class PathFrames
{
public:
  /**
   * group: those of the ranks that load all frames together, each a part of the particles: all, or this one alone.
   * Throws Error if the ranks have different times. Collective.
   */
  PathFrames(vtkAlgorithm* consumer, granular::Communicator& group, granular::Communicator& ranks,
    int threads);

  /**
   * Returns the times of all frames; none if the input has no times, and then one frame.
   */
  const std::vector<double>& GetTimes() const { return this->Times; }

  std::size_t GetSize() const { return this->Times.empty() ? 1 : this->Times.size(); }

  /**
   * Loads frames, several at a time if they are in files: each is whole on one rank, and empty on others. From a pipeline
   * each rank has its piece. Throws the core's errors; Cancelled.
   * Collective.
   */
  std::vector<granular::PathFrame> Load(const std::vector<std::size_t>& numbers,
    const granular::PathRequest& request, granular::Notices& notices,
    granular::PartialProgress& progress);

  /**
   * Loads this rank's part of one frame, with all threads. spent: a frame that is no longer needed, whose memory is used
   * again. Collective.
   */
  granular::PathFrame LoadPart(std::size_t number, const granular::PathRequest& request,
    granular::Notices& notices, granular::PartialProgress& progress,
    granular::PathFrame spent = {});

  /**
   * Throws Error that names the first two rows with an id in a frame that was read from files. Not collective.
   */
  void NameRows(std::int64_t id, std::size_t number) const;

private:
  granular::PathFrame Request(
    std::size_t number, const granular::PathRequest& request, granular::Progress& progress);

  granular::Communicator& Group;
  granular::Communicator& Ranks;
  int Threads;
  std::optional<InputFrames> Input;
  std::optional<ReaderFrames> Reader;
  std::vector<double> Times;
};
}

/**
 * The common part of the tasks of all filters that follow particles: the choice of particles, frames and arrays.
 */
class vtkGranularPathAlgorithm::PathTask
  : public vtkGranularPrivate::FilterTask<vtkGranularPathAlgorithm>
{
public:
  using FilterTask::FilterTask;

protected:
  /**
   * Chooses the particles, and the frames among those of the TimeWindow. Throws Error if a frame does not exist.
   */
  void Choose();

  /**
   * Leaves so many of the particles if the filter is asked for a few: of the SelectionFrame, or of the middle one if that is empty.
   */
  void ChooseFew(std::size_t few);

  /**
   * Joins frames to paths of this rank. Uses them up.
   */
  granular::Paths Join(std::vector<granular::PathFrame> frames, bool crossings);

  /**
   * Tells which ids that were named by themselves are not among the ids of the ranks. Collective.
   */
  void NoteAbsent(const std::vector<std::int64_t>& ids);

  /**
   * Returns the times of the chosen frames: those of the input, or 0 if it has none.
   */
  std::vector<double> GetTimes();

  vtkGranularPrivate::PathFrames Frames{ this->Self, this->Group, this->Ranks, this->Threads };
  granular::PathRequest Request;
  std::vector<std::size_t> Numbers; ///< of the chosen frames
  granular::Vector3 Origin = {};    ///< of the points of the input

private:
  void ReadInput();
  void ChooseFrames();
  std::size_t ChooseParticles(bool hasRegion, std::size_t samples, std::int64_t frame);
};

#endif
