// SPDX-License-Identifier: BSD-3-Clause
// Restart files: particles and bonds.
#include "granular/runs/kind.h"

#include "granular/formats/restart/restart_file.h"
#include "granular/formats/restart/restart_reader.h"
#include "granular/lines/line_columns.h"

#include <memory>

namespace granular
{
namespace
{
/// A file, and where things are in it.
struct OpenRestart
{
  OpenRestart(const RunPlace& place, Notices& notices, Progress& progress)
  {
    const FileIndex& file = place.index.first_piece(place.frame).file;
    source = open_indexed(file);
    layout = find_restart_layout(file, *source, notices, progress);
  }

  std::shared_ptr<const ByteSource> source;
  std::shared_ptr<const RestartLayout> layout;
};

Offer offer_restart(const RunPlace& place, Progress& progress)
{
  Notices notices; // are given when the frame is read
  const OpenRestart file(place, notices, progress);
  const RestartColumns columns =
    find_restart_columns(*file.source, *file.layout, notices, progress);
  Offer offer;
  offer.tables[0] = arrays_of(ColumnSchema(columns.particles), known_columns());
  if (columns.has_bonds)
  {
    offer.tables[1] = arrays_of(make_bond_schema(place.options.history_layout,
                                  file.layout->header.version, columns.history_values),
      local_known_columns());
  }
  return offer;
}

Tables read_restart_frame(const RunPlace& place, const Request& request, const Offer&,
  Communicator&, Notices& notices, Progress& progress)
{
  PartialProgress part(progress);
  part.set_part(0, 0.1);
  const OpenRestart file(place, notices, part);
  part.set_part(0.1, 1);
  Tables frame =
    read_restart(*file.source, *file.layout, place.options.history_layout, request, notices, part);
  frame.groups = file.layout->groups;
  return frame;
}
}

constinit const Kind restart_kind = { .number = 2,
  .rows = RowKind::Particles,
  .is_file = is_restart_file,
  .format = restart_format,
  .columns = known_columns,
  .has_bonds = true,
  .looked_at = first_and_last,
  .offer = offer_restart,
  .read = read_restart_frame };
}
