// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_runs_run_options_h
#define granular_runs_run_options_h

#include "granular/common/archive.h"
#include "granular/formats/restart/restart_reader.h"
#include "granular/frames/run_index.h"
#include "granular/particles/request.h"

#include <string>

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
  std::string boundary;   ///< data files: see DataOptions
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
