// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_data_file_section_join_h
#define granular_data_file_section_join_h

#include "granular/data_file/data_layout.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/dump_frame.h"

#include <cstdint>
#include <memory>
#include <string_view>

namespace granular
{
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
std::int64_t join_section(DumpFrame& particles, const DumpFrame& table, const ColumnSchema& schema,
  const ByteSource& source, const ParticleSection& section, const std::shared_ptr<BlockPool>& pool,
  Communicator& ranks);
}
#endif
