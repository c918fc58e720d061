// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularWriterInternals_h
#define vtkGranularWriterInternals_h

#include "vtkGranularWriter.h"

#include "private/request/processes.h"

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/dump/write/dump_writer.h"
#include "granular/frames/input_files.h"
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
 * The time and timestep of a frame, as far as the pipeline knows them.
 */
struct FrameTime
{
  std::optional<double> Time;       ///< that the input shows
  vtkTypeInt64 Frame = 0;           ///< number of the frame among those that are written, from 0
  std::optional<vtkTypeInt64> Step; ///< the time, where those of all frames are whole numbers
};

/**
 * A file that is being written frame by frame. All functions are collective and throw what the core throws.
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
 * The state of a writer while it writes.
 */
struct vtkGranularWriter::Internals
{
  vtkGranularPrivate::Processes Ranks;
  std::unique_ptr<vtkGranularPrivate::FrameWriter> File;
  granular::Notices Notices;   ///< that the user has not had yet
  std::set<std::string> Told;  ///< topics, or texts, of this file that the user has had
  granular::InputFiles Inputs; ///< of all readers upstream

  /**
   * Returns the ranks that write together. The first call is collective.
   */
  granular::Communicator& GetRanks() { return this->Ranks.Get(); }

  /**
   * Finds the files that the readers upstream read, which must have looked at them.
   */
  void FindInputs(vtkGranularWriter* self);

  /**
   * Returns the format of the rows of dumps, from the properties.
   */
  granular::WriteOptions MakeOptions(const vtkGranularWriter* self);

  /**
   * Warns once per topic and file; a text without a topic is a topic of its own.
   */
  void Tell(vtkGranularWriter* self);
  void Tell(vtkGranularWriter* self, const std::string& text, const std::string& topic = {});
};

#endif
