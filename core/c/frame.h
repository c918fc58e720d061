// SPDX-License-Identifier: BSD-3-Clause
// Contents of the handles of granular.h. No exception leaves the functions of granular.h; here they are thrown.
#ifndef granular_c_frame_h
#define granular_c_frame_h

#include "granular.h"

#include "granular/common/error.h"
#include "granular/formats/euler/regular_grids.h"
#include "granular/frames/run_index.h"
#include "granular/particles/frame_view.h"
#include "granular/particles/table.h"
#include "granular/runs/kind.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace granular_c
{
/// An array of a frame that was read, in the memory of its table.
struct FrameArray
{
  const char* name;
  granular::ValueType type;
  int components;
  granular::Block* values;                 ///< empty once they were taken
  const granular::KnownColumn* known;      ///< its unit and meaning; null: not known
  std::string columns = {};                ///< that make it
  std::vector<double> range = {};          ///< as granular.h gives it; empty: not known
  std::vector<const char*> word_list = {}; ///< of a Text
};

using granular::RowKind;
}

/// A frame that was read. Arrays do not move: strings and pointers to them are given away.
struct granular_frame
{
  /// Takes a table that was read, whose units `known` knows. split: its lines are parts of rows, of which they get `row` and `part`.
  granular_frame(granular_c::RowKind rows_kind, granular::Table&& read,
    std::span<const granular::KnownColumn> known, bool split,
    const std::vector<std::string>& groups_read = {});
  granular_frame(const granular_frame&) = delete;
  granular_frame& operator=(const granular_frame&) = delete;

  const granular_c::RowKind kind;
  granular::Table table;
  granular::Vector3 origin = {};
  double time = 0;               ///< of the run
  granular::Where where;         ///< of its first piece
  const std::string column_text; ///< of the file, separated by blanks
  std::vector<granular_c::FrameArray> arrays;
  const std::vector<std::string> groups;
  std::vector<const char*> group_list;
  std::vector<const char*> type_names;
  std::string length_name =
    "length"; ///< of drawn lines: `length_2` and so on if the file has a column `length`
  granular::Block row_numbers;                     ///< std::int64_t in the frame, of split lines
  granular::Block row_parts;                       ///< std::int32_t of the row, from 0
  std::shared_ptr<const granular::RunIndex> index; ///< of the run that it was read from
};

namespace granular_c
{
/// The names of the arrays that are made from coordinates.
inline constexpr const char* points_name = "points";
inline constexpr const char* ends_name = "ends";

/// Returns a text of the caller; null is an empty one.
inline std::string text_of(const char* text)
{
  return text == nullptr ? std::string() : std::string(text);
}

/// Gives a table whose lines are parts of rows as many rows.
void repeat_rows(granular::Table& table);

/// Returns an array by its name. Throws granular::ArgumentError that lists those there are.
const FrameArray& find_array(const granular_frame& frame, std::string_view name);

/// Throws granular::ArgumentError if the memory of an array was taken.
void expect_values(const FrameArray& array);

/// Copies an array into memory of the caller. Throws granular::ArgumentError if there is too little room, or a number does not fit the
/// type.
void copy_array(const granular_frame& frame, const granular_destination& to);

/// Returns the box that the bounds of a box of the caller say, or its corner and edges.
granular::Box make_box(const granular_box& box);

/// Returns the box of a frame; its boundary belongs to the header.
granular_box box_of(const granular::FrameHeader& header);

/// Returns the header of a frame, to which its strings belong.
granular_frame_header header_of(const granular_frame& frame);

/// Finds the regular grids that the cells of a frame form; see granular_grids.
std::vector<granular::RegularGrid> find_grids(
  const granular_frame& frame, granular::Notices& notices);

/// A frame as writers take it; the frame must outlive it.
struct WriteView
{
  explicit WriteView(const granular_frame& frame);
  WriteView(const granular_content& content, RowKind kind);

  granular::FrameView view;
  std::optional<granular::ArrayView> ends; ///< of lines, as they were given

private:
  void take_header(const granular_frame_header& header);
  void finish(RowKind kind);
  void add(std::string name, granular::ValueType type, int components, const void* data,
    std::span<const char* const> words);

  std::vector<std::unique_ptr<std::vector<std::string>>> texts_; ///< words row by row
};
}
#endif
