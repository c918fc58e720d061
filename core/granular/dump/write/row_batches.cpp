// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/row_batches.h"

#include <algorithm>

namespace granular
{
namespace
{
constexpr std::int64_t chunk_values = std::int64_t{ 1 } << 15; ///< some 300 KB of text or binary
constexpr std::size_t chunks_per_thread = 4;
constexpr std::size_t most_chunks = 32; ///< in a batch, for the memory that they take
}

std::int64_t count_kept(const FrameView& frame, std::int64_t first, std::int64_t end) noexcept
{
  return !frame.ghosts
    ? end - first
    : std::count_if(frame.ghosts + first, frame.ghosts + end,
        [](unsigned char ghost) { return (ghost & FrameView::duplicate_row) == 0; });
}

RowBatches::RowBatches(const RowEncoder& encoder, const Executor& executor)
  : encoder_(encoder)
  , executor_(executor)
  , chunk_rows_(std::max<std::int64_t>(
      16, chunk_values / std::max<std::int64_t>(1, std::ssize(encoder.plan.columns))))
  , chunks_(static_cast<std::size_t>((encoder.frame.rows + chunk_rows_ - 1) / chunk_rows_))
{
  const auto threads = static_cast<std::size_t>(executor.threads());
  const std::size_t in_batch =
    std::min({ chunks_, threads * chunks_per_thread, std::max(most_chunks, threads) });
  buffers_.resize(in_batch);
  values_.resize(executor.workers(in_batch));
  losses_.resize(values_.size());
  const FrameView& frame = encoder.frame;
  std::int64_t kept = 0;
  for (std::size_t chunk = 0; frame.ghosts && chunk < chunks_; ++chunk)
  {
    kept_before_.push_back(kept);
    const std::int64_t first = static_cast<std::int64_t>(chunk) * chunk_rows_;
    kept += count_kept(frame, first, std::min(first + chunk_rows_, frame.rows));
  }
}

void RowBatches::encode(std::size_t chunk, std::size_t worker, RowBuffer& to)
{
  const std::int64_t first = static_cast<std::int64_t>(chunk) * chunk_rows_;
  to.clear();
  encoder_.encode(first, std::min(chunk_rows_, encoder_.frame.rows - first),
    kept_before_.empty() ? first : kept_before_[chunk], values_[worker], to, losses_[worker]);
}

void RowBatches::write_to(FileAppender& file, Progress& progress)
{
  Turns turns;
  executor_.parallel_for(
    chunks_,
    [&](std::size_t chunk, std::size_t worker)
    {
      Turn turn(turns, chunk);
      this->encode(chunk, worker, buffers_[worker]);
      turn.wait();
      const std::int64_t offset = file.take(buffers_[worker].size());
      turn.pass();
      file.write_at(offset, buffers_[worker].bytes());
    },
    progress);
}

bool RowBatches::next(Progress& progress)
{
  filled_ = std::min(buffers_.size(), chunks_ - place_);
  if (filled_ == 0)
  {
    return false;
  }
  PartialProgress part(progress);
  part.set_part(static_cast<double>(place_) / static_cast<double>(chunks_),
    static_cast<double>(place_ + filled_) / static_cast<double>(chunks_));
  executor_.parallel_for(
    filled_,
    [&](std::size_t i, std::size_t worker) { this->encode(place_ + i, worker, buffers_[i]); },
    part);
  place_ += filled_;
  return true;
}

RoundingLoss RowBatches::loss() const
{
  RoundingLoss all;
  std::for_each(losses_.begin(), losses_.end(), [&](const RoundingLoss& loss) { all.add(loss); });
  return all;
}

std::vector<std::string_view> RowBatches::bytes() const
{
  std::vector<std::string_view> bytes;
  std::transform(buffers_.begin(), buffers_.begin() + static_cast<std::ptrdiff_t>(filled_),
    std::back_inserter(bytes), [](const RowBuffer& buffer) { return buffer.bytes(); });
  return bytes;
}
}
