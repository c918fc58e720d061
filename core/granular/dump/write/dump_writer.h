// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_dump_writer_h
#define granular_dump_write_dump_writer_h

#include "granular/common/progress.h"
#include "granular/dump/write/dump_format.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <memory>
#include <set>
#include <string>

namespace granular
{
/// How ranks write a file together.
enum class ParallelMode : std::uint8_t
{
  Gather, ///< the first rank writes; the others send it their rows, one after the other, chunk by chunk
  MpiIo ///< each rank writes its rows where they belong; where ranks cannot, and compressed files: as Gather
};

struct FramePlan;

/// What changes how a dump is written, and no byte of it.
struct WriteOptions
{
  ParallelMode mode = ParallelMode::Gather;
  int threads = 1; ///< >= 1, of each rank
};

/// Writes a dump of one or more frames, from the rows of all ranks in the order of the ranks: the bytes do not
/// depend on their number, nor on that of threads. The file is there when finish() is done, and until then the
/// old one is as it was; so it stays where a writer ends without. A name with '%' gives each rank a
/// file of its own with its number for the '%', and its own number of atoms, and one with '*' each frame one
/// with its timestep for the '*', which is there when write() is done, as the dump command has it. With '%' each file of
/// local data, too, has a header of its own, which programs give to the first one only.
///
/// All functions, the destructor too, are collective. Errors of one rank are thrown on all (see agree);
/// after one the writer is of no use. Memory beside the rows: some 64 MiB; sorting copies the rows.
class DumpWriter
{
public:
  /// Opens the file under another name. Throws IoError, and what check_format does.
  DumpWriter(std::string path, DumpFormat format, const WriteOptions& options, Communicator& ranks);
  DumpWriter(const DumpWriter&) = delete;
  DumpWriter& operator=(const DumpWriter&) = delete;
  ~DumpWriter();

  /// Adds a frame: see FrameView for what it is made of, and plan_columns for how. A timestep that was written before
  /// gets a notice, and where each has a file of its own an Error. The first frame whose numbers lose more than a
  /// RoundingLimit gets a notice that says how much. Throws Error, Cancelled; std::logic_error
  /// after finish().
  void write(const FrameView& frame, Notices& notices, Progress& progress);

  /// Gives the file its name. Nothing more can be written then.
  void finish();

private:
  struct File;

  void check_step(std::int64_t timestep, Notices& notices);
  void write_rows(const FrameView& frame, FramePlan& plan, Notices& notices, Progress& progress);

  std::string path_;
  DumpFormat format_;
  WriteOptions options_;
  Communicator& ranks_;
  std::unique_ptr<File> file_;
  std::set<std::int64_t> steps_; ///< that are written
  bool told_loss_ = false;
};
}
#endif
