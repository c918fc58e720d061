// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source_unpack.h"

#include "granular/common/error.h"
#include "granular/memory/block.h"

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
constexpr std::int64_t longest_segment = std::int64_t{ 1 } << 26;
constexpr std::size_t fewest_segments = 3;
constexpr std::int64_t shortest_segment = std::int64_t{ 1 } << 18;

struct Content
{
  Block bytes;
  std::size_t size = 0;

  const char* data() const noexcept { return static_cast<const char*>(bytes.data()); }
};

/// From a seek point to the next one. Who changes it holds the mutex of the source.
struct Segment
{
  enum class State
  {
    Absent,
    Made, ///< by a thread, now
    There,
    Damaged
  };

  SeekPoints::Point point;
  std::int64_t end = 0; ///< in the content
  State state = State::Absent;
  std::shared_ptr<const Content> content = {};
  std::exception_ptr damage = {};
  std::int64_t used = 0; ///< greater: later
};

std::size_t length_of(const Segment& segment) noexcept
{
  return static_cast<std::size_t>(segment.end - segment.point.offset);
}

const Segment& longest_of(const std::vector<Segment>& segments)
{
  return *std::ranges::max_element(segments, {}, length_of);
}

class SegmentSource final : public ByteSource
{
public:
  SegmentSource(std::unique_ptr<ByteSource> packed, const MakeDecoder& make_decoder,
    std::vector<Segment> segments, int threads)
    : packed_(std::move(packed))
    , make_decoder_(make_decoder)
    , segments_(std::move(segments))
    , most_(2 * static_cast<std::size_t>(threads) + 2)
    , pool_(std::make_shared<BlockPool>(most_ * length_of(longest_of(segments_))))
  {
  }

  const std::string& path() const override { return packed_->path(); }
  FileStamp stamp() const override { return packed_->stamp(); }
  bool compressed() const override { return true; }
  bool concurrent() const override { return true; }

  double fraction(std::int64_t offset) const override
  {
    return packed_->fraction(segments_[this->find(offset)].point.packed);
  }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    std::size_t done = 0;
    while (done < bytes && offset < segments_.back().end)
    {
      const std::size_t number = this->find(offset);
      const std::shared_ptr<const Content> content = this->get(number);
      const auto from = static_cast<std::size_t>(offset - segments_[number].point.offset);
      if (from >= content->size)
      {
        break; // the file is truncated
      }
      const std::size_t count = std::min(bytes - done, content->size - from);
      std::memcpy(buffer + done, content->data() + from, count);
      done += count;
      offset += static_cast<std::int64_t>(count);
    }
    return done;
  }

private:
  /// The segment with an offset; the first of those behind, the last of those before.
  std::size_t find(std::int64_t offset) const noexcept
  {
    const auto after = std::ranges::upper_bound(
      segments_, offset, {}, [](const Segment& segment) { return segment.point.offset; });
    return static_cast<std::size_t>(std::max(after - segments_.begin(), std::ptrdiff_t{ 1 }) - 1);
  }

  std::shared_ptr<const Content> get(std::size_t number) const;
  std::size_t next_absent(std::size_t number) const noexcept;
  void make(std::size_t number, std::unique_lock<std::mutex>& lock) const;
  std::shared_ptr<const Content> decompress(std::size_t number, Decoder& decoder) const;
  void forget() const;

  std::unique_ptr<ByteSource> packed_;
  MakeDecoder make_decoder_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable std::vector<Segment> segments_;
  mutable std::vector<std::unique_ptr<Decoder>> spare_;
  mutable std::int64_t uses_ = 0;
  std::size_t most_;                ///< segments in memory
  std::shared_ptr<BlockPool> pool_; ///< memory that was touched before
};

/// Returns the content of a segment, made here or by another thread.
std::shared_ptr<const Content> SegmentSource::get(std::size_t number) const
{
  std::unique_lock lock(mutex_);
  bool help = true;
  for (;;)
  {
    Segment& segment = segments_[number];
    switch (segment.state)
    {
      case Segment::State::There:
        segment.used = ++uses_;
        return segment.content;
      case Segment::State::Damaged:
        std::rethrow_exception(segment.damage);
      case Segment::State::Absent:
        this->make(number, lock);
        break;
      case Segment::State::Made:
        if (const std::size_t next = help ? this->next_absent(number) : segments_.size();
            next < segments_.size())
        {
          try
          {
            this->make(next, lock);
          }
          catch (...)
          {
            help = false; // who needs that one meets the error
          }
        }
        else
        {
          changed_.wait(lock);
        }
        break;
    }
  }
}

/// The next segment that nobody has begun, not far behind; else the number of segments.
std::size_t SegmentSource::next_absent(std::size_t number) const noexcept
{
  const std::size_t end = std::min(segments_.size(), number + most_ / 2);
  while (++number < end)
  {
    if (segments_[number].state == Segment::State::Absent)
    {
      return number;
    }
  }
  return segments_.size();
}

/// Decompresses a segment that is absent. The lock is open meanwhile.
void SegmentSource::make(std::size_t number, std::unique_lock<std::mutex>& lock) const
{
  Segment& segment = segments_[number];
  segment.state = Segment::State::Made;
  std::unique_ptr<Decoder> decoder;
  if (!spare_.empty())
  {
    decoder = std::move(spare_.back());
    spare_.pop_back();
  }
  lock.unlock();
  std::shared_ptr<const Content> content;
  std::exception_ptr error;
  bool damaged = false;
  try
  {
    if (!decoder)
    {
      decoder = make_decoder_(*packed_, nullptr);
    }
    content = this->decompress(number, *decoder);
  }
  catch (const IoError&)
  {
    error = std::current_exception(); // the system may be in a better mood next time
  }
  catch (const Error&)
  {
    error = std::current_exception();
    damaged = true;
  }
  catch (...)
  {
    error = std::current_exception();
  }
  lock.lock();
  segment.state = content ? Segment::State::There
    : damaged             ? Segment::State::Damaged
                          : Segment::State::Absent;
  segment.damage = damaged ? error : nullptr;
  segment.content = std::move(content);
  segment.used = ++uses_;
  this->forget();
  changed_.notify_all();
  if (error)
  {
    std::rethrow_exception(error);
  }
  spare_.push_back(std::move(decoder));
}

std::shared_ptr<const Content> SegmentSource::decompress(std::size_t number, Decoder& decoder) const
{
  const Segment& segment = segments_[number];
  const std::size_t length = length_of(segment);
  const auto content = std::make_shared<Content>(Content{ Block(length, pool_) });
  char* const bytes = static_cast<char*>(content->bytes.data());
  decoder.restart(segment.point);
  for (std::size_t got = 1; got > 0 && content->size < length;)
  {
    got = decoder.decode(bytes + content->size, length - content->size);
    content->size += got;
    expect_honest(
      decoder, segment.point.offset + static_cast<std::int64_t>(content->size), *packed_);
  }
  const bool ends_at_next =
    number + 1 < segments_.size() && segment.end == segments_[number + 1].point.offset;
  if (content->size == length && ends_at_next)
  {
    decoder.expect(
      segments_[number + 1].point); // what is damaged must not wait for the end of the member
  }
  return content;
}

/// Lets go of those that nobody has asked for lately.
void SegmentSource::forget() const
{
  for (;;)
  {
    Segment* oldest = nullptr;
    std::size_t there = 0;
    for (Segment& segment : segments_)
    {
      there += segment.state == Segment::State::Made ? 1 : 0;
      if (segment.state == Segment::State::There)
      {
        ++there;
        oldest = oldest == nullptr || segment.used < oldest->used ? &segment : oldest;
      }
    }
    if (there <= most_ || oldest == nullptr)
    {
      return;
    }
    oldest->state = Segment::State::Absent;
    oldest->content.reset();
  }
}

/// The segments of [begin, end), not too short. The start of the file is a place to cut, too.
std::vector<Segment> cut_content(const SeekPoints& all, std::int64_t begin, std::int64_t end)
{
  static const SeekPoints::Point start;
  std::vector<const SeekPoints::Point*> places = { &start };
  for (const SeekPoints::Point& point : all.points)
  {
    if (point.offset >= end)
    {
      break;
    }
    if (point.offset - places.back()->offset >= shortest_segment)
    {
      if (point.offset <= begin)
      {
        places.clear();
      }
      places.push_back(&point);
    }
  }
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    segments.push_back({ *places[i], i + 1 < places.size() ? places[i + 1]->offset : end });
  }
  return segments;
}
}

std::unique_ptr<ByteSource> unpack_segments(std::unique_ptr<ByteSource>& packed,
  const SeekPoints& points, std::int64_t begin, std::int64_t end, int threads)
{
  const MakeDecoder make_decoder =
    threads > 1 && packed->concurrent() ? find_decoder(*packed) : nullptr;
  if (!make_decoder)
  {
    return nullptr;
  }
  std::vector<Segment> segments = cut_content(points, begin, end);
  if (segments.size() < fewest_segments ||
    std::ranges::any_of(segments,
      [](const Segment& segment) { return segment.end - segment.point.offset > longest_segment; }))
  {
    return nullptr;
  }
  return std::make_unique<SegmentSource>(
    std::move(packed), make_decoder, std::move(segments), threads);
}
}
