// SPDX-License-Identifier: BSD-3-Clause
// The ways from files of each kind to frames.
#include "run.h"

#include "granular/common/words.h"
#include "granular/data_file/data_file.h"
#include "granular/data_file/read_data.h"
#include "granular/decomposition/decomposition_file.h"
#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"
#include "granular/euler/euler_file.h"
#include "granular/local/local_columns.h"
#include "granular/local/local_file.h"
#include "granular/local/local_reader.h"
#include "granular/restart/restart_file.h"
#include "granular/restart/restart_reader.h"

#include <algorithm>
#include <string>
#include <utility>

namespace granular_c
{
using namespace granular;

namespace
{
std::vector<OfferedArray> arrays_of(const ColumnSchema& schema, std::span<const KnownColumn> table)
{
  std::vector<OfferedArray> arrays;
  for (const ArrayInfo& array : schema.arrays())
  {
    arrays.push_back({ array.name, array.type, array.components(), !array.position_form,
      find_known(array.name, table) });
  }
  return arrays;
}

/// True for arrays that the caller wants, as the core asks.
std::function<bool(const ArrayInfo&)> wanted_arrays(const Wanted& wanted)
{
  return [&wanted](const ArrayInfo& array)
  { return wanted.is_wanted(array.name, !array.position_form); };
}

std::function<bool(std::string_view)> wanted_names(const Wanted& wanted)
{
  return [&wanted](std::string_view name) { return wanted.is_wanted(name, !is_end_array(name)); };
}

DumpRequest dump_request(const Wanted& wanted)
{
  const granular_request& given = wanted.request;
  DumpRequest request;
  request.coordinates = static_cast<Coordinates>(given.coordinates);
  request.points = given.points != 0 && (wanted.all || wanted.is_wanted(points_name, true));
  request.single_precision = given.single_precision != 0;
  std::copy_n(given.origin, 3, request.point_origin.begin());
  request.sort_by_id = given.sort_by_id != 0;
  request.stride = given.stride;
  std::copy_n(given.region, 6, request.region.begin());
  request.wanted = wanted_arrays(wanted);
  request.threads = wanted.threads;
  return request;
}

LineRequest line_request(const Wanted& wanted)
{
  LineRequest lines;
  std::copy_n(wanted.request.origin, 3, lines.point_origin.begin());
  lines.threads = wanted.threads;
  return lines;
}

// ---- particles of dumps ------------------------------------------------------------------------
std::vector<OfferedArray> dump_arrays(granular_run& run, std::size_t frame, int)
{
  return arrays_of(run.index.first_piece(frame).entry.kind->schema, known_columns());
}

void read_dump_frame(granular_run& run, std::size_t frame, const Wanted& wanted, Notices& notices,
  Progress& progress, granular_frame& to)
{
  DumpRequest request = dump_request(wanted);
  request.pool = run.pool;
  run.pool->next_frame();
  take_rows(to, read_dump(run.index.pieces(frame), request, notices, progress), known_columns());
  to.origin = request.point_origin;
}

// ---- contacts and bonds ------------------------------------------------------------------------
std::vector<std::string> find_meaning(
  granular_run& run, std::size_t frame, Notices& notices, Progress& progress)
{
  const FramePiece piece = run.index.first_piece(frame);
  const FrameKind& kind = *piece.entry.kind;
  std::vector<std::string> columns;
  for (const ColumnInfo& column : kind.schema.columns())
  {
    columns.push_back(column.name);
  }
  if (!run.column_map.empty())
  {
    return name_columns(columns, run.column_map);
  }
  if (run.preset == "AsNamed")
  {
    return name_columns(columns);
  }
  if (!run.preset.empty() && run.preset != "Automatic")
  {
    const auto preset = std::ranges::find(local_presets(), run.preset, &LocalPreset::name);
    if (preset == local_presets().end())
    {
      throw BadArgument("expected a preset of Automatic, AsNamed, " +
        join_words(local_presets(), ", ", &LocalPreset::name) + ", got '" + run.preset + "'");
    }
    return name_columns(columns, *preset);
  }
  const LocalSample sample =
    say_what_they_are(columns) ? LocalSample() : read_sample(run.index, kind, progress);
  return find_columns(columns, sample, where_of(piece), notices);
}

std::vector<OfferedArray> local_arrays(granular_run& run, std::size_t frame, int)
{
  Notices notices; // are given when the frame is read
  Progress progress;
  std::vector<OfferedArray> arrays = arrays_of(
    make_local_schema(find_meaning(run, frame, notices, progress)), local_known_columns());
  for (OfferedArray& array : arrays)
  {
    array.is_usual = array.is_usual && !is_end_array(array.name);
  }
  return arrays;
}

void read_local_frame(granular_run& run, std::size_t frame, const Wanted& wanted, Notices& notices,
  Progress& progress, granular_frame& to)
{
  LocalRequest request;
  request.columns = find_meaning(run, frame, notices, progress);
  request.wanted = wanted_names(wanted);
  request.lines = line_request(wanted);
  SerialCommunicator alone;
  take_lines(to, read_local(run.index.pieces(frame), request, alone, notices, progress));
  to.origin = request.lines.point_origin;
}

// ---- restart files -----------------------------------------------------------------------------
std::vector<OfferedArray> restart_arrays(granular_run& run, std::size_t frame, int table)
{
  Notices notices;
  Progress progress;
  const FileIndex& file = run.index.first_piece(frame).file;
  const auto source = open_indexed(file);
  const auto layout = find_restart_layout(file, *source, notices, progress);
  const RestartColumns columns = find_restart_columns(*source, *layout, notices, progress);
  if (table == 0)
  {
    return arrays_of(ColumnSchema(columns.particles), known_columns());
  }
  return columns.has_bonds
    ? arrays_of(make_bond_schema(automatic_history, layout->header.version, columns.history_values),
        local_known_columns())
    : std::vector<OfferedArray>();
}

void read_restart_frame(granular_run& run, std::size_t frame, const Wanted& wanted,
  Notices& notices, Progress& progress, granular_frame& to)
{
  const FileIndex& file = run.index.first_piece(frame).file;
  const auto source = open_indexed(file);
  const auto layout = find_restart_layout(file, *source, notices, progress);
  RestartRequest request;
  request.bonds = wanted.request.table == 1;
  const auto nothing = [](std::string_view) { return false; };
  const auto named = [&wanted](std::string_view name) { return wanted.is_wanted(name, true); };
  request.wanted = request.bonds ? std::function<bool(std::string_view)>(nothing) : named;
  request.wanted_bonds = named;
  request.lines = line_request(wanted);
  RestartFrame read = read_restart(*source, *layout, request, notices, progress);
  if (request.bonds)
  {
    take_lines(to, std::move(read.bonds));
  }
  else
  {
    take_rows(to, std::move(read.particles), known_columns());
  }
  to.origin = request.lines.point_origin;
}

// ---- data files --------------------------------------------------------------------------------
std::vector<OfferedArray> data_arrays(granular_run& run, std::size_t frame, int table)
{
  if (table == 1)
  {
    return arrays_of(make_data_bond_schema(), local_known_columns());
  }
  Notices notices;
  Progress progress;
  const FramePiece piece = run.index.first_piece(frame);
  const auto source = open_indexed(piece.file);
  return arrays_of(
    make_particle_schema(find_data_columns(
      *find_data_layout(piece.file, *source, progress), run.atom_style, piece.file.path, notices)),
    known_columns());
}

void read_data_frame(granular_run& run, std::size_t frame, const Wanted& wanted, Notices& notices,
  Progress& progress, granular_frame& to)
{
  DataRequest request;
  request.particles = dump_request(wanted);
  request.particles.single_precision = false;
  const bool points = std::exchange(request.particles.points, true); // bonds end there
  request.atom_style = run.atom_style;
  if (wanted.request.table == 1)
  {
    request.particles.wanted = [](const ArrayInfo&) { return false; };
    request.wanted_bonds = [&wanted](std::string_view name)
    { return wanted.is_wanted(name, true); };
  }
  SerialCommunicator alone;
  DataFrame read = read_data(run.index.first_piece(frame), request, alone, notices, progress);
  if (wanted.request.table == 1)
  {
    take_lines(to, std::move(read.bonds));
  }
  else
  {
    if (!points)
    {
      read.particles.points = {};
    }
    take_rows(to, std::move(read.particles), known_columns());
  }
  to.origin = request.particles.point_origin;
}

// ---- cells -------------------------------------------------------------------------------------
/// Units and meanings of what EulerAverage and LIGGGHTS write.
constexpr KnownColumn cell_columns[] = {
  { "x", ValueType::Float64, ColumnRole::Position, points_name, 0, 3, "m", "centre of the cell" },
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

std::vector<OfferedArray> euler_frame_arrays(granular_run& run, std::size_t frame, int)
{
  Progress progress;
  const FramePiece piece = run.index.first_piece(frame);
  std::vector<OfferedArray> arrays;
  for (const std::string& name :
    euler_array_names(*open_indexed(piece.file), piece.entry, progress))
  {
    arrays.push_back({ name, ValueType::Float64, components_of(name), true,
      find_known_column(name, cell_columns) });
  }
  return arrays;
}

void read_euler_frame(granular_run& run, std::size_t frame, const Wanted& wanted, Notices& notices,
  Progress& progress, granular_frame& to)
{
  EulerFrame cells =
    read_euler_pieces(run.index.pieces(frame), wanted_names(wanted), notices, progress);
  for (std::size_t i = 0; i < cells.centres.size(); ++i)
  {
    cells.centres[i] -= wanted.request.origin[i % 3];
  }
  to.kind = RowKind::Cells;
  to.header.timestep = run.index.first_piece(frame).entry.timestep;
  to.header.has_box = false;
  to.rows = cells.cells;
  std::copy_n(wanted.request.origin, 3, to.origin.begin());
  if (wanted.request.points != 0 && (wanted.all || wanted.is_wanted(points_name, true)))
  {
    add_array(to, points_name, ValueType::Float64, 3, std::move(cells.centres), cell_columns);
  }
  for (EulerValues& array : cells.arrays)
  {
    add_array(to, array.name, ValueType::Float64, array.components, std::move(array.values),
      find_known_column(array.name, cell_columns));
  }
}

// ---- subdomains --------------------------------------------------------------------------------
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

std::vector<OfferedArray> subdomain_arrays(granular_run& run, std::size_t frame, int)
{
  Notices notices;
  Progress progress;
  const Decomposition all = read_decomposition_pieces(run.index.pieces(frame), notices, progress);
  std::vector<OfferedArray> arrays;
  for (const KnownColumn& known : subdomain_columns)
  {
    if (has_array(all, known.name))
    {
      arrays.push_back({ std::string(known.name), known.type, known.components, true, &known });
    }
  }
  return arrays;
}

void read_decomposition_frame(granular_run& run, std::size_t frame, const Wanted& wanted,
  Notices& notices, Progress& progress, granular_frame& to)
{
  const std::vector<FramePiece> pieces = run.index.pieces(frame);
  const Decomposition all = read_decomposition_pieces(pieces, notices, progress);
  const Subdomain bounds = bounds_of(all.subdomains);
  to.kind = RowKind::Subdomains;
  to.header.timestep = pieces.front().entry.timestep;
  to.header.box = Box::from_bounds(bounds.lo, bounds.hi);
  to.header.box.boundary = "ff ff ff";
  to.rows = static_cast<std::int64_t>(all.subdomains.size());
  std::vector<double> lo;
  std::vector<double> hi;
  std::vector<std::int64_t> particles;
  std::vector<std::int64_t> ranks;
  for (const Subdomain& each : all.subdomains)
  {
    lo.insert(lo.end(), each.lo.begin(), each.lo.end());
    hi.insert(hi.end(), each.hi.begin(), each.hi.end());
    particles.push_back(each.particles);
    ranks.push_back(each.rank);
  }
  const auto add = [&](const KnownColumn& known, auto& values)
  {
    if (has_array(all, known.name) && wanted.is_wanted(known.name, true))
    {
      add_array(
        to, std::string(known.name), known.type, known.components, std::move(values), &known);
    }
  };
  add(subdomain_columns[0], lo);
  add(subdomain_columns[1], hi);
  add(subdomain_columns[2], particles);
  add(subdomain_columns[3], ranks);
}
}

std::span<const Kind> kinds()
{
  static constexpr Kind all[] = {
    { GRANULAR_KIND_DUMP, is_dump_file, dump_format, false, true, true, dump_arrays,
      read_dump_frame },
    { GRANULAR_KIND_LOCAL, is_local_file, local_format, false, true, false, local_arrays,
      read_local_frame },
    { GRANULAR_KIND_RESTART, is_restart_file, restart_format, true, false, false, restart_arrays,
      read_restart_frame },
    { GRANULAR_KIND_DATA_FILE, is_data_file, data_file_format, true, false, true, data_arrays,
      read_data_frame },
    { GRANULAR_KIND_DECOMPOSITION, is_decomposition_file, decomposition_format, false, true, false,
      subdomain_arrays, read_decomposition_frame },
    { GRANULAR_KIND_EULER, is_euler_file, euler_format, false, true, false, euler_frame_arrays,
      read_euler_frame },
  };
  return all;
}
}
