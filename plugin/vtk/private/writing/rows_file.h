// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularRowsFile_h
#define vtkGranularRowsFile_h

#include "private/dump/dump_input.h"
#include "private/writing/writer.h"

#include "granular/dump/write/dump_writer.h"

#include <memory>
#include <optional>
#include <string>

namespace vtkGranularPrivate
{
/**
 * What the property Dialect of a writer says: 0 LIGGGHTS, 1 LAMMPS, any other that of the file that was read.
 */
std::optional<granular::Dialect> DialectOf(int property);

/**
 * How a dump is written, by its name and the properties that all writers of dumps have. Without a dialect: that of the file that
 * was read. Throws what granular::parse_number_format does.
 */
granular::DumpFormat MakeFormat(const char* path, std::optional<granular::Dialect> dialect,
  const char* columns, const char* numberFormat);

/**
 * A dump that is being written, of particles or of anything else that has rows.
 */
class RowsFile : public FrameWriter
{
public:
  RowsFile(const char* path, granular::DumpFormat format, const granular::WriteOptions& options,
    granular::Communicator& ranks);

  void Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
    granular::Progress& progress) final;
  void Finish() final;

protected:
  /**
   * Takes what this process has of a frame. Not collective.
   */
  virtual std::unique_ptr<RowsInput> Take(vtkDataObject* input, granular::Notices& notices) = 0;

  const std::string Path;

private:
  void Gather(const std::string& own, granular::Notices& notices);

  granular::Communicator& Ranks;
  granular::DumpWriter Writer;
};
}

#endif
