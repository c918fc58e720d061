// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularWriterInternals_h
#define vtkGranularWriterInternals_h

#include "vtkGranularWriter.h"

#include "private/dump/dump_input.h"
#include "private/request/processes.h"

#include "granular/common/error.h"
#include "granular/formats/dump/write/dump_writer.h"
#include "granular/frames/input_files.h"
#include "granular/parallel/communicator.h"
#include "granular/writing/file_names.h"
#include "granular/writing/whole_writer.h"

#include "vtkType.h"

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * The time and timestep of a frame, as far as the pipeline knows them.
 */
struct FrameTime
{
  std::optional<double> Time;       ///< that the input shows
  vtkTypeInt64 Frame = 0;           ///< number of the frame among those that are written, from 0
  std::optional<vtkTypeInt64> Step; ///< the time, where those of all frames are whole numbers
};

/**
 * A file that is being written frame by frame. All functions are collective and throw what the core throws.
 */
class FrameWriter
{
public:
  virtual ~FrameWriter() = default;

  void Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
    granular::Progress& progress);
  virtual void Finish() = 0;

protected:
  FrameWriter(std::string path, granular::Communicator& ranks);

  /**
   * Takes this rank's part of a frame. Not collective.
   */
  virtual std::unique_ptr<RowsInput> Take(vtkDataObject* input, granular::Notices& notices) = 0;

  /**
   * Writes a frame, of which this rank has these rows. Timestep and time are those of all ranks.
   */
  virtual void WriteRows(
    const granular::FrameView& own, granular::Notices& notices, granular::Progress& progress) = 0;

  /**
   * Returns true if the user should know what serves as the timestep of an input without one.
   */
  virtual bool TellsStep(const FrameTime& time) const = 0;

  const std::string Path;
  granular::Communicator& Ranks;
};

/**
 * A dump that is being written, of particles or other rows.
 */
class RowsFile : public FrameWriter
{
public:
  using TakePart =
    std::function<std::unique_ptr<RowsInput>(vtkDataObject* input, granular::Notices& notices)>;

  /**
   * take: see FrameWriter::Take.
   */
  RowsFile(const std::string& path, granular::DumpFormat format,
    const granular::WriteOptions& options, granular::Communicator& ranks, TakePart take);

  void Finish() final { this->Writer.finish(); }

private:
  std::unique_ptr<RowsInput> Take(vtkDataObject* input, granular::Notices& notices) final
  {
    return this->Taking(input, notices);
  }
  void WriteRows(
    const granular::FrameView& own, granular::Notices& notices, granular::Progress& progress) final;
  bool TellsStep(const FrameTime&) const final { return true; }

  granular::DumpWriter Writer;
  const TakePart Taking;
};

/**
 * A text file that the first rank writes for all ranks at once.
 */
class WholeFile : public FrameWriter
{
public:
  /**
   * holdsMany: as for granular::WholeWriter.
   */
  WholeFile(const std::string& path, bool holdsMany, const granular::WriteOptions& options,
    granular::Communicator& ranks);

  void Finish() final { this->Writer.finish(); }

protected:
  /**
   * Gathers the parts of all ranks. Collective.
   */
  virtual void Gather(granular::Notices& notices, granular::Progress& progress) = 0;

  /**
   * Returns the text of the frame, on the first rank.
   */
  virtual std::string Encode(
    std::optional<double> time, granular::Notices& notices, granular::Progress& progress) = 0;

private:
  void WriteRows(
    const granular::FrameView& own, granular::Notices& notices, granular::Progress& progress) final;
  bool TellsStep(const FrameTime& time) const final;

  granular::WholeWriter Writer;
};

/**
 * Returns the dialect for the property Dialect of a writer of dumps: 0 LIGGGHTS, 1 LAMMPS, any other value that of the
 * file that was read.
 */
std::optional<granular::Dialect> DialectOf(int property);
}

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
