// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularReaderFrames_h
#define vtkGranularReaderFrames_h

#include "granular/dump/read/dump_request.h"
#include "granular/frames/run_index.h"

#include <optional>

class vtkAlgorithm;

namespace vtkGranularPrivate
{
/**
 * The frames of a dump reader, for filters that read columns of many frames themselves. Valid until the reader's next update.
 */
struct ReaderFrames
{
  const granular::RunIndex* Index = nullptr; ///< one frame for each time of the reader
  granular::DumpRequest Request;             ///< what the reader shows

  /**
   * Returns the frames of an algorithm's input, if that is the particles of a dump reader that has looked at its files. What
   * ParaView puts between them, and passes all data on, does not matter.
   */
  static std::optional<ReaderFrames> Find(vtkAlgorithm* consumer);
};
}

#endif
