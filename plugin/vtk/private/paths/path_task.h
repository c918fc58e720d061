// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPathTask_h
#define vtkGranularPathTask_h

#include "vtkGranularPathAlgorithm.h"

#include "private/paths/path_frames.h"
#include "private/request/request_task.h"

#include "granular/geometry/box.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/paths.h"

#include <cstddef>
#include <vector>

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
   * Joins frames to paths of this rank. Uses them up.
   */
  granular::Paths Join(std::vector<granular::PathFrame> frames, bool crossings);

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
  void ChooseParticles();
};

#endif
