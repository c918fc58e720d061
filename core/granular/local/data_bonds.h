// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_data_bonds_h
#define granular_local_data_bonds_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"

#include <string_view>

namespace granular
{
struct FileIndex;

/// Whether the first bytes of a file are the header of a data file of LAMMPS that counts atoms and bonds
/// (documentation of LAMMPS, read_data): a line that is a title, then lines such as "100 atoms".
bool is_data_with_bonds(std::string_view first_bytes);

/// FileIndex of a data file: its section Bonds as one frame of rows without a header. As FileFormat::index.
void index_data_bonds(const ByteSource& source, FileIndex& index, Progress& progress);
}
#endif
