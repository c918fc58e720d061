// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularWriterInternals_h
#define vtkGranularWriterInternals_h

#include "vtkGranularWriter.h"

#include "private/request/processes.h"

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/dump/write/dump_writer.h"
#include "granular/parallel/communicator.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * When in a run a frame is, as far as the pipeline knows.
 */
struct FrameTime
{
  std::optional<double> Time;       ///< that the input shows
  vtkTypeInt64 Frame = 0;           ///< number of the frame among those that are written, from 0
  std::optional<vtkTypeInt64> Step; ///< the time, where those of all frames are whole numbers
};

/**
 * A file that is being written, frame by frame. All functions are collective, and throw what the core does.
 */
class FrameWriter
{
public:
  virtual ~FrameWriter() = default;

  virtual void Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
    granular::Progress& progress) = 0;
  virtual void Finish() = 0;
};
}

/**
 * What a writer knows while it writes.
 */
struct vtkGranularWriter::Internals
{
  vtkGranularPrivate::Processes Ranks;
  std::unique_ptr<vtkGranularPrivate::FrameWriter> File;
  granular::Notices Notices;  ///< that the user has not had yet
  std::set<std::string> Told; ///< topics, or texts, of this file that the user has had

  /**
   * The processes that write together. Collective when it is called first.
   */
  granular::Communicator& GetRanks() { return this->Ranks.Get(); }

  /**
   * How the rows of dumps are written, as the properties say.
   */
  granular::WriteOptions MakeOptions(const vtkGranularWriter* self);

  /**
   * Warns of each topic once a file; a text without one is its own.
   */
  void Tell(vtkGranularWriter* self);
  void Tell(vtkGranularWriter* self, const std::string& text, const std::string& topic = {});
};

#endif
