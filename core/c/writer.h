// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_c_writer_h
#define granular_c_writer_h

#include "frame.h"
#include "run.h"

#include "granular/frames/input_files.h"
#include "granular/grid/subdomains.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

/// A file that is being written. It appears when finish() is done; without it the old file is untouched.
struct granular_writer
{
  /// Throws ArgumentError unless at least one frame was written, and all of them whole.
  void expect_frames() const;

  /// Adds the files of a run, which a frame comes from, to those that are read meanwhile.
  void add_inputs(const std::shared_ptr<const granular::RunIndex>& other);

  const granular_c::RowKind kind;
  const std::string path;
  granular_c::Caller caller;
  std::int64_t frames = 0; ///< that were begun
  bool failed = false;     ///< in one of them
  granular::InputFiles inputs = {};
  std::shared_ptr<const granular::RunIndex> index = {}; ///< that was added to inputs last
  granular::SerialCommunicator alone = {};

  // of the core's writer, which refers to what stands above
  std::function<void(const granular::FrameView&, granular::Notices&, granular::Progress&)>
    write = {};
  std::function<void()> finish = {};
};

namespace granular_c
{
/// Returns the subdomains of a frame with the arrays lo, hi and, if known, nlocal and proc; unknown ranks are counted. Throws
/// ArgumentError.
granular::Decomposition decomposition_of(const granular::FrameView& frame);

/// Begins a file. Throws ArgumentError for a style or dialect that there is not, and the errors of DumpWriter.
std::unique_ptr<granular_writer> create_writer(
  const std::string& path, const granular_format& format);
}
#endif
