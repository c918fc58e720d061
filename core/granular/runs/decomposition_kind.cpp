// SPDX-License-Identifier: BSD-3-Clause
// Subdomains of ranks.
#include "granular/runs/kind.h"

#include "granular/formats/decomposition/decomposition_file.h"

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace granular
{
namespace
{
constexpr KnownColumn subdomain_columns[] = {
  { "lo", ValueType::Float64, ColumnRole::Other, "", 0, 3, "m", "lower corner" },
  { "hi", ValueType::Float64, ColumnRole::Other, "", 0, 3, "m", "upper corner" },
  { "nlocal", ValueType::Int64, ColumnRole::Other, "", 0, 1, "-", "number of particles" },
  { "proc", ValueType::Int64, ColumnRole::Other, "", 0, 1, "-", "rank that owns the subdomain" },
};

/// Returns true if a file, whose data alone say it, has an array.
bool has_array(const Decomposition& all, std::string_view name)
{
  return (name != "nlocal" || all.has_particles) && (name != "proc" || all.has_ranks);
}

Offer offer_subdomains(const RunPlace& place, Progress& progress)
{
  Notices notices; // are given when the frame is read
  const Decomposition all =
    read_decomposition_pieces(place.index.pieces(place.frame), notices, progress);
  Offer offer;
  for (const KnownColumn& known : subdomain_columns)
  {
    if (has_array(all, known.name))
    {
      offer.tables[0].push_back(
        { std::string(known.name), known.type, known.components, true, &known });
    }
  }
  return offer;
}

Tables read_subdomains(const RunPlace& place, const Request& request, const Offer&, Communicator&,
  Notices& notices, Progress& progress)
{
  const std::vector<FramePiece> pieces = place.index.pieces(place.frame);
  const Decomposition all = read_decomposition_pieces(pieces, notices, progress);
  const Subdomain bounds = bounds_of(all.subdomains);
  Tables frame;
  Table& table = frame.rows;
  table.header.timestep = pieces.front().entry.timestep;
  table.header.box = Box::from_bounds(bounds.lo, bounds.hi);
  table.header.box.boundary = "ff ff ff";
  table.rows = static_cast<std::int64_t>(all.subdomains.size());
  const auto add = [&](const KnownColumn& known, const auto& value_of)
  {
    if (!has_array(all, known.name) || !is_wanted(request.wanted, known.name))
    {
      return;
    }
    std::vector<std::remove_cvref_t<decltype(value_of(all.subdomains[0], 0))>> values;
    for (const Subdomain& each : all.subdomains)
    {
      for (std::size_t i = 0; i < static_cast<std::size_t>(known.components); ++i)
      {
        values.push_back(value_of(each, i));
      }
    }
    add_array(table, known.name, known.type, known.components, block_of(values));
  };
  add(subdomain_columns[0], [](const Subdomain& each, std::size_t i) { return each.lo[i]; });
  add(subdomain_columns[1], [](const Subdomain& each, std::size_t i) { return each.hi[i]; });
  add(subdomain_columns[2], [](const Subdomain& each, std::size_t) { return each.particles; });
  add(subdomain_columns[3],
    [](const Subdomain& each, std::size_t) { return std::int64_t{ each.rank }; });
  return frame;
}
}

constinit const Kind decomposition_kind = { .number = 5,
  .rows = RowKind::Subdomains,
  .is_file = is_decomposition_file,
  .format = decomposition_format,
  .columns = []() noexcept -> std::span<const KnownColumn> { return subdomain_columns; },
  .has_pieces = true,
  .looked_at = [](const RunIndex&) { return std::vector<std::size_t>(); },
  .offer = offer_subdomains,
  .read = read_subdomains };
}
