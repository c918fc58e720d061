// SPDX-License-Identifier: BSD-3-Clause
// Dumps: particles.
#include "granular/runs/kind.h"

#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/formats/dump/read/dump_reader.h"

#include <algorithm>

namespace granular
{
namespace
{
Offer offer_dump(const RunPlace& place, Progress&)
{
  Offer offer;
  offer.tables[0] =
    arrays_of(place.index.first_piece(place.frame).entry.kind->schema, known_columns());
  offer.has_points = !std::ranges::all_of(offer.tables[0], &OfferedArray::is_usual);
  return offer;
}

Tables read_dump_frame(const RunPlace& place, const Request& request, const Offer&,
  Communicator& ranks, Notices& notices, Progress& progress)
{
  return { .rows = read_dump(place.index.pieces(place.frame), request, ranks, notices, progress) };
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
