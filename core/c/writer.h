// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_c_writer_h
#define granular_c_writer_h

#include "frame.h"
#include "run.h"

#include "granular/common/progress.h"
#include "granular/frames/input_files.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

/// A file that is being written. It appears when finish() is done; without it the old file is untouched.
struct granular_writer
{
  granular_writer(const granular_writer&) = delete;
  granular_writer& operator=(const granular_writer&) = delete;
  virtual ~granular_writer() = default;

  virtual void write(
    const granular::FrameView& frame, granular::Notices& notices, granular::Progress& progress) = 0;

  /// Throws BadArgument unless at least one frame was written, and all of them whole.
  void expect_frames() const;
  virtual void finish() = 0;

  /// Adds the files that a frame comes from to those that are read meanwhile.
  void add_inputs(const granular_frame& frame);

  const granular_c::RowKind kind;
  const std::string path;
  granular_c::Caller caller;
  std::int64_t frames = 0; ///< that were begun
  bool failed = false;     ///< in one of them

protected:
  granular_writer(granular_c::RowKind of, std::string to, const granular_format& format)
    : kind(of)
    , path(std::move(to))
    , caller(format.progress, format.notice, format.user)
  {
  }

  granular::InputFiles inputs;

private:
  std::shared_ptr<const granular::RunIndex> index_; ///< that was added last
};

namespace granular_c
{
/// Begins a file. Throws BadArgument for a style or dialect that there is not, and the errors of DumpWriter.
std::unique_ptr<granular_writer> create_writer(
  const std::string& path, const granular_format& format);
}
#endif
