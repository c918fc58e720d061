// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_data_file_section_rows_h
#define granular_formats_data_file_section_rows_h

#include "granular/bytes/byte_source.h"
#include "granular/formats/data_file/data_layout.h"
#include "granular/frames/run_index.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/request.h"
#include "granular/particles/table.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// A section whose rows belong to particles by their ids.
struct JoinedSection
{
  const DataSection* section;
  std::vector<std::string> columns; ///< the first is id
  bool
    of_all; ///< each particle has a row; else those without one get the values of a particle without a shape, or 0
};

/// Decodes the rows of a section of a data file as read_dump does those of a frame without a header; comments, from # to the end
/// of the line, are blank. source: of the file. labels, unless null: of the types in the column `type_column`, which become their
/// numbers. Collective. Throws the errors of read_dump, and FormatError for other labels.
Table read_section(const FramePiece& file, const ByteSource& source, const DataSection& section,
  const ColumnSchema& schema, const TypeLabels* labels, std::string_view type_column,
  const Request& request, Communicator& ranks, Notices& notices, Progress& progress);

/// Adds the arrays of the table of a section to the particles with the same ids. The frame must have the array id; rows and
/// particles may be on different ranks. schema: the columns of both frames, those of the section from `first` on. Returns how many rows belong to particles of this
/// rank. Throws FormatError if an id has several rows, or a particle none where all have one. Collective.
std::int64_t join_section(Table& particles, const Table& table, const ColumnSchema& schema,
  std::size_t first, const ByteSource& source, const JoinedSection& section,
  const std::shared_ptr<BlockPool>& pool, Communicator& ranks);
}
#endif
