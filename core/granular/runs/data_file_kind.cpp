// SPDX-License-Identifier: BSD-3-Clause
// Data files: particles and bonds.
#include "granular/runs/kind.h"

#include "granular/formats/data_file/data_file.h"
#include "granular/formats/data_file/read_data.h"
#include "granular/lines/line_columns.h"

namespace granular
{
namespace
{
Offer offer_data(const RunPlace& place, Progress& progress)
{
  Notices notices; // are given when the frame is read
  const FramePiece piece = place.index.first_piece(place.frame);
  const auto source = open_indexed(piece.file);
  const auto layout = find_data_layout(piece.file, *source, progress);
  const DataColumns columns =
    find_data_columns(*layout, place.options.atom_style, piece.file.path, notices);
  Offer offer;
  offer.tables[0] = arrays_of(make_particle_schema(columns), known_columns());
  offer.tables[1] = arrays_of(make_data_bond_schema(), local_known_columns());
  return offer;
}

Tables read_data_frame(const RunPlace& place, const Request& request, const Offer&,
  Communicator& ranks, Notices& notices, Progress& progress)
{
  const DataOptions options = { place.options.atom_style, place.options.boundary };
  return read_data(
    place.index.first_piece(place.frame), options, request, ranks, notices, progress);
}
}

constinit const Kind data_file_kind = { .number = 3,
  .rows = RowKind::Particles,
  .is_file = is_data_file,
  .format = data_file_format,
  .columns = known_columns,
  .has_bonds = true,
  .has_parts = true,
  .looked_at = first_and_last,
  .offer = offer_data,
  .read = read_data_frame };
}
