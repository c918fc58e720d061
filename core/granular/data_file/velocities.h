// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_data_file_velocities_h
#define granular_data_file_velocities_h

#include "granular/data_file/data_layout.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/dump_frame.h"

namespace granular
{
/// Adds the arrays of a table (section Velocities) to the particles with the same ids. The frame must have the array
/// id; rows and particles may be on different ranks. schema: the columns of both frames. section: the section of the
/// table in the source, for errors. Throws FormatError if a particle has no row or an id has several. Collective.
void add_velocities(DumpFrame& particles, const DumpFrame& table, const ColumnSchema& schema,
  const ByteSource& source, const DataSection& section, const std::shared_ptr<BlockPool>& pool,
  Communicator& ranks);
}
#endif
