// SPDX-License-Identifier: BSD-3-Clause
// Averaged cells.
#include "granular/runs/kind.h"

#include "granular/formats/euler/euler_file.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
namespace
{
/// Units and meanings of what EulerAverage and LIGGGHTS write.
constexpr KnownColumn cell_columns[] = {
  { "x", ValueType::Float64, ColumnRole::Position, "points", 0, 3, "m", "centre of the cell" },
  { "v_avg", ValueType::Float64, ColumnRole::Other, "", 0, 3, "m/s",
    "mean velocity, weighted by mass" },
  { "volumefraction", ValueType::Float64, ColumnRole::Other, "", 0, 1, "-",
    "volume of the particles divided by that of the cell" },
  { "radius", ValueType::Float64, ColumnRole::Other, "", 0, 1, "m", "mean radius" },
  { "pressure", ValueType::Float64, ColumnRole::Other, "", 0, 1, "Pa",
    "pressure, positive in compression" },
  { "sigma", ValueType::Float64, ColumnRole::Other, "", 0, 3, "Pa", "stresses xx yy zz" },
  { "tau", ValueType::Float64, ColumnRole::Other, "", 0, 3, "Pa", "stresses xy xz yz" },
};

int components_of(std::string_view name)
{
  const KnownColumn* known = find_known_column(name, cell_columns);
  return known == nullptr ? 1 : known->components;
}

Offer offer_cells(const RunPlace& place, Progress& progress)
{
  const std::vector<FramePiece> pieces = place.index.pieces(place.frame);
  const auto filled =
    std::ranges::find_if(pieces, [](const FramePiece& piece) { return piece.entry.rows > 0; });
  const FramePiece& piece = filled == pieces.end() ? pieces.front() : *filled;
  Offer offer;
  for (const std::string& name :
    euler_array_names(*open_indexed(piece.file), piece.entry, progress))
  {
    offer.tables[0].push_back({ name, ValueType::Float64, components_of(name), true,
      find_known_column(name, cell_columns) });
  }
  return offer;
}

std::vector<std::size_t> first_with_rows(const RunIndex& index)
{
  std::size_t frame = 0;
  while (frame + 1 < index.size() && index.first_piece(frame).entry.rows == 0)
  {
    ++frame;
  }
  return { frame };
}
}

constinit const Kind euler_kind = { .number = 4,
  .rows = RowKind::Cells,
  .is_file = is_euler_file,
  .format = euler_format,
  .columns = []() noexcept -> std::span<const KnownColumn> { return cell_columns; },
  .has_pieces = true,
  .looked_at = first_with_rows,
  .offer = offer_cells,
  .read = read_cells,
  .cells = read_euler_pieces };
}
