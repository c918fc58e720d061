// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_columns_column_h
#define granular_columns_column_h

#include "granular/common/error.h"
#include "granular/common/value_type.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The meaning of a column, where code depends on it; Other for the rest. If several columns have the same meaning, the
/// first one gets the role.
enum class ColumnRole : std::uint8_t
{
  Other,
  Id,
  Position,                ///< x: absolute, wrapped into the box
  ScaledPosition,          ///< xs: in units of the box vectors
  UnwrappedPosition,       ///< xu: absolute, as if never wrapped
  ScaledUnwrappedPosition, ///< xsu
  Image,                   ///< ix: how often the box was crossed
  Radius,
  Diameter
};

/// Returns true if the role is a coordinate of any kind.
constexpr bool is_position(ColumnRole role) noexcept
{
  return role >= ColumnRole::Position && role <= ColumnRole::ScaledUnwrappedPosition;
}

/// One row of the table of column names of LIGGGHTS and LAMMPS.
struct KnownColumn
{
  std::string_view name; ///< as printed; a trailing '*' stands for any rest
  ValueType type;
  ColumnRole role;
  std::string_view array; ///< name of the array it becomes part of; empty: its own name
  int component;          ///< index in that array
  int components;         ///< of that array
  std::string_view unit; ///< SI unit under `units si`; "-" dimensionless, "" as the user defined it
  std::string_view meaning;
};

/// Returns the table of known columns. Readers, writers, documentation and tests take names, types and meanings from
/// it.
std::span<const KnownColumn> known_columns() noexcept;

/// Returns the row of a table for a name, or null.
const KnownColumn* find_known_column(
  std::string_view name, std::span<const KnownColumn> table = known_columns()) noexcept;

/// The most columns of a frame that are read or written.
inline constexpr int most_columns = 5000;

/// Throws LimitError for more than most_columns.
void check_column_count(std::size_t columns, const Where& where = {});

/// One column of a file.
struct ColumnInfo
{
  std::string name; ///< as the file spells it; not unique
  ValueType type = ValueType::Float64;
  ColumnRole role = ColumnRole::Other;
  int component = 0; ///< axis of a position or image; end of a line
  bool known = false;
  bool may_be_words =
    true;            ///< Text where the first row of a text has a word: unknown columns, and type
  bool open = false; ///< holds what the user decides: integers that no double holds make it Int64
};

/// One array made from columns: a scalar, or a vector of several columns.
struct ArrayInfo
{
  std::string name; ///< unique in its schema
  ValueType type = ValueType::Float64;
  ColumnRole role = ColumnRole::Other;
  std::vector<int> columns;   ///< column of each component
  double scale = 1;           ///< radius made from a diameter: 0.5
  bool position_form = false; ///< a coordinate column: not loaded as an array unless asked for
  std::string
    group = {}; ///< the array of several columns that this would be part of if none of them held texts

  int components() const noexcept { return static_cast<int>(columns.size()); }
};

/// The ordered columns of a frame, and the arrays made from them:
/// - columns of the table join the vectors that the table names, if all components are present;
/// - c_ID[1] .. c_ID[n] (also f_, v_, i2_, d2_, and from 0 on), n >= 2, complete and in this order in the file, become one
///   array c_ID of n components, in the file's order (tensors are not reordered);
/// - a text column is always an array of its own, and so are then the other columns of its vector;
/// - every other column becomes an array under its own name;
/// - a name that is taken gets "_2", "_3", ...;
/// - `radius` is computed from `diameter` if the file has only the diameter.
class ColumnSchema
{
public:
  /// A new type for a column.
  struct TypeChange
  {
    int column;
    ValueType type;
  };

  ColumnSchema() = default;

  /// Makes the schema of named columns. The table must outlive the schema and its copies. Throws
  /// LimitError, with the place of the names, for more than most_columns.
  explicit ColumnSchema(const std::vector<std::string>& names,
    std::span<const KnownColumn> table = known_columns(), const Where& where = {});

  const std::vector<ColumnInfo>& columns() const noexcept { return columns_; }
  const std::vector<ArrayInfo>& arrays() const noexcept { return arrays_; }

  /// Returns the first column with this role and axis, or -1.
  int find(ColumnRole role, int component = 0) const noexcept;

  /// Returns the index into arrays(), or -1.
  int find_array(std::string_view name) const noexcept;

  /// Returns for each column its index into arrays(). For a diameter this is its own array, not the radius.
  std::vector<int> arrays_of_columns() const;

  /// Returns the names, separated by blanks, in the file's order and spelling.
  std::string text() const;

  /// Returns those of an array, one for each component; nothing for an array that other values make.
  std::string text(const ArrayInfo& array) const;

  /// Changes the types of columns. An integer column with other numbers becomes Float64 and is no longer open, together with
  /// the other columns of its array; so does one of Int32 or Float64 that becomes Int64, which stays open. An unknown column
  /// with words becomes Text by itself, which may split an array. Ids that are not integers lose the role Id.
  void set_types(std::span<const TypeChange> changes);

  /// Changes the type of one column.
  void set_type(int column, ValueType type);

  bool operator==(const ColumnSchema& other) const;

private:
  void make_arrays();

  std::span<const KnownColumn> table_;
  std::vector<ColumnInfo> columns_;
  std::vector<ArrayInfo> arrays_;
};

/// The sizes that an array `shape` holds.
enum class ShapeSizes : std::uint8_t
{
  None, ///< there is no such array
  HalfAxes,
  Diameters
};

/// Returns the sizes that the columns shapex shapey shapez are: LIGGGHTS prints half axes, LAMMPS diameters (half axes before
/// July 2020). The names of LAMMPS' other columns tell it, quatw and block1, and those of LIGGGHTS', quat1 and blockiness1; where
/// there are neither, the program does, which `lammps` says.
ShapeSizes find_shape_sizes(const ColumnSchema& schema, bool lammps) noexcept;
}
#endif
