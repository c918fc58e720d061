// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_frame_decoder_h
#define granular_dump_frame_decoder_h

#include "granular/base/block.h"
#include "granular/base/row_text.h"
#include "granular/dump/dump_reader.h"
#include "granular/dump/frame_rows.h"
#include "granular/dump/text_column.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace granular
{
/// Where values go: by the row of the frame, or by the row of the batch.
struct Destination
{
  char* base = nullptr;
  std::ptrdiff_t stride = 0;
  bool scratch = false; ///< starts anew with each batch

  char* at(std::int64_t row) const noexcept { return base + (scratch ? 0 : row * stride); }
};

/// A column on its way: to its first destination by the decoder, from there to others.
struct Wire
{
  struct Copy
  {
    Destination to; ///< doubles
    double scale;
  };

  ColumnSink::Kind kind;
  Destination first;
  std::vector<Copy> copies;
};

/// Points of a batch: three doubles a row, made from columns.
struct Points
{
  PositionPlan plan;
  Vector3 point_origin = {};
  Destination xyz;
  std::vector<double> images; ///< of a batch

  void convert(const Box& box, std::int64_t row, std::size_t count);
};

/// The pieces of a frame, and how to get at their bytes.
struct PieceList
{
  std::vector<const FrameEntry*> entries;
  std::function<std::shared_ptr<const ByteSource>(std::size_t piece)> open;

  std::int64_t rows() const noexcept; ///< of all pieces
};

/// Decodes one frame: lays the wires, then runs batches of rows through them.
class FrameDecoder
{
public:
  FrameDecoder(const PieceList& pieces, const ColumnSchema& schema, const DumpRequest& request,
    Notices& notices);

  /// Decodes all rows, or up to a value that does not fit.
  std::optional<Misfit> run(Progress& progress);

  const Where& where() const noexcept { return where_; } ///< the frame

  /// The frame; ids gets the ids where they are needed for sorting and no array of the frame.
  DumpFrame take(Block& ids);

private:
  void lay_arrays();
  void lay_points();
  void lay_filters();
  void lay(Points& points);
  void want(int column, ValueType type, Destination to, double scale = 1);
  Destination scratch(std::size_t bytes_a_row);
  void aim(std::vector<ColumnSink>& sinks) const;
  void open(std::size_t piece);
  void run_piece(std::vector<ColumnSink>& sinks, Progress& progress);
  void finish_batch(std::size_t count);
  void copy_batch(std::size_t count);
  void choose_rows(std::size_t count);
  void compact(Block& block, std::size_t width, std::size_t count) const;

  const PieceList& pieces_;
  const ColumnSchema& schema_;
  const DumpRequest& request_;
  Notices& notices_;
  Where where_;                              ///< of the first piece
  std::shared_ptr<const ByteSource> source_; ///< of the piece at hand
  std::unique_ptr<FrameRows> rows_;
  FrameHeader header_; ///< of the first piece, with the rows of all

  std::map<int, Wire> wires_; ///< by column
  std::vector<std::unique_ptr<char[]>> scratch_;
  Points points_;
  std::optional<Points> region_; ///< absolute coordinates, where a region restricts the rows
  std::vector<TextColumn> texts_;
  std::vector<char> keep_; ///< of a batch; empty: all rows stay
  Block ids_;              ///< where they are needed but not wanted as an array
  DumpFrame frame_;
  std::int64_t row_ = 0;  ///< rows kept
  std::int64_t seen_ = 0; ///< rows decoded
};
}
#endif
