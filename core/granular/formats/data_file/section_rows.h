// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_data_file_section_rows_h
#define granular_formats_data_file_section_rows_h

#include "granular/bytes/byte_source.h"
#include "granular/formats/data_file/data_layout.h"
#include "granular/frames/run_index.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/table.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// A byte source in which each comment, from # to the end of the line, is blank. The underlying source must outlive it.
class Uncommented final : public ByteSource
{
public:
  /// begin: the start of a line; no byte before it is read.
  Uncommented(const ByteSource& source, std::int64_t begin)
    : source_(source)
    , begin_(begin)
  {
  }

  const std::string& path() const override { return source_.path(); }
  FileStamp stamp() const override { return source_.stamp(); }
  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override;
  double fraction(std::int64_t offset) const override { return source_.fraction(offset); }
  bool compressed() const override { return source_.compressed(); }
  bool concurrent() const override { return source_.concurrent(); }
  std::string unchecked() const override { return source_.unchecked(); }

private:
  bool is_comment(std::int64_t offset) const;

  const ByteSource& source_;
  std::int64_t begin_;
};

/// Presents the rows of a section of a data file as the rows of a frame without a header, for read_dump. The file and
/// the source must outlive this object.
class SectionRows
{
public:
  SectionRows(const FramePiece& file, const ByteSource& source, const DataSection& section,
    const std::vector<std::string>& columns);

  /// Returns one piece, which points into this object.
  std::vector<FramePiece> pieces() const;

private:
  const FileIndex& file_;
  const ByteSource& source_;
  Uncommented uncommented_;
  bool has_comments_;
  FrameEntry entry_;
};

/// A section whose rows belong to particles by their ids.
struct ParticleSection
{
  std::string_view name;
  const DataSection& rows;
  bool
    of_all; ///< each particle has a row; else those without one get the values of a particle without a shape
};

/// Adds the arrays of the table of a section to the particles with the same ids. The frame must have the array id; rows and
/// particles may be on different ranks. schema: the columns of both frames. The first array of the table behind its ids must
/// have three components. Returns how many rows belong to particles of this rank. Throws FormatError if an id has several rows,
/// or a particle none where all have one. Collective.
std::int64_t join_section(Table& particles, const Table& table, const ColumnSchema& schema,
  const ByteSource& source, const ParticleSection& section, const std::shared_ptr<BlockPool>& pool,
  Communicator& ranks);
}
#endif
