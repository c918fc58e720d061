// SPDX-License-Identifier: BSD-3-Clause
// Dumps of local data: contacts and bonds.
#include "granular/runs/kind.h"

#include "granular/common/words.h"
#include "granular/formats/local/local_file.h"
#include "granular/formats/local/local_reader.h"
#include "granular/lines/line_columns.h"

#include <algorithm>
#include <string>
#include <vector>

namespace granular
{
namespace
{
std::vector<std::string> find_meaning(const RunPlace& place,
  const std::vector<std::string>& columns, const Where& where, Notices& notices, Progress& progress)
{
  const std::string& asked = place.options.preset;
  const std::string& map = place.options.column_map;
  const FrameKind& kind = *place.index.first_piece(place.frame).entry.kind;
  if (!map.empty())
  {
    std::vector<std::string> names = name_columns(columns, map);
    if (map.find("history") != map.npos)
    {
      check_history(columns, names, read_sample(place.index, kind, progress));
    }
    return names;
  }
  if (asked == "AsNamed")
  {
    return name_columns(columns);
  }
  if (!asked.empty() && asked != "Automatic")
  {
    const auto preset = std::ranges::find(local_presets(), asked, &LocalPreset::name);
    if (preset == local_presets().end())
    {
      throw ArgumentError("expected a preset of Automatic, AsNamed, " +
        join_words(local_presets(), ", ", &LocalPreset::name) + ", got '" + asked + "'");
    }
    return name_columns(columns, *preset);
  }
  const LocalSample sample =
    say_what_they_are(columns) ? LocalSample() : read_sample(place.index, kind, progress);
  return find_columns(columns, sample, where, notices);
}

/// An error of the meaning is kept: which arrays there are can be told all the same.
Offer offer_local(const RunPlace& place, Progress& progress)
{
  const FramePiece piece = place.index.first_piece(place.frame);
  std::vector<std::string> columns;
  for (const ColumnInfo& column : piece.entry.kind->schema.columns())
  {
    columns.push_back(column.name);
  }
  Offer offer;
  offer.where = where_of(piece);
  try
  {
    offer.columns = find_meaning(place, columns, offer.where, offer.notices, progress);
  }
  catch (const FormatError& error)
  {
    offer.error = error.text();
    offer.where = error.where().path.empty() ? offer.where : error.where();
    offer.columns = name_columns(columns);
  }
  offer.tables[0] = arrays_of(make_local_schema(offer.columns), local_known_columns());
  for (OfferedArray& array : offer.tables[0])
  {
    array.is_usual = array.is_usual && !is_end_array(array.name);
  }
  return offer;
}

Tables read_local_frame(const RunPlace& place, const Request& request, const Offer& offer,
  Communicator& ranks, Notices& notices, Progress& progress)
{
  return { .rows = read_local(
             place.index.pieces(place.frame), offer.columns, request, ranks, notices, progress) };
}
}

constinit const Kind local_kind = { .number = 1,
  .rows = RowKind::Lines,
  .is_file = is_local_file,
  .format = local_format,
  .columns = local_known_columns,
  .tells_by_columns = true,
  .has_pieces = true,
  .looked_at = one_for_columns,
  .offer = offer_local,
  .read = read_local_frame };
}
