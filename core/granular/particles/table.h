// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_table_h
#define granular_particles_table_h

#include "granular/columns/column.h"
#include "granular/frames/frame.h"
#include "granular/geometry/positions.h"
#include "granular/memory/block.h"
#include "granular/memory/value_range.h"
#include "granular/particles/frame_view.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace granular
{
/// One array of a decoded frame: rows x components values, row-major.
struct TableArray
{
  ArrayInfo info;
  Block block;                    ///< values; of a Text the std::int32_t indices of its words
  std::vector<std::string> words; ///< of a Text: the distinct words
  ValueRange range;               ///< of the values, if known
};

/// Lines from the rows of a table.
struct Lines
{
  std::int64_t count = 0;
  Block points;                   ///< count x 2 x 3 doubles: the ends of each line
  Block lengths;                  ///< a double per row: of the whole line, over all its parts
  std::vector<std::int64_t> rows; ///< of each line, in their order; empty: line i is row i
  std::int64_t moved = 0; ///< rows whose second end is not drawn where it was, or which are split
};

/// Rows of a frame that were read: particles with points, contacts and bonds with lines, cells, or subdomains. The blocks may be given
/// away.
struct Table
{
  std::int64_t rows = 0;
  Coordinates coordinates = Coordinates::Absolute; ///< what the points are; differs from the
                                                   ///< request only where a notice says so
  Block points;                                    ///< rows x 3, double or float
  ValueRange points_range;
  std::vector<TableArray> arrays;
  FrameHeader header;                       ///< of the first piece; rows of all
  ColumnSchema schema;                      ///< of all pieces, with the final types
  std::vector<std::string> type_names = {}; ///< of types from 1 on; empty: the file has none
  bool has_lines = false; ///< false: the rows are no lines, or have only the ids of their ends
  Lines lines;
  std::int64_t first_row =
    0; ///< of this part in the frame, where lines have rows of their own (Split)
};

/// The tables that were read of a frame.
struct Tables
{
  Table rows = {};
  Table bonds = {};                     ///< of data files and restart files
  std::vector<std::string> groups = {}; ///< of a restart file
};

/// Returns the array of a table that has a name, or null.
TableArray* find_array(Table& table, std::string_view name);

/// Returns values in memory that can be given away.
template <class Value>
Block block_of(const std::vector<Value>& values)
{
  Block block(values.size() * sizeof(Value));
  std::ranges::copy(values, static_cast<Value*>(block.data()));
  return block;
}

/// Adds an array that no columns of a file make.
void add_array(Table& frame, std::string_view name, ValueType type, int components, Block block);

/// Returns true if an array holds doubles, std::int64_t or std::int32_t, as many in a row.
template <class Value>
bool holds(const TableArray& array, std::size_t components)
{
  constexpr ValueType type = std::is_same_v<Value, double> ? ValueType::Float64
    : std::is_same_v<Value, std::int64_t>                  ? ValueType::Int64
                                                           : ValueType::Int32;
  return array.info.type == type && array.info.columns.size() == components;
}

/// The values of an array; none where there is no array, or one that holds others than these.
template <class Value>
std::span<const Value> values_in(const TableArray* array, std::size_t components = 1)
{
  return array && holds<Value>(*array, components)
    ? std::span(
        static_cast<const Value*>(array->block.data()), array->block.bytes() / sizeof(Value))
    : std::span<const Value>();
}

/// The ranges of the points and of each array of a frame, found part by part. Texts have none.
class FrameRanges
{
public:
  /// Begins with no rows of a frame.
  explicit FrameRanges(const Table& frame);

  /// Includes rows of a frame with such arrays. single: its points are floats.
  void add(const Table& frame, std::int64_t first, std::size_t rows, bool single = false);
  void add(const FrameRanges& other);

  /// Gives the ranges to the frame.
  void store(Table& frame) const;

private:
  ValueRange points_ = ValueRange(3);
  std::vector<ValueRange> arrays_;
};

/// Returns a view of a decoded frame, without its texts. Points, if there are any, are doubles. The frame must outlive it.
FrameView view_frame(const Table& frame, const Vector3& point_origin = {});
}
#endif
