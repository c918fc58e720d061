// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_frame_rows_h
#define granular_formats_dump_grammar_frame_rows_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/frames/frame.h"
#include "granular/text/row_text.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// A word that does not fit the type of its column, or a row that cannot be decoded.
struct Misfit
{
  RowStatus
    status; ///< NotExact: a number that an integer column cannot hold; NotDouble; NotANumber; TooFew; Surplus; TooMany
  int column;              ///< -1: of rows
  std::string word;        ///< or the row
  std::int64_t offset = 0; ///< of the word in the content of the file
  std::int64_t lines = 0;  ///< of a text: from the first misfit to this one
  std::size_t piece = 0;   ///< of the frame
  Where where = {};        ///< set by FrameRows::locate
};

/// Misfits that were found together, by position: a RowReader throws the first one, and the first of every other column in
/// the rows read with it.
using Misfits = std::vector<Misfit>;

/// The size of a frame in its own measure, which divides it into pieces and chunks: bytes of text, header and rows; rows of a
/// binary dump.
std::int64_t extent_of(const FrameEntry& entry) noexcept;

/// Returns the extent of a chunk of about so many bytes, at least 1.
std::int64_t chunk_extent(const FrameEntry& entry, std::size_t bytes) noexcept;

/// The rows that are wanted: those whose integer in a column passes.
struct RowChoice
{
  std::uint32_t column = 0;
  std::function<bool(std::int64_t)> passes = {};
};

/// Rows that a RowReader has gone through, and how many of them it has decoded.
struct RowCounts
{
  std::int64_t rows = 0;
  std::int64_t decoded = 0;
};

/// Reads some rows of a frame at a time. One for each thread.
class RowReader
{
public:
  virtual ~RowReader() = default;

  /// Reads the rows that begin in [first, last) of the extent of the frame, for decode. Where the
  /// source is compressed, for one thread at a time, and cheap only in order. Throws IoError,
  /// FormatError of compressed data, LimitError.
  virtual void open(std::int64_t first, std::int64_t last) = 0;

  /// Returns the number of rows, decoded or not.
  virtual std::int64_t rows() const noexcept = 0;

  /// Returns true if rows are left to decode.
  virtual bool more() const noexcept = 0;

  /// Decodes the next rows, at most max_rows, into the sinks and moves them on. Returns how many; 0 only
  /// if max_rows is 0 or there are no more. Throws Misfits. Texts stay valid until the next open.
  virtual std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows) = 0;

  /// Goes through the next rows, at most max_rows, and decodes at least those that are chosen. Of others, words other than
  /// that of the choice need not be numbers. Throws Misfits.
  virtual RowCounts decode_chosen(
    std::span<ColumnSink> sinks, std::int64_t max_rows, const RowChoice& /*choice*/)
  {
    const std::int64_t rows = this->decode(sinks, max_rows);
    return { rows, rows };
  }
};

/// The rows of a frame, text or binary.
class FrameRows
{
public:
  virtual ~FrameRows() = default;

  virtual const FrameHeader& header() const noexcept = 0;

  /// Returns FrameHeader::digits, from the first rows. Reads the source.
  virtual std::vector<int> digits() const { return {}; }

  /// Returns a reader of its rows, as long as this lives.
  virtual std::unique_ptr<RowReader> reader() const = 0;

  /// Says where misfits are, and keeps those before the first that no other type of its column would mend, which is met again:
  /// fewer passes over the frame. Throws FormatError if that is the first of all. May read the source.
  virtual void locate(Misfits& misfits) const = 0;
};

/// Reads the header at the place of a frame and makes the rows behind it ready. Throws IoError if
/// the frame is not what the index says.
std::unique_ptr<FrameRows> open_rows(const ByteSource& source, const FrameEntry& entry);
}
#endif
