// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/index_claims.h"

#include "granular/common/archive.h"

#include <algorithm>
#include <limits>

namespace granular
{
namespace
{
/// No file is larger; sums of two do not overflow.
constexpr std::int64_t largest_offset = std::numeric_limits<std::int64_t>::max() / 2;

/// How many bytes a file holds at most, unpacked: four bytes are 2^17 at best in Zstandard, one is about 2^10 in gzip.
std::int64_t most_content(const FileIndex& file)
{
  constexpr std::int64_t best = std::int64_t{ 1 } << 15;
  return file.compressed ? std::min(file.stamp.size, largest_offset / best) * best
                         : file.stamp.size;
}

/// Bytes of other files that rows may be in.
std::int64_t bytes_beside(const FileIndex& file)
{
  std::int64_t bytes = 0;
  for (const KnownFile& other : file.beside)
  {
    bytes += std::clamp(other.stamp.size, std::int64_t{ 0 }, largest_offset - bytes);
  }
  return bytes;
}

/// Whether a place can be that of a line, or 0 where lines do not count: each before it has its line feed.
bool is_place(std::int64_t offset, std::int64_t line, std::int64_t end)
{
  return offset >= 0 && offset <= end && line >= 0 && line - 1 <= offset;
}

/// Whether as many rows as it says can lie where it says.
bool is_plausible(const FrameEntry& frame, std::int64_t content, std::int64_t beside)
{
  if (!is_place(frame.offset, frame.line, frame.end) || frame.end > content || frame.rows < 0)
  {
    return false;
  }
  const auto columns = static_cast<std::int64_t>(frame.kind->schema.columns().size());
  const auto real = static_cast<std::int64_t>(sizeof(double));
  if (columns == 0)
  {
    // records, or the cells between three lists of coordinates
    const std::int64_t bytes = frame.end - frame.offset + beside;
    return frame.rows == 0 || (bytes > 0 && frame.rows / bytes / bytes <= bytes);
  }
  // a row of text has a line feed at least
  return frame.rows <= (frame.end - frame.offset) / (frame.kind->is_text() ? 1 : columns * real);
}

void check_frames(const FileIndex& file)
{
  const std::int64_t content = most_content(file);
  const std::int64_t beside = bytes_beside(file);
  std::int64_t last = 0;
  for (const FrameEntry& frame : file.frames)
  {
    require(is_plausible(frame, content, beside), "a frame within its file");
    require(frame.offset >= last, "frames one behind the other");
    require(frame.kind->layout == file.frames.front().kind->layout, "frames of the same layout");
    last = frame.end;
  }
}

void check_points(const FileIndex& file)
{
  constexpr std::size_t largest_window = std::size_t{ 1 } << 15;
  std::int64_t last = 0;
  require(file.compressed, "seek points of a compressed file");
  for (const SeekPoints::Point& point : file.points->points)
  {
    require(point.offset >= last && point.offset <= most_content(file), "increasing seek points");
    require(
      point.packed >= (point.bits > 0 ? 1 : 0) && point.packed <= file.stamp.size && point.bits < 8,
      "a seek point within its file");
    require(point.window.size() <= largest_window, "a window of gzip");
    last = point.offset;
  }
  require(file.points->spacing > 0 &&
      (file.points->spacing <= SeekPoints::widest_spacing ||
        (claims_end(file) && file.points->points.empty())),
    "a spacing of seek points");
}
}

void check_claims(const FileIndex& file)
{
  require(file.stamp.size >= 0 && file.stamp.size <= largest_offset, "the size of a file");
  require(
    file.resume_line >= 1 && is_place(file.resume_offset, file.resume_line, most_content(file)),
    "a place in a file");
  if (file.points)
  {
    check_points(file);
  }
  check_frames(file);
}

std::shared_ptr<SeekPoints> no_points()
{
  auto none = std::make_shared<SeekPoints>();
  none->claimed = true;
  none->spacing = std::numeric_limits<std::int64_t>::max();
  return none;
}

bool claims_end(const FileIndex& index) noexcept
{
  return index.points && index.points->spacing == std::numeric_limits<std::int64_t>::max();
}
}
