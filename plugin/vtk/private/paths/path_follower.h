// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPathFollower_h
#define vtkGranularPathFollower_h

#include "vtkGranularPathAlgorithm.h"

#include "private/paths/path_frames.h"
#include "private/request/guard.h"
#include "private/request/piece_request.h"

#include "granular/common/error.h"
#include "granular/parallel/communicator.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/paths.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkDataObject;
class vtkInformationVector;

/**
 * What the requests of all filters that follow particles do: the choice of particles, frames and arrays. Collective.
 */
class vtkGranularPathAlgorithm::Follower
{
public:
  Follower(
    vtkGranularPathAlgorithm* self, vtkInformationVector** inputs, vtkInformationVector* outputs);

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

  /**
   * Warns of the notices, each once until something changes.
   */
  void Tell();

  vtkGranularPathAlgorithm* Self;
  vtkDataObject* Input;
  vtkGranularPrivate::PieceRequest Wanted;
  granular::Communicator& Ranks;
  vtkGranularPrivate::AlgorithmProgress Own;
  granular::SharedProgress Shared;
  granular::PartialProgress Progress;
  bool Together;
  int Threads;
  vtkGranularPrivate::PathFrames Frames;
  granular::PathRequest Request;
  std::vector<std::size_t> Numbers; ///< of the chosen frames
  granular::Vector3 Origin = {};    ///< of the points of the input
  granular::Notices Notices;

private:
  void ReadInput();
  void ChooseFrames();
  void ChooseParticles();
};

#endif
