// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularInputFrames_h
#define vtkGranularInputFrames_h

#include "granular/parallel/communicator.h"

#include <optional>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;

namespace vtkGranularPrivate
{
/**
 * The first input of an algorithm, frame by frame. The algorithm asks for it itself, not by its own executive: that one
 * would go on for ever where a frame cannot be made, hand over the blocks of a composite one by one, and begin to count
 * progress with each frame.
 */
class InputFrames
{
public:
  /**
   * What is asked for of each frame.
   */
  struct Part
  {
    int Piece = 0;
    int Pieces = 1;
    int GhostLevels = 0;
  };

  InputFrames(vtkAlgorithm* consumer, const Part& part);
  InputFrames(const InputFrames&) = delete;
  void operator=(const InputFrames&) = delete;

  /**
   * Who asks next means the time that was shown, not the last that was made.
   */
  ~InputFrames();

  std::vector<double> GetTimes() const;

  vtkDataObject* GetData() const;

  /**
   * The time of the data, as far as they know it.
   */
  std::optional<double> GetTime() const;

  /**
   * Makes the data of a time, or of the one that is shown. False if that fails, on this process.
   */
  bool Update(double time);
  bool Update();

  /**
   * Whether there are data, if Update() said so. Throws Cancelled.
   */
  bool Check(bool made) const;

private:
  std::optional<double> GetShownTime() const;

  vtkAlgorithm* Source = nullptr;
  int Port = 0;
  Part Wanted;
  vtkInformation* Info = nullptr;
  std::optional<double> TimeBefore;
};

/**
 * Makes sure that all processes have the times of the first one: else they would wait for each other. Throws Error.
 * Collective.
 */
void CheckTimes(const std::vector<double>& times, granular::Communicator& ranks);
}

#endif
