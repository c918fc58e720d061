// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_runs_kind_h
#define granular_runs_kind_h

#include "granular/columns/column.h"
#include "granular/common/archive.h"
#include "granular/common/error.h"
#include "granular/common/pass.h"
#include "granular/common/progress.h"
#include "granular/formats/restart/restart_reader.h"
#include "granular/frames/file_format.h"
#include "granular/frames/run_index.h"
#include "granular/grid/cells.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/request.h"
#include "granular/particles/table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Options by which the files of a run are understood. Each is for the kinds that its comment names.
struct RunOptions
{
  RepeatedSteps repeated_steps = RepeatedSteps::Auto; ///< where several files may hold one frame
  std::string
    column_names;     ///< dumps: columns of files that do not name them; blanks or commas between
  std::string preset; ///< local: of local_presets, AsNamed, or Automatic as when it is empty
  std::string column_map;                 ///< local: see name_columns; of dumps as column_names
  std::string atom_style;                 ///< data files: see find_data_columns
  std::string boundary;                   ///< data files: see DataOptions
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
void pass_form(ArchiveWriter& archive, const Request& request, const RunOptions& options);

/// The kind of rows of a table, which decides how they are written.
enum class RowKind : std::uint8_t
{
  Particles,
  Lines, ///< contacts and bonds
  Cells,
  Subdomains
};

/// An array that a frame has in its files.
struct OfferedArray
{
  std::string name;
  ValueType type = ValueType::Float64; ///< as far as known before the rows are read
  int components = 1;
  bool is_usual =
    true; ///< false: read only if asked for by name, such as coordinates that make the points
  const KnownColumn* known =
    nullptr;                ///< its unit and meaning; null: not known, or told by another rank
  std::string columns = {}; ///< that make it: see ColumnSchema::text
};

template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<OfferedArray>& array)
{
  archive.text(array.name);
  archive.number(array.type);
  archive.number(array.components);
  archive.number(array.is_usual);
  archive.text(array.columns);
}

/// All that the files of a frame tell before its rows are read.
struct Offer
{
  std::array<std::vector<OfferedArray>, 2> tables = {}; ///< the arrays of each
  std::vector<std::string> columns = {}; ///< of local data: their meaning, see find_columns
  std::string error = {};                ///< why the meaning cannot be known; empty: it is
  Where where = {};                      ///< of the error
  Notices notices = {};   ///< for whoever reads a frame of these columns; they name the first asked
  bool has_points = true; ///< false: no columns give positions
};

template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<Offer>& offer)
{
  for (auto& table : offer.tables)
  {
    pass(archive, table);
  }
  pass(archive, offer.columns);
  archive.text(offer.error);
  pass(archive, offer.where);
  pass(archive, offer.notices);
  archive.number(offer.has_points);
}

/// A frame of a run, and how its files are understood.
struct RunPlace
{
  const struct Kind& kind;
  const RunIndex& index;
  std::size_t frame;
  const RunOptions& options;
};

/// A kind of files: how they are told from others, and how their frames are read.
struct Kind
{
  int number;   ///< in granular_kind of C
  RowKind rows; ///< of table 0
  bool (*is_file)(const std::string& path) noexcept;
  const FileFormat& (*format)() noexcept;
  std::span<const KnownColumn> (*columns)() noexcept; ///< units and meanings in table 0
  bool tells_by_columns = false; ///< frames with the same columns have the same arrays
  bool has_bonds = false;        ///< in table 1
  bool has_pieces = false;       ///< several files may hold one frame
  bool has_parts = false;        ///< stride, region, coordinates and order can be chosen

  /// Returns the frames whose arrays are together those of all frames, or of nearly all.
  std::vector<std::size_t> (*looked_at)(const RunIndex& index);

  /// Returns what the files tell of a frame. Throws Error; Cancelled.
  Offer (*offer)(const RunPlace& place, Progress& progress);

  /// Reads a frame. `offer` is needed for local data alone. Collective.
  Tables (*read)(const RunPlace& place, const Request& request, const Offer& offer,
    Communicator& ranks, Notices& notices, Progress& progress);

  /// Reads the cells of a frame, for kinds that have cells.
  EulerFrame (*cells)(const std::vector<FramePiece>& pieces,
    const std::function<bool(std::string_view)>& wanted, int threads, Notices& notices,
    Progress& progress) = nullptr;
};

/// The kinds, each in a file of its own.
extern const Kind dump_kind;
extern const Kind local_kind;
extern const Kind restart_kind;
extern const Kind data_file_kind;
extern const Kind decomposition_kind;
extern const Kind euler_kind;
extern const Kind grid_kind;

/// Returns all kinds, in the order in which they are asked whether a file is theirs.
std::span<const Kind* const> kinds() noexcept;

/// Returns the kind of a file by its contents, or null. A file without a header is local data if a column map names lines.
const Kind* find_kind(const std::string& path, const std::string& column_map = {});

/// Returns the kind with a number. Throws ArgumentError.
const Kind& kind_of_number(std::int64_t number);

/// Returns the kind that the first rank finds. Collective.
const Kind& kind_of_first(Communicator& ranks, const std::function<const Kind&()>& find);

// ---- what several kinds need ----------------------------------------------------------------------
/// Returns frames for Kind::looked_at: one for each list of columns, or those between which bonds may have come.
std::vector<std::size_t> one_for_columns(const RunIndex& index);
std::vector<std::size_t> first_and_last(const RunIndex& index);

/// Returns the row of a table of columns that knows an array by its name or by that of a column in it, or null.
const KnownColumn* find_known(std::string_view array, std::span<const KnownColumn> table) noexcept;

/// Returns the arrays that columns make; the table knows their units.
std::vector<OfferedArray> arrays_of(const ColumnSchema& schema, std::span<const KnownColumn> table);

/// Reads cells as a table: Kind::read for kinds that have cells.
Tables read_cells(const RunPlace& place, const Request& request, const Offer& offer,
  Communicator& ranks, Notices& notices, Progress& progress);
}
#endif
