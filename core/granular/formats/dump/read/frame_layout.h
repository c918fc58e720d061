// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_read_frame_layout_h
#define granular_formats_dump_read_frame_layout_h

#include "granular/memory/block.h"
#include "granular/particles/request.h"
#include "granular/particles/table.h"
#include "granular/text/row_text.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace granular
{
/// The destination of values: a row of the frame, or a row of the batch in a thread's own memory.
struct Destination
{
  char* base = nullptr;
  std::size_t offset = 0; ///< in scratch memory
  std::ptrdiff_t stride = 0;
  bool scratch = false;

  char* at(std::int64_t row, char* memory) const noexcept
  {
    return scratch ? memory + offset : base + row * stride;
  }
};

/// A column on its way: the decoder writes it to its first destination, from where it is copied to others.
struct Wire
{
  struct Copy
  {
    Destination to; ///< doubles
    double scale;
  };

  ValueType type;
  Destination first;
  std::vector<Copy> copies;
  bool open = false; ///< see ColumnSink
};

/// Points: three doubles per row, made from columns.
struct PointsWire
{
  PositionPlan plan;
  Vector3 point_origin = {};
  Destination xyz;
  std::optional<Destination> images; ///< three doubles per row
};

/// A column of texts, which become indices of the distinct words.
struct TextWire
{
  std::size_t array; ///< in the frame
  Destination texts; ///< std::string_views of a batch
};

/// The memory of a decoded frame, and the connections from its columns. Any number of threads decode into it, each into its
/// own rows.
class FrameLayout
{
public:
  /// rows: the room. Throws the errors of plan_positions; std::bad_alloc.
  FrameLayout(const ColumnSchema& schema, const FrameHeader& header, const Request& request,
    std::int64_t rows, const Where& where, Notices& notices);

  /// Cuts the memory to the actual rows. `ids` gets the ids if they are needed for sorting but not as an array.
  Table take(std::int64_t rows, Block& ids);

  /// Calls visit(block, bytes per row) for every block that has rows.
  template <typename Visit>
  void for_each_block(Visit&& visit)
  {
    if (points)
    {
      visit(frame.points, point_bytes);
    }
    if (ids.bytes() > 0)
    {
      visit(ids, sizeof(std::int64_t));
    }
    for (TableArray& array : frame.arrays)
    {
      visit(array.block, size_of(array.info.type) * array.info.columns.size());
    }
  }

  std::int64_t rows; ///< there is room for
  Table frame;
  Block ids; ///< where they are needed but not wanted as an array
  std::size_t point_bytes;
  std::size_t
    batch; ///< rows decoded at a time: what is made from them is made while they are in the cache
  std::size_t scratch_bytes = 0;
  std::map<int, Wire> wires;        ///< by column
  std::optional<PointsWire> points; ///< where they are wanted
  std::optional<PointsWire> region; ///< absolute coordinates, where a region restricts the rows
  std::vector<TextWire> texts;
  int id_column; ///< -1: there is none

private:
  void lay_arrays();
  void lay_points(const Where& where, Notices& notices);
  void lay_filters(const Where& where, Notices& notices);
  void lay(PointsWire& wire);
  void want(int column, ValueType type, Destination to, double scale = 1);
  Destination scratch(std::size_t bytes_a_row);

  const ColumnSchema& schema_;
  const Request& request_;
};
}
#endif
