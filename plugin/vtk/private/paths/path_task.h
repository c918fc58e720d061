// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPathTask_h
#define vtkGranularPathTask_h

#include "vtkGranularPathAlgorithm.h"

#include "private/dump/input_frames.h"
#include "private/request/request_task.h"

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/parallel/communicator.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/path_task.h"

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
class PathFrames : public granular::FrameLoader
{
public:
  /**
   * group: those of the ranks that load all frames together, each a part of the particles: all, or this one alone.
   * Throws Error if the ranks have different times. Collective.
   */
  PathFrames(vtkAlgorithm* consumer, granular::Communicator& group, granular::Communicator& ranks,
    int threads);

  const std::vector<double>& times() const override { return this->Times; }

  /**
   * Loads several frames at a time if they are in files: each is whole on one rank, and empty on others. From a pipeline
   * each rank has its piece.
   */
  std::vector<granular::PathFrame> load(const std::vector<std::size_t>& numbers,
    const granular::PathRequest& request, granular::Notices& notices,
    granular::PartialProgress& progress) override;

  granular::PathFrame load_part(std::size_t number, const granular::PathRequest& request,
    granular::Notices& notices, granular::PartialProgress& progress,
    granular::PathFrame spent) override;

  void name_rows(std::int64_t id, std::size_t number) const override;

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
 * The common part of the tasks of all filters that follow particles.
 */
class vtkGranularPathAlgorithm::PathTask
  : public vtkGranularPrivate::FilterTask<vtkGranularPathAlgorithm>
{
public:
  using FilterTask::FilterTask;

protected:
  /**
   * Chooses the particles, frames and arrays. Collective.
   */
  granular::PathTask Choose();

  vtkGranularPrivate::PathFrames Frames{ this->Self, this->Group, this->Ranks, this->Threads };
};

#endif
