// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_binary_header_h
#define granular_formats_dump_grammar_binary_header_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/frames/frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// The layout of a binary dump's header.
struct BinaryLayout
{
  const char* name;
  bool magic;     ///< begins with DUMPATOM or DUMPCUSTOM and describes the rest
  bool wide;      ///< timestep and number of atoms are int64, otherwise int32
  bool triclinic; ///< has the flag
  bool boundary;  ///< has the six flags of the faces
  bool swapped;   ///< of the other byte order
};

/// All layouts, the most likely first. Sources: dump_atom.cpp and dump_custom.cpp of LIGGGHTS and LAMMPS; lmptype.h defines
/// the sizes of integers (-DLAMMPS_SMALLSMALL).
std::span<const BinaryLayout> binary_layouts() noexcept;

/// The header of a frame of a binary dump.
struct BinaryHeader
{
  FrameHeader frame;
  std::vector<std::string> columns; ///< names; empty: the file does not name them
  std::int32_t size_one = 0;
  std::int32_t chunks = 0;
  std::int64_t box_offset = 0;
  std::int64_t size_one_offset = 0;
  std::int64_t chunks_offset = 0; ///< of the first chunk: int32 n, n doubles

  std::int64_t values() const noexcept { return frame.rows * size_one; }
};

/// Reads numbers in order, through a small buffer.
class BinaryCursor
{
public:
  BinaryCursor(const ByteSource& source, std::int64_t offset, bool swapped)
    : source_(source)
    , offset_(offset)
    , swapped_(swapped)
  {
  }

  /// Returns the next number; 0 after the end of the source.
  template <typename T>
  T take()
  {
    std::array<char, sizeof(T)> bytes = {};
    this->copy(bytes.data(), bytes.size());
    if (swapped_)
    {
      std::reverse(bytes.begin(), bytes.end());
    }
    return std::bit_cast<T>(bytes);
  }

  std::string take_text(std::int64_t bytes);
  void go_to(std::int64_t offset) noexcept { offset_ = offset; }

  std::int64_t offset() const noexcept { return offset_; }
  bool ended() const noexcept { return ended_; } ///< true: bytes after the end were requested

private:
  void copy(char* to, std::size_t bytes);

  const ByteSource& source_;
  std::array<char, 4096> buffer_;
  std::int64_t buffer_offset_ = 0;
  std::size_t buffered_ = 0;
  std::int64_t offset_;
  const bool swapped_;
  bool ended_ = false;
};

/// Reads the header at an offset. Returns nothing at the end of the source, also within the header. Throws FormatError, with
/// the byte of the wrong field; UnsupportedError.
std::optional<BinaryHeader> read_binary_header(
  const ByteSource& source, std::int64_t offset, const BinaryLayout& layout);

/// The beginning of a source as read by a layout.
struct HeaderCheck
{
  std::optional<BinaryHeader> header; ///< of the first frame; none at the end of the source, and
                                      ///< where more is wrong than that a box may be none
  std::optional<FormatError> error;   ///< about the first impossible field
  int faults = 0;                     ///< number of impossible fields
};

/// Reads the first header, also after errors. Without magic the box must be plausible.
HeaderCheck check_binary_header(const ByteSource& source, const BinaryLayout& layout);
}
#endif
