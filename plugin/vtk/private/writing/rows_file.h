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
 * Returns the dialect for the property Dialect of a writer: 0 LIGGGHTS, 1 LAMMPS, any other value that of the file that
 * was read.
 */
std::optional<granular::Dialect> DialectOf(int property);

/**
 * Returns the format of a dump, by its name and the properties that all writers of dumps share. Without a dialect: the
 * dialect of the file that was read. Throws what granular::parse_number_format throws.
 */
granular::DumpFormat MakeFormat(const char* path, std::optional<granular::Dialect> dialect,
  const char* columns, const char* numberFormat);

/**
 * A dump that is being written, of particles or other rows.
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
   * Takes this rank's part of a frame. Not collective.
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
