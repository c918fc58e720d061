// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_columns_column_h
#define granular_columns_column_h

#include "granular/common/value_type.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// What a column means, where code must know; all else is Other. A role is the first column's that
/// has it.
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

/// Whether a column is a coordinate, in whatever form.
constexpr bool is_position(ColumnRole role) noexcept
{
  return role >= ColumnRole::Position && role <= ColumnRole::ScaledUnwrappedPosition;
}

/// One row of the table of names that LIGGGHTS and LAMMPS give to columns.
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

/// THE table. Readers, writers, documentation and tests take names, types and meanings from here.
std::span<const KnownColumn> known_columns() noexcept;

/// The row of a table for a name, or null.
const KnownColumn* find_known_column(
  std::string_view name, std::span<const KnownColumn> table = known_columns()) noexcept;

/// One column of a file.
struct ColumnInfo
{
  std::string name; ///< as the file spells it; not unique
  ValueType type = ValueType::Float64;
  ColumnRole role = ColumnRole::Other;
  int component = 0; ///< axis of a position or image; end of a line
  bool known = false;
};

/// One array that columns become: a scalar, or a vector from several columns.
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

/// The ordered columns of a frame, and the arrays they become:
/// - columns of the table join the vectors the table names, if all components are there;
/// - c_ID[1] .. c_ID[n] (also f_, v_, i2_, d2_), n >= 2, complete and in this order in the file,
///   become one array c_ID of n components, in the file's order (no tensor reordering);
/// - a column of texts is always an array of its own, and so are the others of its vector then;
/// - every other column becomes an array under its own name;
/// - a name that is taken gets "_2", "_3", ...;
/// - `radius` is made from `diameter` where only that is there.
class ColumnSchema
{
public:
  /// What becomes of a column.
  struct TypeChange
  {
    int column;
    ValueType type;
  };

  ColumnSchema() = default;

  /// The table must outlive the schema, and its copies. Takes time in proportion to the columns.
  explicit ColumnSchema(
    const std::vector<std::string>& names, std::span<const KnownColumn> table = known_columns());

  const std::vector<ColumnInfo>& columns() const noexcept { return columns_; }
  const std::vector<ArrayInfo>& arrays() const noexcept { return arrays_; }

  /// The first column with this role and axis, or -1.
  int find(ColumnRole role, int component = 0) const noexcept;

  /// Index into arrays(), or -1.
  int find_array(std::string_view name) const noexcept;

  /// Of each column the index into arrays(): of a diameter its own array, and not the radius.
  std::vector<int> arrays_of_columns() const;

  /// The names, blank-separated, in the file's order and spelling.
  std::string text() const;

  /// Changes the types of columns. An integer column that holds other numbers becomes Float64, together with the other
  /// columns of its array; an unknown column of words becomes Text, by itself, which may split an array. Ids that are
  /// no integers are ids no more. Takes time in proportion to the columns, however many change.
  void set_types(std::span<const TypeChange> changes);

  /// The same for one column. To change many, one after the other, takes time in proportion to their square.
  void set_type(int column, ValueType type);

  bool operator==(const ColumnSchema& other) const;

private:
  void make_arrays();

  std::span<const KnownColumn> table_;
  std::vector<ColumnInfo> columns_;
  std::vector<ArrayInfo> arrays_;
};
}
#endif
