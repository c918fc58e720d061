// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularSeriesReaderInternals_h
#define vtkGranularSeriesReaderInternals_h

#include "vtkGranularSeriesReader.h"

#include "private/arrays/array_choice.h"
#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/request/processes.h"
#include "private/request/request_task.h"

#include "granular/common/progress.h"
#include "granular/memory/block.h"
#include "granular/runs/run.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

class vtkGranularParticleReader;
class vtkInformation;
class vtkInformationVector;

/**
 * A run of the core behind a series reader, with the arrays that the user has chosen and the notices that he has received. What is
 * virtual differs between readers.
 */
struct vtkGranularSeriesReader::Internals
{
  /**
   * The frame that a request shows.
   */
  struct Shown
  {
    std::size_t Number = 0;
    std::vector<granular::FramePiece> Pieces = {};
    granular::Where Where = {}; ///< of the first piece
    vtkInformationVector* Outputs = nullptr;
    vtkInformation* Port = nullptr; ///< the output that is asked for
    vtkGranularPrivate::PieceRequest Piece = {};
    granular::Notices Notices = {}; ///< to be told
    bool Together = true;           ///< the ranks read it together: the first one knows all notices
    granular::PartialProgress& Progress; ///< stops also where another rank has failed
  };

  Internals(vtkGranularSeriesReader* self, const granular::Kind& kind)
    : Self(self)
    , Run(kind)
  {
  }
  virtual ~Internals() = default;

  /**
   * Sets the options of the run that are properties of the reader.
   */
  virtual void SetOptions(granular::RunOptions&) const {}

  /**
   * Returns the kind of the files, for readers of several. Collective.
   */
  virtual const granular::Kind& FindKind() { return this->Run.kind(); }

  /**
   * Sets what is asked of a frame by properties of the reader. Throws Error.
   */
  virtual void SetRequest(granular::Request&) const {}

  /**
   * Sets what the properties of readers of particles say.
   */
  static void SetParticles(granular::Request& request, vtkGranularParticleReader* reader);

  /**
   * Returns the properties on which LookFurther depends: others make the reader look again.
   */
  virtual std::string GetLookKey() const { return {}; }

  /**
   * Finds out what the outputs will be, beyond their arrays. Collective.
   */
  virtual void LookFurther() {}

  /**
   * Describes the outputs to the pipeline, beyond pieces and times.
   */
  virtual void Describe(vtkInformationVector*) {}

  /**
   * Fills the outputs: lines and their rows for local data, and otherwise particles, bonds if there may be any, and the box.
   * Collective, and between two collective calls any rank may throw.
   */
  virtual void Show(Shown& shown);

  /**
   * Returns the kind of cells that particles get.
   */
  virtual vtkGranularPrivate::VertexCells GetVertices() const
  {
    return vtkGranularPrivate::VertexCells::OnePerPoint;
  }

  /**
   * Returns the ranks that read together. The first call is collective.
   */
  granular::Communicator& GetRanks() { return this->Self->Ranks->Get(); }

  int GetThreads();

  /**
   * Updates the run from the files, if they need to be examined: rank 0 does so for all ranks. Throws on all ranks,
   * and leaves the run invalid, if there is nothing to show. Collective.
   */
  void Update();

  /**
   * Finds out what the frames have, unless that is known. Collective.
   */
  void LookOnce();

  /**
   * Shows the frame of a request for data. Collective.
   */
  void ShowRequested(vtkInformation* request, vtkInformationVector* outputs);

  /**
   * Warns once per file, and once per notice, whichever frame it came with first; the number of warnings is limited.
   */
  void Tell(const granular::Notices& notices, bool ofFrames);

  /**
   * Returns how the files are understood, by the properties of the reader.
   */
  granular::RunOptions MakeOptions();

  /**
   * Returns what is asked of a frame: whole, by the properties of the reader.
   */
  granular::Request MakeRequest();

  vtkGranularSeriesReader* const Self;
  std::vector<std::string> FileNames;
  granular::Run Run;
  std::vector<std::string> IndexedNames; ///< what it was made from
  bool Valid = false;                    ///< Run is what the last look at the files gave
  bool Stale = false;                    ///< the files are to be looked at again
  vtkGranularPrivate::ArrayChoice Points;
  vtkGranularPrivate::ArrayChoice Cells;
  std::set<std::string> Told;                ///< notices the user has had
  std::shared_ptr<granular::BlockPool> Pool; ///< of output memory; null: none, or not made yet

private:
  void FillBox(Shown& shown, const granular::Table& rows, const granular::Request& request);
  void FillLines(Shown& shown, granular::Tables& frame, const granular::Request& lines);
  void FillParticles(Shown& shown, granular::Tables& frame, const granular::Request& request);

  std::optional<std::string>
    LookedAt; ///< what GetLookKey was when the reader looked; nothing: it has not
  bool PoolMade = false;
  vtkGranularPrivate::VertexCache Vertices; ///< of the frame before
  granular::SerialCommunicator Alone;
};

#endif
