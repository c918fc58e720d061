// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_data_file_velocities_h
#define granular_data_file_velocities_h

#include "granular/data_file/data_layout.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/dump_frame.h"

namespace granular
{
/// Gives the particles of a frame, which must have the array id, what the rows of a table with their ids have. Rows and
/// particles may be on any ranks. schema: of both. source: where the section of the table is. Throws FormatError where a
/// particle has no row, or an id several. Collective.
void add_velocities(DumpFrame& particles, const DumpFrame& table, const ColumnSchema& schema,
  const ByteSource& source, const DataSection& section, const std::shared_ptr<BlockPool>& pool,
  Communicator& ranks);
}
#endif
