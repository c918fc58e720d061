// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_write_encode_header_h
#define granular_formats_dump_write_encode_header_h

#include "granular/formats/dump/write/dump_format.h"
#include "granular/frames/frame.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// The division of a binary frame's rows into chunks, each after its length: as few as the lengths allow. Text has none.
class ChunkLengths
{
public:
  ChunkLengths() = default;

  /// size_one: values per row. Throws LimitError if a row does not fit into a chunk, or 32 bits cannot count the chunks.
  ChunkLengths(std::int64_t rows, std::int64_t size_one, std::int64_t most_values);

  std::int32_t chunks() const noexcept { return chunks_; }
  std::int64_t rows_per_chunk() const noexcept { return rows_per_chunk_; } ///< but for the last

  /// Returns the values of the chunk that begins with this row.
  std::int32_t values(std::int64_t first_row) const noexcept;

  /// Returns true if the length of a chunk stands before this row. A frame without rows has one empty chunk.
  bool begins(std::int64_t row) const noexcept
  {
    return rows_per_chunk_ > 0 && row % rows_per_chunk_ == 0;
  }

  /// Returns the bytes from the end of the header to this row; the length of a chunk that begins here is not included.
  std::int64_t offset(std::int64_t row) const noexcept;

private:
  std::int64_t rows_ = 0;
  std::int64_t size_one_ = 0;
  std::int64_t rows_per_chunk_ = 0;
  std::int32_t chunks_ = 0;
};

/// Returns true if a blank follows the last column, in names and rows: in dump local, and in dump custom of LIGGGHTS.
bool has_trailing_blanks(const DumpFormat& format) noexcept;

/// Returns the header of a frame, up to its first row. first: of the file. Text is printed as in dump_atom.cpp,
/// dump_custom.cpp and dump_local.cpp of LIGGGHTS and LAMMPS, in their order: [UNITS, TIME,] timestep, [LABEL,] number of
/// rows, [box,] columns. Binary: timestep, number, triclinic, boundary, box, [tilts,] values per row, [units, time, columns,]
/// number of chunks. A tilted box is given by its bounds and tilts, in the dialect LIGGGHTS in the format `box`: see
/// PrintLoss. Throws LimitError, UnsupportedError.
std::string encode_header(const FrameHeader& header, const std::vector<std::string>& columns,
  const DumpFormat& format, const ChunkLengths& chunks, bool first, NumberFormat box = { 6 });
}
#endif
