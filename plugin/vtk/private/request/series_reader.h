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
 * The files, what is known of them, and what the user was told.
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
   * The processes that read together. Collective when it is called first.
   */
  granular::Communicator& GetRanks() { return this->Ranks.Get(); }

  /**
   * Brings the index up to the files, if they are to be looked at at all: rank 0 looks, for all. Throws,
   * on all ranks, and leaves the index invalid, if there is nothing to show. Collective.
   */
  void Update(Self* self);

  /**
   * The frame that a request shows.
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
   * Readies the memory for a frame.
   */
  void StartFrame(granular::Notices& notices);

  /**
   * Does a request for data: show(shown) fills the outputs where there is a frame to show; it is collective, and between two
   * collectives any rank may throw. Returns what the request returns.
   */
  int Run(Self* self, vtkInformation* request, vtkInformationVector* outputs,
    const std::function<void(Shown&)>& show);

  /**
   * One warning a file, and each notice once, for whichever frame it came first; not too many.
   */
  void Tell(Self* self, const granular::Notices& notices, bool ofFrames);
};

#endif
