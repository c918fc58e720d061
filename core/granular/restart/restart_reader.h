// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_restart_reader_h
#define granular_restart_restart_reader_h

#include "granular/local/local_reader.h"
#include "granular/restart/history_layout.h"
#include "granular/restart/restart_layout.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// What a restart file holds of each particle, and of each bond.
struct RestartColumns
{
  std::vector<std::string>
    particles; ///< as a dump names them: id type mask x y z ix iy iz vx vy vz, ...; those of fixes f_ID[1], ...
  bool has_bonds = false;
  std::int64_t history_values = 0; ///< n_h
};

/// Looks at the styles and the first records. Throws FormatError.
RestartColumns find_restart_columns(
  const ByteSource& source, const RestartLayout& layout, Notices& notices, Progress& progress);

/// The arrays of bonds: id1 id2 btype and the history, see history_columns.
ColumnSchema make_bond_schema(
  int history_layout, std::string_view version, std::int64_t history_values);

/// What of a restart file is wanted.
struct RestartRequest
{
  std::function<bool(std::string_view name)> wanted;       ///< arrays of particles; empty: all
  std::function<bool(std::string_view name)> wanted_bonds; ///< arrays of bonds; empty: all
  bool bonds = true;
  int history_layout = automatic_history;
  LineRequest lines; ///< also what says how many threads there are, and where the memory comes from
  int piece =
    0; ///< the part of the records that is wanted, of `pieces` in all; a bond is where its first particle is
  int pieces = 1;
};

/// A decoded restart file.
struct RestartFrame
{
  DumpFrame particles; ///< in the order of the file, with points; header.rows are all of the file
  LocalFrame
    bonds; ///< each once, with lines, in the order of the file; has_lines: the styles have bonds, which were wanted
};

/// Decodes the particles of a restart file in full precision, and its bonds.
///
/// A bond that both particles hold is one: that of the particle with the lower id, with its history, whatever the sign of the
/// other copy. One that only one of them holds is that one. Where several are held between two particles each is one: as many as
/// that particle holds which holds more. Where newton_bond says that bonds are stored once every copy is one. Bonds of which a
/// particle is not in the file have no line and no row; these, bonds of a particle to itself and copies whose history is
/// not the same, but for the sign and rounding to 1e-6, are counted in notices, those of the whole file, whatever the piece.
///
/// Reads the records once, on several threads. Throws FormatError that names the record (from 1), the particle's id where it is known,
/// and the byte; IoError; Cancelled; std::bad_alloc.
RestartFrame read_restart(const ByteSource& source, const RestartLayout& layout,
  const RestartRequest& request, Notices& notices, Progress& progress);
}
#endif
