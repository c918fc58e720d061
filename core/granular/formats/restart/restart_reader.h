// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_restart_reader_h
#define granular_formats_restart_restart_reader_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/formats/restart/restart_layout.h"
#include "granular/particles/request.h"
#include "granular/particles/table.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The columns of each particle and bond in a restart file.
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

/// Layouts of the history values of a bond have numbers: 2: WITH-BONDS (12 values), 3: PFM (13), 4: Flexible_Fibers until 2021
/// (13), 5: Flexible_Fibers and SEAICE (14).
///
/// Instead of a number: the layout with as many values, of two that whose word is in the version, else the last.
inline constexpr int automatic_history = 0;
/// Instead of a number: history1, history2, ...
inline constexpr int numbered_history = 1;

/// Returns the arrays of bonds: id1 id2 btype and the history, which is numbered where the layout has another number of values.
/// version: of the program, from the file's header.
ColumnSchema make_bond_schema(
  int history_layout, std::string_view version, std::int64_t history_values);

/// Decodes the particles of a restart file in full precision, and its bonds, both in the order of the file; Tables::bonds has lines if
/// the styles have bonds, which were wanted, and Tables::groups stays empty. history_layout: see make_bond_schema. A piece has part of the
/// records, and bonds are with their first particle; headers count the rows of all.
///
/// A bond that both particles hold becomes one: the copy of the particle with the lower id, with its history, whatever the
/// sign of the other copy. A bond that only one particle holds becomes one, too. Several bonds between two particles remain
/// several: as many as the particle with more of them holds. If newton_bond says that bonds are stored once, every copy is a
/// bond. Bonds without one of their particles in the file have no line and no row. Notices count these, bonds of a particle
/// with itself, and copies whose histories differ by more than the sign and rounding to 1e-6, over the whole file in any
/// piece.
///
/// Reads the records once, on several threads. Throws FormatError that names the record (from 1), the particle's id if known,
/// and the byte; IoError; Cancelled; std::bad_alloc.
Tables read_restart(const ByteSource& source, const RestartLayout& layout, int history_layout,
  const Request& request, Notices& notices, Progress& progress);
}
#endif
