// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_write_column_plan_h
#define granular_formats_dump_write_column_plan_h

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace granular
{
/// The source of a dump column.
struct ColumnSource
{
  enum class Kind : std::uint8_t
  {
    Array,
    Coordinate, ///< the points, in the form of the role
    Image,
    RowNumber, ///< from 1, over all ranks: a missing id
    One        ///< 1 in each row: a missing type
  };

  std::string name = {};
  Kind kind = Kind::Array;
  ValueSource values = {}; ///< of Kind::Array
  bool own = false;        ///< for Kind::Coordinate: values also holds the file's own numbers
  ColumnRole role = ColumnRole::Other; ///< of ids and coordinates, also those in arrays
  int axis = 0;                        ///< of coordinates and Kind::Image
  bool whole = false;        ///< text shows integral numbers with all their digits, for any type
  NumberFormat numbers = {}; ///< of real numbers in text

  /// Returns the digits of the text that the column comes from, to which values within rounding are set back; 0: not from
  /// text, or its digits are not wanted.
  int kept_digits() const noexcept { return numbers.exact ? numbers.digits : 0; }
};

/// The columns of a dump, and other data that they need.
struct ColumnPlan
{
  std::vector<ColumnSource> columns = {};
  std::array<std::optional<ValueSource>, 3> images = {}; ///< if present and needed
  std::optional<ValueSource> ids = {};                   ///< integers to sort by, if present
  bool binary = false; ///< integers may be loaded as doubles if each is one
  bool wraps = false;  ///< image counts are found by wrapping unwrapped points into the box

  std::vector<std::string> names() const;
};

/// Returns true for a frame without rows and arrays, as filters make it; it can have any columns.
bool is_blank_frame(const FrameView& frame) noexcept;

/// Throws an Error: there is no source for a column.
[[noreturn]] void fail_missing(const FrameView& frame, const std::string& name);

/// Returns the columns of the frame's file for which is_there is true; a notice names the others.
std::vector<std::string> kept_columns(const FrameView& frame,
  const std::function<bool(std::size_t column)>& is_there, Notices& notices);

/// Returns the default columns of a frame: the columns of its file that have a source, with a notice about the others, then
/// new arrays; without a file id, type, x, y, z and all arrays. Texts that a binary dump cannot hold, and arrays whose
/// columns exist already, are left out with a notice.
std::vector<std::string> default_columns(
  const FrameView& frame, Notices& notices, bool binary = false);

/// Replaces the names of arrays by those of their columns: v by vx vy vz, and an unknown array A of n components by A[1] ..
/// A[n].
std::vector<std::string> expand_columns(
  const std::vector<std::string>& names, const FrameView& frame);

/// Finds the source of each column: the array of that name, a component of the array that columns of this name become (see
/// ColumnSchema), the points, or the image counts. A missing id is the number of the row, a missing type 1, missing image
/// counts are 0, each with a notice; any other missing source is an Error. binary: texts are not numbers; an element becomes
/// the type. Throws Error, UnsupportedError.
ColumnPlan plan_columns(
  const std::vector<std::string>& names, const FrameView& frame, bool binary, Notices& notices);

/// The columns of rows that are not particles, but contacts, bonds or others. No column is made up, and no name stands for
/// another: a column is an array of that name, or A[3] the third component of A, unless the array names its components.

/// Returns the default columns: those of the file that the rows come from, if there are arrays, with a notice about the
/// others, and then new arrays.
std::vector<std::string> default_table_columns(const FrameView& frame, Notices& notices);

/// Replaces the names of arrays with several components by those of the components: A by A[1] .. A[n], or by the array's own
/// names.
std::vector<std::string> expand_table_columns(
  const std::vector<std::string>& names, const FrameView& frame);

/// Finds the array, or the component of an array, for each column. The ids of the ends, id1 and id2, are written with all
/// digits, for any type. Throws Error if there is none, except in a frame without rows and arrays.
ColumnPlan plan_table_columns(const std::vector<std::string>& names, const FrameView& frame);
}
#endif
