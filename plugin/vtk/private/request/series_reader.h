// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularSeriesReaderInternals_h
#define vtkGranularSeriesReaderInternals_h

#include "vtkGranularSeriesReader.h"

#include "private/request/guard.h"
#include "private/request/processes.h"

#include "granular/frames/run_index.h"
#include "granular/memory/block_pool.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

class vtkInformation;
class vtkInformationVector;

/**
 * The files of a series reader, the index of their frames, and the notices that the user has received.
 */
struct vtkGranularSeriesReader::Internals
{
  using Self = vtkGranularSeriesReader;

  std::vector<std::string> FileNames;
  const granular::FileFormat* Format = nullptr; // set by the constructors of readers
  std::vector<std::string> ColumnNames;         ///< for files that do not name their columns
  granular::RunIndex Index;
  std::vector<std::string> IndexedNames; ///< what Index was made from
  bool Valid = false;                    ///< Index is what the last look at the files gave
  bool Stale = false;                    ///< the files are to be looked at again
  std::set<std::string> Told;            ///< notices the user has had
  vtkGranularPrivate::Processes Ranks;
  std::shared_ptr<granular::BlockPool> Pool; ///< of output memory; null: none, or not made yet
  bool PoolMade = false;

  /**
   * Returns the ranks that read together. The first call is collective.
   */
  granular::Communicator& GetRanks() { return this->Ranks.Get(); }

  /**
   * Updates the index from the files, if they need to be examined: rank 0 does so for all ranks. Throws on all ranks,
   * and leaves the index invalid, if there is nothing to show. Collective.
   */
  void Update(Self* self);

  /**
   * Returns the frame that a request shows.
   */
  struct Shown
  {
    std::size_t Number = 0;
    double Time = 0;
    std::vector<granular::FramePiece> Pieces = {};
    granular::Where Where = {};     ///< of the first piece
    vtkInformation* Port = nullptr; ///< the output that is asked for
    granular::Notices Notices = {}; ///< to be told
    bool Together = true;           ///< the ranks read it together: the first one knows all notices
    granular::PartialProgress& Progress; ///< stops also where another rank has failed
  };

  /**
   * Prepares the memory pool for a frame.
   */
  void StartFrame(granular::Notices& notices);

  /**
   * Handles a request for data: show(shown) fills the outputs if there is a frame to show. It is collective, and
   * between two collective calls any rank may throw. Returns the value that the request must return.
   */
  int Run(Self* self, vtkInformation* request, vtkInformationVector* outputs,
    const std::function<void(Shown&)>& show);

  /**
   * Warns once per file, and once per notice, whichever frame it came with first; the number of warnings is limited.
   */
  void Tell(Self* self, const granular::Notices& notices, bool ofFrames);
};

#endif
