// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularSeriesReaderInternals_h
#define vtkGranularSeriesReaderInternals_h

#include "vtkGranularSeriesReader.h"

#include "private/arrays/array_choice.h"
#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/request/piece_request.h"
#include "private/request/processes.h"

#include "granular/common/archive.h"
#include "granular/common/progress.h"
#include "granular/dump/read/dump_request.h"
#include "granular/frames/run_index.h"
#include "granular/local/local_reader.h"
#include "granular/memory/block_pool.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

class vtkInformation;
class vtkInformationVector;

/**
 * The files of a series reader, the index of their frames, the arrays and the notices that the user has received. What is
 * virtual is that of a format.
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

  /**
   * The arrays of frames.
   */
  struct Found
  {
    vtkGranularPrivate::ArrayNames Points = {};
    vtkGranularPrivate::ArrayNames Cells = {};
  };

  Internals(vtkGranularSeriesReader* self, const granular::FileFormat& format)
    : Self(self)
  {
    this->Options.format = &format;
  }
  virtual ~Internals() = default;

  /**
   * Returns the names of columns for files that do not name them.
   */
  virtual std::vector<std::string> GetColumnNames() const { return {}; }

  /**
   * Returns the properties on which Look depends: others make the reader look again.
   */
  virtual std::string GetLookKey() const { return {}; }

  /**
   * Finds out what the frames have, on rank 0. Take() takes what is in the archive, on all ranks.
   */
  virtual Found Look(granular::ArchiveWriter& archive);
  virtual void Take(granular::ArchiveReader& archive);

  /**
   * Describes the outputs to the pipeline, beyond pieces and times.
   */
  virtual void Describe(vtkInformationVector* outputs);

  /**
   * Fills the outputs. Collective, and between two collective calls any rank may throw.
   */
  virtual void Show(Shown& shown) = 0;

  /**
   * Returns the ranks that read together. The first call is collective.
   */
  granular::Communicator& GetRanks() { return this->Self->Ranks->Get(); }

  int GetThreads();

  /**
   * Updates the index from the files, if they need to be examined: rank 0 does so for all ranks. Throws on all ranks,
   * and leaves the index invalid, if there is nothing to show. Collective.
   */
  void Update();

  /**
   * Finds out what the frames have, unless that is known. Collective.
   */
  void LookOnce();

  /**
   * Shows the frame of a request for data. Collective.
   */
  void Run(vtkInformation* request, vtkInformationVector* outputs);

  /**
   * Warns once per file, and once per notice, whichever frame it came with first; the number of warnings is limited.
   */
  void Tell(const granular::Notices& notices, bool ofFrames);

  /**
   * Returns all ranks if they request the pieces of one thing, each its own; otherwise this one alone, for example if a
   * filter asks one rank for another time. Ranks that read together must agree on the names of the arrays and on
   * everything that form(archive) writes. Collective.
   */
  granular::Communicator& FindGroup(
    Shown& shown, const std::function<void(granular::ArchiveWriter&)>& form);

  /**
   * Returns the request for the particles that the properties of a reader describe.
   */
  template <class Reader>
  granular::DumpRequest MakeDumpRequest(Reader* reader)
  {
    granular::DumpRequest request;
    request.coordinates = static_cast<granular::Coordinates>(reader->GetCoordinates());
    request.point_origin = CheckOrigin(reader->GetPointOrigin());
    request.sort_by_id = reader->GetSortById();
    request.stride = reader->GetStride();
    std::copy_n(reader->GetRegionOfInterest(), 6, request.region.begin());
    request.wanted = [wanted = this->Points.MakeFilter()](const granular::ArrayInfo& array)
    { return wanted(array.name); };
    request.threads = this->GetThreads();
    request.pool = this->Pool;
    return request;
  }

  /**
   * Writes what ranks that read particles together must agree on.
   */
  static void PassForm(granular::ArchiveWriter& form, const granular::DumpRequest& request);

  granular::LineRequest MakeLineRequest(int periodicLines, const double pointOrigin[3]);

  /**
   * Fills output 0 with particles, and the last one with their box.
   */
  void FillParticles(Shown& shown, granular::DumpFrame& frame, const granular::Vector3& pointOrigin,
    bool singlePrecision = false,
    vtkGranularPrivate::VertexCells cells = vtkGranularPrivate::VertexCells::OnePerPoint);

  /**
   * Fills output 1 with bonds.
   */
  static void FillBonds(
    Shown& shown, granular::LocalFrame& bonds, const granular::LineRequest& request);

  /**
   * Throws LimitError if a PointOrigin is not finite.
   */
  static granular::Vector3 CheckOrigin(const double origin[3]);

  vtkGranularSeriesReader* const Self;
  std::vector<std::string> FileNames;
  granular::RunIndex Index;
  granular::IndexOptions Options;        ///< that Index was made with
  std::vector<std::string> IndexedNames; ///< what it was made from
  bool Valid = false;                    ///< Index is what the last look at the files gave
  bool Stale = false;                    ///< the files are to be looked at again
  vtkGranularPrivate::ArrayChoice Points;
  vtkGranularPrivate::ArrayChoice Cells;
  std::set<std::string> Told;                ///< notices the user has had
  std::shared_ptr<granular::BlockPool> Pool; ///< of output memory; null: none, or not made yet

private:
  std::optional<std::string>
    LookedAt; ///< what GetLookKey was when the reader looked; nothing: it has not
  bool PoolMade = false;
  vtkGranularPrivate::VertexCache Vertices; ///< of the frame before
  granular::SerialCommunicator Alone;
};

#endif
