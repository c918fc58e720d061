// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_sort_rows_h
#define granular_dump_sort_rows_h

#include "granular/dump/dump_reader.h"

namespace granular
{
/// Brings the rows of a frame into the order of their ids; rows of the same id keep theirs.
/// ids holds frame.rows ids, or is empty if the frame has an array with the role Id. If there are
/// neither, the order stays and a notice says so.
void sort_by_id(DumpFrame& frame, const Block& ids, Notices& notices, const Where& where);
}
#endif
