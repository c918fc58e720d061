// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_frame_rows_h
#define granular_dump_frame_rows_h

#include "granular/base/byte_source.h"
#include "granular/base/error.h"
#include "granular/base/row_text.h"
#include "granular/dump/frame.h"

#include <cstdint>
#include <memory>
#include <optional>
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

/// The rows of a frame, text or binary, read in order through a buffer of constant size.
class FrameRows
{
public:
  virtual ~FrameRows() = default;

  virtual const FrameHeader& header() const noexcept = 0;

  /// Decodes the next rows, at most max_rows, into the sinks and moves them on. Returns how many; 0
  /// at the end of the frame, and at a misfit. All other errors, and a frame with other than its
  /// header's number of rows, throw FormatError; a file that changed throws IoError. Texts stay valid
  /// until the next call.
  virtual std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows) = 0;

  virtual std::optional<Misfit> misfit() const = 0;

  /// How much of the frame has been decoded, 0 to 1.
  virtual double fraction() const noexcept = 0;

  /// What there is to say of the rows that were read.
  virtual void note(Notices& notices) const { static_cast<void>(notices); }
};

/// Reads the header at the place of a frame and makes the rows behind it ready. Throws IoError if
/// the frame is not what the index says.
std::unique_ptr<FrameRows> open_rows(const ByteSource& source, const FrameEntry& entry);
}
#endif
