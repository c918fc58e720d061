// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularInputFrames_h
#define vtkGranularInputFrames_h

#include "granular/common/error.h"
#include "granular/frames/run_index.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/request.h"

#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;

namespace vtkGranularPrivate
{
/**
 * An input of an algorithm, frame by frame. The algorithm requests frames itself, not through its own executive,
 * which would loop for ever if a frame fails, pass the blocks of a composite one by one, and restart the progress with
 * each frame.
 */
class InputFrames
{
public:
  /**
   * The request for each frame.
   */
  struct Part
  {
    int Piece = 0;
    int Pieces = 1;
    int GhostLevels = 0;
  };

  /**
   * input: the input port, which must have a connection.
   */
  InputFrames(vtkAlgorithm* consumer, const Part& part, int input = 0);
  InputFrames(const InputFrames&) = delete;
  void operator=(const InputFrames&) = delete;

  /**
   * Makes the shown time the current one again, in place of the last one requested.
   */
  ~InputFrames();

  std::vector<double> GetTimes() const;

  vtkDataObject* GetData() const;

  /**
   * Returns the time of the data, if known.
   */
  std::optional<double> GetTime() const;

  /**
   * Requests the data of a time, or of the shown one, on all ranks or on none: where one has failed or was stopped before,
   * no other asks the pipeline and waits there. Throws Error that the input could not be made, with the consequence (", and
   * nothing is written") and where; Cancelled. Collective.
   */
  void Update(std::optional<double> time, granular::Communicator& ranks,
    const std::string& consequence = {}, const granular::Where& where = {});

  /**
   * Requests the shown time again if another one was requested: whoever shares the input finds its data as they were.
   * Collective.
   */
  void Restore(granular::Communicator& ranks);

  /**
   * Returns the time that is shown, if any was requested.
   */
  std::optional<double> GetShownTime() const;

private:
  bool UpdateHere(std::optional<double> time);

  vtkAlgorithm* Source = nullptr;
  int Port = 0;
  Part Wanted;
  vtkInformation* Info = nullptr;
  std::optional<double> TimeBefore;
};

/**
 * Checks that all ranks have the times of the first rank; otherwise they would wait for each other. Throws Error.
 */
void CheckTimes(const std::vector<double>& times, granular::Communicator& ranks);

/**
 * The frames of a dump reader, for filters that read columns of many frames themselves. Valid until the reader's next update.
 */
struct ReaderFrames
{
  const granular::RunIndex* Index = nullptr; ///< one frame for each time of the reader
  granular::Request Request;                 ///< what the reader shows

  /**
   * Returns the frames of an algorithm's input, if that is the particles of a dump reader that has looked at its files. What
   * ParaView puts between them, and passes all data on, does not matter.
   */
  static std::optional<ReaderFrames> Find(vtkAlgorithm* consumer);
};
}

#endif
