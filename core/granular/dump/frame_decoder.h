// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_frame_decoder_h
#define granular_dump_frame_decoder_h

#include "granular/base/block.h"
#include "granular/base/row_text.h"
#include "granular/dump/dump_reader.h"
#include "granular/dump/text_rows.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
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

/// Lets words be looked up without a copy.
struct WordHash
{
  using is_transparent = void;

  std::size_t operator()(std::string_view word) const noexcept
  {
    return std::hash<std::string_view>{}(word);
  }
};

/// A column of texts.
struct TextColumn
{
  std::size_t array;   ///< index of its array in the frame
  const char* scratch; ///< std::string_views of a batch
  std::unordered_map<std::string, std::int32_t, WordHash, std::equal_to<>> indices; ///< of words
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

/// A word that does not fit the type of its column, where another type would do.
struct Misfit
{
  int column;
  RowStatus status; ///< NotExact or NotANumber
  std::string word;
  Where where;
};

/// Decodes one frame: lays the wires, then runs batches of rows through them.
class FrameDecoder
{
public:
  FrameDecoder(const ByteSource& source, const FrameEntry& entry, const ColumnSchema& schema,
    const DumpRequest& request, Notices& notices);

  /// Decodes all rows, or up to a word that does not fit.
  std::optional<Misfit> run(Progress& progress);

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
  void finish_batch(std::size_t count);
  void copy_batch(std::size_t count);
  void choose_rows(std::size_t count);
  void compact(Block& block, std::size_t width, std::size_t count) const;
  void index_texts(std::size_t count);

  const ByteSource& source_;
  const FrameEntry& entry_;
  const ColumnSchema& schema_;
  const DumpRequest& request_;
  Notices& notices_;
  Where where_;

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
