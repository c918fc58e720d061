// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_frame_rows_h
#define granular_dump_formats_frame_rows_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/frames/frame.h"
#include "granular/text/row_text.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace granular
{
/// A value that does not fit the type of its column, where another type would do.
struct Misfit
{
  int column;
  RowStatus status; ///< NotExact: a number that an integer column cannot hold; NotANumber
  std::string word;
  Where where;
};

/// What a RowReader throws of a row that cannot be decoded; FrameRows::describe says it in full.
struct RowFault
{
  RowStatus status;
  int column;                    ///< -1: of TooFew
  std::string text;              ///< the word at fault, or the row
  std::int64_t offset;           ///< of it in the content of the file
  std::int64_t lines_behind = 0; ///< of a text: behind the fault that it is in the rest of
  std::vector<RowFault>
    rest = {}; ///< those behind it that were read with it, of each column the first
};

/// The size of a frame in its own measure, by which it is cut into pieces and chunks: bytes of a text,
/// header and rows; rows of a binary dump.
std::int64_t extent_of(const FrameEntry& entry) noexcept;

/// The extent of a chunk of about so many bytes, at least 1.
std::int64_t chunk_extent(const FrameEntry& entry, std::size_t bytes) noexcept;

/// Reads some rows of a frame at a time. One for each thread.
class RowReader
{
public:
  virtual ~RowReader() = default;

  /// Reads the rows that begin in [first, last) of the extent of the frame, for decode. Where the
  /// source is compressed, for one thread at a time, and cheap only in order. Throws IoError,
  /// FormatError of compressed data, LimitError.
  virtual void open(std::int64_t first, std::int64_t last) = 0;

  /// How many rows there are, decoded or not.
  virtual std::int64_t rows() const noexcept = 0;

  /// Whether there are rows that were not decoded.
  virtual bool more() const noexcept = 0;

  /// Whether a row that was decoded since the last open had more words than there are columns.
  virtual bool surplus() const noexcept { return false; }

  /// Decodes the next rows, at most max_rows, into the sinks and moves them on. Returns how many; 0 only
  /// if max_rows is 0 or there are no more. Throws RowFault. Texts stay valid until the next open.
  virtual std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows) = 0;
};

/// The rows of a frame, text or binary.
class FrameRows
{
public:
  virtual ~FrameRows() = default;

  virtual const FrameHeader& header() const noexcept = 0;

  /// Who reads rows of it, as long as this lives.
  virtual std::unique_ptr<RowReader> reader() const = 0;

  /// The misfit that a fault is, and those behind it of the rows that were read with it: fewer passes over the frame. Throws
  /// the FormatError if the fault is none. May read the source.
  virtual std::vector<Misfit> describe(const RowFault& fault) const = 0;
};

/// Reads the header at the place of a frame and makes the rows behind it ready. Throws IoError if
/// the frame is not what the index says.
std::unique_ptr<FrameRows> open_rows(const ByteSource& source, const FrameEntry& entry);
}
#endif
