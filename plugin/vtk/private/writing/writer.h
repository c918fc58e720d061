// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularWriterInternals_h
#define vtkGranularWriterInternals_h

#include "vtkGranularWriter.h"

#include "private/request/processes.h"
#include "private/writing/frame_writer.h"

#include "granular/common/error.h"
#include "granular/frames/input_files.h"
#include "granular/parallel/communicator.h"
#include "granular/writing/write_options.h"

#include <memory>
#include <set>
#include <string>

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
