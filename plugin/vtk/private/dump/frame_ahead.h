// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularFrameAhead_h
#define vtkGranularFrameAhead_h

#include "granular/dump/read/dump_reader.h"

#include "vtkType.h"

#include <atomic>
#include <cstddef>
#include <future>
#include <memory>
#include <optional>
#include <vector>

namespace vtkGranularPrivate
{
/**
 * Decodes a frame in the background, before it is asked for.
 */
class FrameAhead
{
public:
  /**
   * What is decoded: it is used only where all of it is asked for.
   */
  struct Key
  {
    std::size_t Frame = 0;
    int Piece = 0;
    int Pieces = 1;
    bool Together = false;
    vtkMTimeType ReaderTime = 0; ///< of the properties

    bool operator==(const Key&) const = default;
  };

  FrameAhead();
  FrameAhead(const FrameAhead&) = delete;
  FrameAhead& operator=(const FrameAhead&) = delete;
  ~FrameAhead();

  /**
   * Begins, in place of what was begun before. What the pieces refer to must stay until Take or Drop.
   * Throws what the lack of memory or of a thread throws, and has begun nothing then.
   */
  void Start(
    const Key& key, std::vector<granular::FramePiece> pieces, const granular::DumpRequest& request);

  /**
   * The frame, if it is the one that was begun, once it is there; nothing if it is another one, if it
   * could not be decoded, which who decodes it now will find, or if a file is not what it was.
   */
  std::optional<granular::DumpPart> Take(const Key& key, granular::Progress& progress);

  /**
   * Stops the work, if there is any, and forgets it.
   */
  void Drop();

private:
  struct Work;

  std::unique_ptr<Work> Running;
};
}

#endif
