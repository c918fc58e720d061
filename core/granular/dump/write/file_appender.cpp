// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/file_appender.h"

#include "granular/common/progress.h"

#include <algorithm>
#include <utility>

namespace granular
{
FileAppender::FileAppender(
  OutputFile& file, Compression compression, const Executor& executor, std::size_t member_bytes)
  : file_(file)
  , compression_(compression)
  , executor_(executor)
  , member_bytes_(member_bytes)
{
}

void FileAppender::append(std::span<const std::string_view> pieces)
{
  if (compression_ == Compression::None)
  {
    this->write(pieces);
    return;
  }
  for (std::string_view piece : pieces)
  {
    constexpr int most_members = 16; // at a time, for the memory that they take
    const std::size_t most =
      member_bytes_ * static_cast<std::size_t>(std::min(executor_.threads(), most_members));
    while (!piece.empty())
    {
      const std::size_t part = std::min(piece.size(), most - pending_.size());
      pending_ += piece.substr(0, part);
      piece.remove_prefix(part);
      if (pending_.size() == most)
      {
        this->compress_pending(false);
      }
    }
  }
}

std::int64_t FileAppender::take(std::size_t bytes) noexcept
{
  return std::exchange(size_, size_ + static_cast<std::int64_t>(bytes));
}

void FileAppender::write(std::span<const std::string_view> pieces)
{
  std::vector<std::int64_t> offsets;
  for (const std::string_view piece : pieces)
  {
    offsets.push_back(this->take(piece.size()));
  }
  Progress silent;
  executor_.parallel_for(
    pieces.size(),
    [&](std::size_t piece, std::size_t) { file_.write_at(offsets[piece], pieces[piece]); }, silent);
}

void FileAppender::compress_pending(bool all)
{
  const std::string_view pending = pending_;
  const std::size_t whole = pending.size() / member_bytes_;
  const std::size_t count = whole + (all && pending.size() % member_bytes_ != 0 ? 1 : 0);
  std::vector<std::string> members(count);
  Progress silent;
  executor_.parallel_for(
    count,
    [&](std::size_t i, std::size_t)
    { members[i] = compress(pending.substr(i * member_bytes_, member_bytes_), compression_); },
    silent);
  this->write(std::vector<std::string_view>(members.begin(), members.end()));
  pending_.erase(0, std::min(pending.size(), count * member_bytes_));
}
}
