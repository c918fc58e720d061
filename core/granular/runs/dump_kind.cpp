// SPDX-License-Identifier: BSD-3-Clause
// Dumps: particles.
#include "granular/runs/kind.h"

#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"

namespace granular
{
namespace
{
Offer offer_dump(const RunPlace& place, Progress&)
{
  const ColumnSchema& schema = place.index.first_piece(place.frame).entry.kind->schema;
  return { .tables = { arrays_of(schema, known_columns()) } };
}

RunFrame read_dump_frame(const RunPlace& place, const Request& request, const Offer&,
  Communicator& ranks, Notices& notices, Progress& progress)
{
  const std::vector<FramePiece> pieces = place.index.pieces(place.frame);
  return { .rows = {
             .table = read_dump(pieces, dump_request(request), ranks, notices, progress) } };
}
}

constinit const Kind dump_kind = { .number = 0,
  .rows = RowKind::Particles,
  .is_file = is_dump_file,
  .format = dump_format,
  .columns = known_columns,
  .tells_by_columns = true,
  .has_pieces = true,
  .has_parts = true,
  .looked_at = one_for_columns,
  .offer = offer_dump,
  .read = read_dump_frame };
}
