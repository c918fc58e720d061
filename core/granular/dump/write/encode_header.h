// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_encode_header_h
#define granular_dump_write_encode_header_h

#include "granular/dump/write/dump_format.h"
#include "granular/frames/frame.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// How the rows of a frame of a binary dump are cut into chunks, each with its length before it: as few as the
/// lengths allow. Text has none.
class ChunkLengths
{
public:
  ChunkLengths() = default;

  /// size_one: values a row. Throws LimitError if a row does not fit into a chunk, or 32 bits cannot count the
  /// chunks.
  ChunkLengths(std::int64_t rows, std::int64_t size_one, std::int64_t most_values);

  std::int32_t chunks() const noexcept { return chunks_; }
  std::int64_t rows_per_chunk() const noexcept { return rows_per_chunk_; } ///< but for the last

  /// Values of the chunk that begins with that row.
  std::int32_t values(std::int64_t first_row) const noexcept;

  /// Whether the length of a chunk stands before this row. A frame without rows has one chunk without.
  bool begins(std::int64_t row) const noexcept
  {
    return rows_per_chunk_ > 0 && row % rows_per_chunk_ == 0;
  }

  /// Bytes from the end of the header to this row, lengths of chunks before it left out if it begins one.
  std::int64_t offset(std::int64_t row) const noexcept;

private:
  std::int64_t rows_ = 0;
  std::int64_t size_one_ = 0;
  std::int64_t rows_per_chunk_ = 0;
  std::int32_t chunks_ = 0;
};

/// Whether there is a blank behind the last column, of names and of rows: dump local has it, and dump custom of LIGGGHTS.
bool has_trailing_blanks(const DumpFormat& format) noexcept;

/// The header of a frame, up to its first row. first: of the file. Text as dump_atom.cpp, dump_custom.cpp and dump_local.cpp
/// of LIGGGHTS and LAMMPS print it, in their order: [UNITS, TIME,] timestep, [LABEL,] number of what is counted, [box,]
/// columns; binary: timestep, number, triclinic, boundary, box, [tilts,] values a row, [units, time, columns,]
/// number of chunks. A tilted box is given by its bounds and tilts, in the format `box` where the dialect is that of
/// LIGGGHTS: see box_numbers. Throws LimitError, UnsupportedError.
std::string encode_header(const FrameHeader& header, const std::vector<std::string>& columns,
  const DumpFormat& format, const ChunkLengths& chunks, bool first, NumberFormat box = { 6 });
}
#endif
