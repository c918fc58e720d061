// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_runs_request_h
#define granular_runs_request_h

#include "granular/common/archive.h"
#include "granular/frames/run_index.h"
#include "granular/geometry/positions.h"
#include "granular/local/lines.h"
#include "granular/memory/block_pool.h"
#include "granular/restart/restart_reader.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace granular
{
/// Options by which the files of a run are understood. Each is for the kinds that its comment names.
struct RunOptions
{
  RepeatedSteps repeated_steps = RepeatedSteps::Auto; ///< where several files may hold one frame
  std::string
    column_names; ///< dumps: columns of binary files that do not name them; blanks or commas between
  std::string preset;     ///< local: of local_presets, AsNamed, or Automatic as when it is empty
  std::string column_map; ///< local: see name_columns
  std::string atom_style; ///< data files: see find_data_columns
  std::string boundary;   ///< data files: see DataRequest
  int history_layout = automatic_history; ///< restart files: see make_bond_schema
  int threads = 1;                        ///< at least 1; changes no result

  /// Returns true if the files tell the same with other options: with another number of threads.
  bool tell_the_same(RunOptions others) const
  {
    others.threads = threads;
    return *this == others;
  }

  bool operator==(const RunOptions&) const = default;
};

/// The wanted part of a frame. Coordinates, order, stride and region are for dumps and data files.
struct Request
{
  /// Returns true for a wanted array; is_usual: it is wanted unless the user chooses. Empty: usual ones.
  using Choice = std::function<bool(std::string_view name, bool is_usual)>;

  Coordinates coordinates = Coordinates::Absolute;
  bool points = true;            ///< false: no points, and coordinates are columns like others
  bool single_precision = false; ///< dumps: points as float instead of double
  Vector3 point_origin = {};     ///< subtracted from the points; finite
  bool sort_by_id = false;
  std::int64_t stride = 1;                                ///< at least 1: see DumpRequest
  std::array<double, 6> region = { 1, -1, 1, -1, 1, -1 }; ///< see DumpRequest
  PeriodicLines periodic_lines = PeriodicLines::MinimumImage;
  Choice wanted;       ///< arrays of table 0
  bool bonds = false;  ///< true: table 1 is read, too
  Choice wanted_bonds; ///< arrays of table 1
  bool ranges = false; ///< true: the ranges of points and arrays of dumps and data files are found
  int piece = 0; ///< part of the rows, of `pieces` in all. Cells and subdomains are read whole
  int pieces = 1;
  int threads = 1;                 ///< at least 1; changes no result
  std::shared_ptr<BlockPool> pool; ///< source of the memory; may be null
};

/// Writes everything in which ranks that read a frame together must agree, but for the arrays and the piece.
inline void pass_form(ArchiveWriter& archive, const Request& request, const RunOptions& options)
{
  archive.number(request.coordinates);
  archive.number(request.points);
  archive.number(request.single_precision);
  archive.number(request.point_origin);
  archive.number(request.sort_by_id);
  archive.number(request.stride);
  archive.number(request.region);
  archive.number(request.periodic_lines);
  archive.number(request.bonds);
  archive.number(request.ranges);
  archive.number(request.pieces);
  archive.text(options.preset);
  archive.text(options.column_map);
  archive.text(options.atom_style);
  archive.text(options.boundary);
  archive.number(options.history_layout);
}
}
#endif
