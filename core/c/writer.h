// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_c_writer_h
#define granular_c_writer_h

#include "frame.h"
#include "run.h"

#include "granular/common/progress.h"

#include <memory>
#include <string>

/// A file that is being written. It appears when finish() is done; without it the old file is untouched.
struct granular_writer
{
  granular_writer(const granular_writer&) = delete;
  granular_writer& operator=(const granular_writer&) = delete;
  virtual ~granular_writer() = default;

  virtual void write(
    const granular::FrameView& frame, granular::Notices& notices, granular::Progress& progress) = 0;
  virtual void finish() = 0;

  const granular_c::RowKind kind;
  granular_c::Caller caller;

protected:
  granular_writer(granular_c::RowKind of, const granular_format& format)
    : kind(of)
    , caller(format.progress, format.notice, format.user)
  {
  }
};

namespace granular_c
{
/// Begins a file. Throws BadArgument for a style or dialect that there is not, and the errors of DumpWriter.
std::unique_ptr<granular_writer> create_writer(
  const std::string& path, const granular_format& format);
}
#endif
