// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_write_dump_writer_h
#define granular_formats_dump_write_dump_writer_h

#include "granular/common/progress.h"
#include "granular/formats/dump/write/dump_format.h"
#include "granular/frames/input_files.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"
#include "granular/writing/file_names.h"

#include <cstdint>
#include <memory>
#include <set>
#include <string>

namespace granular
{
struct FramePlan;

/// Writes a dump of one or more frames, from the rows of all ranks in rank order. The bytes do not depend on the number of
/// ranks or threads. The file appears when finish() is done; until then, and if the writer ends without it, the old file is
/// untouched. As in the dump command, a name with '%' gives each rank a file with its number for the '%' and its own number
/// of atoms. A name with '*' gives each frame a file with its timestep for the '*', which appears when write() is done, or with
/// finish() if it replaces a file that is read. With '%', each file of local data has a header, which programs write only to
/// the first one.
///
/// All functions, also the destructor, are collective. An error on one rank is thrown on all (see agree). After a frame that
/// failed the others refuse to go on, so that no file with a part of a frame gets its name. Memory beside the rows: about 64 MiB; sorting copies the rows.
class DumpWriter
{
public:
  /// Opens the file under a temporary name. Throws IoError, and the errors of check_format.
  DumpWriter(std::string path, DumpFormat format, const WriteOptions& options, Communicator& ranks);
  DumpWriter(const DumpWriter&) = delete;
  DumpWriter& operator=(const DumpWriter&) = delete;
  ~DumpWriter();

  /// Adds a frame: see FrameView for its data and plan_columns for its columns. A repeated timestep is an Error. The first frame whose
  /// numbers lose too much, see RoundingLoss, gets a notice with the amount. Throws Error, Cancelled; std::logic_error after finish().
  void write(const FrameView& frame, Notices& notices, Progress& progress);

  /// Gives the file its name. No frame can be added afterwards.
  void finish();

private:
  struct File;

  void expect_whole() const;
  void close();
  void write_rows(const FrameView& frame, FramePlan& plan, Notices& notices, Progress& progress);

  std::string path_;
  DumpFormat format_;
  WriteOptions options_;
  Communicator& ranks_;
  std::unique_ptr<File> file_;
  HeldFiles held_;
  std::set<std::int64_t> steps_; ///< that were written
  bool told_loss_ = false;
  bool failed_ = false; ///< in a frame
};
}
#endif
