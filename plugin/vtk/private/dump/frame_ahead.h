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
 * Decodes a frame in the background before it is requested.
 */
class FrameAhead
{
public:
  /**
   * Identifies a decoded frame; it is used only if all of this is requested.
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
   * Begins to decode, in place of an earlier frame. The pieces must stay until Take or Drop. Throws if memory or a
   * thread is not available; nothing was begun then.
   */
  void Start(
    const Key& key, std::vector<granular::FramePiece> pieces, const granular::DumpRequest& request);

  /**
   * Returns the requested frame if it is the one that was begun, and waits for it. Returns nothing for another frame,
   * if decoding failed (decoding it again reports the error), or if a file has changed.
   */
  std::optional<granular::DumpPart> Take(const Key& key, granular::Progress& progress);

  /**
   * Stops the work, if any, and discards it.
   */
  void Drop();

private:
  struct Work;

  std::unique_ptr<Work> Running;
};
}

#endif
