// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_column_plan_h
#define granular_dump_write_column_plan_h

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
/// What a column of a dump is made from.
struct ColumnSource
{
  enum class Kind : std::uint8_t
  {
    Array,
    Coordinate, ///< of the points, in the form of its role
    Image,
    RowNumber, ///< from 1, over all processes: an id where there is none
    One        ///< 1 in each row: a type where there is none
  };

  std::string name = {};
  Kind kind = Kind::Array;
  ValueSource values = {}; ///< of Kind::Array
  bool own = false;        ///< of Kind::Coordinate: values holds the file's own numbers, too
  ColumnRole role = ColumnRole::Other; ///< of coordinates, those in arrays, too
  int axis = 0;                        ///< of coordinates and Kind::Image
  bool whole = false; ///< text shows integral numbers with all their digits, whatever their type
  NumberFormat numbers = {}; ///< of real numbers in text

  /// Digits of the text that the column comes from, to which values are put back that are those within rounding; 0: it comes from
  /// none, or its digits are not wanted.
  int kept_digits() const noexcept { return numbers.exact ? numbers.digits : 0; }
};

/// The columns of a dump, and what else they need.
struct ColumnPlan
{
  std::vector<ColumnSource> columns = {};
  std::array<std::optional<ValueSource>, 3>
    images = {};                       ///< where there are any and they are needed
  std::optional<ValueSource> ids = {}; ///< integers to sort by, if there are any
  bool binary = false; ///< whole numbers may be loaded as doubles, where each is one
  bool wraps = false;  ///< image counts are found by wrapping unwrapped points into the box

  std::vector<std::string> names() const;
};

/// Filters may give a frame without rows no arrays: such a one can have any columns.
bool is_blank_frame(const FrameView& frame) noexcept;

/// Throws the Error that there is nothing to make a column from.
[[noreturn]] void fail_missing(const FrameView& frame, const std::string& name);

/// The columns of the file that a frame comes from for which is_there says that there is something to make them from; with
/// a notice of those that are left out.
std::vector<std::string> kept_columns(const FrameView& frame,
  const std::function<bool(std::size_t column)>& is_there, Notices& notices);

/// The columns of a frame that are written where nobody says which: those of the file that it comes from, as
/// far as there is something to make them from, with a notice of those that are left out, and then the
/// arrays that are new; else id, type, x, y, z and all arrays. Texts that a binary dump cannot hold, and an array
/// whose column is that of another, are left out with a notice.
std::vector<std::string> default_columns(
  const FrameView& frame, Notices& notices, bool binary = false);

/// A list of columns with the names of arrays replaced by those of their columns: v by vx vy vz, and an array A
/// of n components that the table does not know by A[1] .. A[n].
std::vector<std::string> expand_columns(
  const std::vector<std::string>& names, const FrameView& frame);

/// Finds what each column is made from: the array of that name, a component of the array that columns of this
/// name become (see ColumnSchema), the points, the image counts. A missing id is the number of the row, a
/// missing type 1, missing image counts are 0, each with a notice; all else that is missing is an
/// Error. binary: texts are no numbers; an element becomes the type. Throws Error, UnsupportedError.
ColumnPlan plan_columns(
  const std::vector<std::string>& names, const FrameView& frame, bool binary, Notices& notices);
}
#endif
