// SPDX-License-Identifier: BSD-3-Clause
// Dumps of grids: cells.
#include "granular/formats/grid_dump/grid_dump.h"
#include "granular/runs/kind.h"

namespace granular
{
namespace
{
Offer offer_cells(const RunPlace& place, Progress&)
{
  Offer offer;
  offer.tables[0] =
    arrays_of(place.index.first_piece(place.frame).entry.kind->schema, known_columns());
  std::erase_if(
    offer.tables[0], [](const OfferedArray& array) { return array.type == ValueType::Text; });
  for (OfferedArray& array : offer.tables[0])
  {
    array.type = ValueType::Float64;
    array.is_usual = array.is_usual && array.name != "id"; // cells are in their order
  }
  return offer;
}
}

constinit const Kind grid_kind = { .number = 6,
  .rows = RowKind::Cells,
  .is_file = is_grid_file,
  .format = grid_format,
  .columns = known_columns,
  .tells_by_columns = true,
  .looked_at = one_for_columns,
  .offer = offer_cells,
  .read = read_cells,
  .cells = read_grid };
}
