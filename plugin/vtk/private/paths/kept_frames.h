// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularKeptFrames_h
#define vtkGranularKeptFrames_h

#include "private/dump/input_frames.h"

#include "granular/parallel/communicator.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <map>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * The data of all connected inputs of an algorithm at one time. Shallow copies: an input may go on to other times.
 */
using FrameData = std::vector<vtkSmartPointer<vtkDataObject>>;

/**
 * Frames of the inputs of an algorithm, kept between updates, so that a frame that many updates need is read once. Frames
 * are forgotten when an input has changed.
 */
class KeptFrames
{
public:
  /**
   * Begins an update with the frame that is shown. Throws Error if the ranks have different times. Collective.
   */
  void Begin(vtkAlgorithm* consumer, const InputFrames::Part& part, granular::Communicator& ranks);

  /**
   * Returns the shown frame.
   */
  const FrameData& GetShown() const { return this->Shown; }

  /**
   * Returns the times of the first input, and the number of the shown one; 0 without times.
   */
  const std::vector<double>& GetTimes() const { return this->Times; }
  std::size_t GetShownNumber() const { return this->ShownNumber; }

  /**
   * Returns the frame with this number: the shown one, a kept one, or one that is requested from the inputs, which then
   * return to the shown time. Throws Error if an input cannot make it; Cancelled. Collective.
   */
  FrameData Get(vtkAlgorithm* consumer, std::size_t number, granular::Communicator& ranks);

  /**
   * Returns the number of the first frame whose first input has points; that of the shown one, if none has before. Collective.
   */
  std::size_t FindFirst(vtkAlgorithm* consumer, granular::Communicator& ranks);

  /**
   * Ends an update: keeps the frame that was returned last, and on request the shown frame, too.
   */
  void End(bool keepShown);

private:
  FrameData Read(vtkAlgorithm* consumer, double time, granular::Communicator& ranks) const;

  InputFrames::Part Part;
  std::vector<vtkMTimeType> Changed; ///< of the pipelines of the inputs
  std::vector<double> Times;
  std::size_t ShownNumber = 0;
  std::size_t Last = 0;  ///< number of the frame that Get returned last
  std::size_t Empty = 0; ///< so many frames at the beginning have no points, or more
  FrameData Shown;
  std::map<double, FrameData> Kept; ///< by their times
};
}

#endif
