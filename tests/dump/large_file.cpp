// SPDX-License-Identifier: BSD-3-Clause
// Files above 4 GiB, made as they are read: a row repeated without end between real frames.
#include "../support/dumps.h"

#include "granular/formats/dump/grammar/dump_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace
{
using granular::FileStamp;

constexpr std::string_view row = "1234567 0.25 0.5 0.75\n";

/// head, count rows, tail.
class LargeSource final : public granular::ByteSource
{
public:
  LargeSource(std::string head, std::int64_t count, std::string tail)
    : head_(std::move(head))
    , rows_(count * static_cast<std::int64_t>(row.size()))
    , tail_(std::move(tail))
  {
    while (pattern_.size() < (std::size_t{ 1 } << 20))
    {
      pattern_ += row;
    }
  }

  const std::string& path() const override { return path_; }

  FileStamp stamp() const override
  {
    FileStamp stamp;
    stamp.size = static_cast<std::int64_t>(head_.size() + tail_.size()) + rows_;
    return stamp;
  }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    const auto head = static_cast<std::int64_t>(head_.size());
    std::size_t done = 0;
    while (done < bytes)
    {
      const std::int64_t at = offset + static_cast<std::int64_t>(done);
      std::string_view part;
      if (at < head)
      {
        part = std::string_view(head_).substr(static_cast<std::size_t>(at));
      }
      else if (at < head + rows_)
      {
        const auto phase =
          static_cast<std::size_t>((at - head) % static_cast<std::int64_t>(row.size()));
        part = std::string_view(pattern_).substr(phase);
        part = part.substr(0,
          static_cast<std::size_t>(
            std::min(head + rows_ - at, static_cast<std::int64_t>(part.size()))));
      }
      else if (at < head + rows_ + static_cast<std::int64_t>(tail_.size()))
      {
        part = std::string_view(tail_).substr(static_cast<std::size_t>(at - head - rows_));
      }
      else
      {
        break;
      }
      done += part.copy(buffer + done, bytes - done);
    }
    return done;
  }

private:
  std::string head_;
  std::int64_t rows_;
  std::string tail_;
  std::string pattern_;
  std::string path_ = "large";
};

std::string header(std::int64_t rows, std::int64_t step)
{
  return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ATOMS\n" +
    std::to_string(rows) + "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n";
}
}

TEST(LargeFile, TrapOffsetsAndLinesAbove32Bits)
{
  // above 4 GiB in bytes; a frame in front, one behind, one that is not complete at the end
  constexpr std::int64_t count = (std::int64_t{ 9 } << 29) / static_cast<std::int64_t>(row.size());
  const std::string front = header(1, 1) + "7 0.1 0.2 0.3\n";
  const std::string back = header(2, 3) + "8 0.4 0.5 0.6\n9 0.7 0.8 bad\n";
  const LargeSource source(front + header(count, 2), count, back + header(2, 4) + "1 2 3 4\n");
  const auto rows_start = static_cast<std::int64_t>(front.size() + header(count, 2).size());
  const std::int64_t large_end = rows_start + count * static_cast<std::int64_t>(row.size());
  ASSERT_GT(large_end, std::int64_t{ 1 } << 32);

  granular::FileIndex index;
  granular::Progress progress;
  granular::index_dump(source, index, progress);
  EXPECT_EQ(lines_of(index.notices), "");
  ASSERT_EQ(index.frames.size(), 3u);
  EXPECT_EQ(index.frames[1].rows, count);
  EXPECT_EQ(index.frames[1].end, large_end);
  EXPECT_EQ(index.frames[2].offset, large_end);
  EXPECT_EQ(index.frames[2].line, 10 + 9 + count + 1);
  EXPECT_EQ(index.resume_offset, large_end + static_cast<std::int64_t>(back.size()));

  granular::Notices notices;
  granular::Request request;
  EXPECT_EQ(
    error_of([&] { granular::read_dump(source, index.frames[2], request, notices, progress); }),
    "large:" + std::to_string(10 + 9 + count + 9 + 2) +
      ": column 'z': expected a number, got 'bad'");
}

TEST(LargeFile, DecodesFromFarBehind)
{
  constexpr std::int64_t count = (std::int64_t{ 9 } << 29) / static_cast<std::int64_t>(row.size());
  const std::string back = header(2, 3) + "8 0.4 0.5 0.6\n9 0.7 0.8 0.9\n";
  const LargeSource source(header(count, 2), count, back);
  granular::FileIndex index;
  // as if all before had been indexed
  index.resume_offset = static_cast<std::int64_t>(header(count, 2).size()) +
    count * static_cast<std::int64_t>(row.size());
  index.resume_line = 9 + count + 1;
  granular::Progress progress;
  granular::index_dump(source, index, progress);
  ASSERT_EQ(index.frames.size(), 1u);
  Decoded decoded;
  decoded.frame = granular::read_dump(source, index.frames[0], {}, decoded.notices, progress);
  EXPECT_EQ(decoded.points(), (std::vector<double>{ 0.4, 0.5, 0.6, 0.7, 0.8, 0.9 }));
  EXPECT_EQ(decoded.integers("id"), (std::vector<std::int64_t>{ 8, 9 }));
}
