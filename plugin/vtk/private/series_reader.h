// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularSeriesReaderInternals_h
#define vtkGranularSeriesReaderInternals_h

#include "vtkGranularSeriesReader.h"

#include "granular/dump/frame_index.h"

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
  std::vector<std::string> ColumnNames; ///< for files that do not name their columns
  granular::FrameIndex Index;
  std::vector<std::string> IndexedNames; ///< what Index was made from
  bool Valid = false;                    ///< Index is what the last look at the files gave
  bool Stale = false;                    ///< the files are to be looked at again
  bool Cancelled = false;                ///< the last request was
  std::set<std::string> Told;            ///< notices the user has had

  /**
   * Brings the index up to the files, if they are to be looked at at all. Throws, and leaves the index
   * invalid, if there is nothing to show.
   */
  void Update(Self* self);

  /**
   * The frame that the port which is asked for shows, and its time.
   */
  std::size_t FindFrame(
    Self* self, vtkInformation* request, vtkInformationVector* outputs, double& time);

  /**
   * One warning a file, and each notice once, for whichever frame it came first; not too many.
   */
  void Tell(Self* self, const granular::Notices& notices, bool ofFrames);
};

#endif
