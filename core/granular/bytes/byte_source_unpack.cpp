// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source_unpack.h"

#include "granular/common/error.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t most_points = 1024;
constexpr std::size_t input_bytes = std::size_t{ 1 } << 18;
constexpr std::size_t ring_bytes = std::size_t{ 1 } << 20;
// As much as is wanted at a time, but not in steps that cost more than what is in them.
constexpr std::size_t least_step = std::size_t{ 1 } << 16;
constexpr std::size_t largest_step = std::size_t{ 1 } << 18;

/// Leaves out points that are closer to the one before than the spacing.
void thin(SeekPoints& all)
{
  std::int64_t last = 0;
  std::erase_if(all.points,
    [&](const SeekPoints::Point& point)
    {
      const bool close = point.offset - last < all.spacing;
      last = close ? last : point.offset;
      return close;
    });
}

/// The content of a compressed file: a decoder, and a ring of the last bytes that it gave.
class UnpackedSource final : public ByteSource
{
public:
  /// found: see Decoder.
  UnpackedSource(std::unique_ptr<ByteSource> packed, std::shared_ptr<const SeekPoints> points,
    std::shared_ptr<SeekPoints> found, const MakeDecoder& make_decoder)
    : packed_(std::move(packed))
    , decoder_(make_decoder(*packed_, std::move(found)))
    , points_(std::move(points))
    , ring_(new char[ring_bytes]) // not value-initialised: many files are smaller
  {
  }

  const std::string& path() const override { return packed_->path(); }
  FileStamp stamp() const override { return packed_->stamp(); }
  bool compressed() const override { return true; }
  std::string unchecked() const override { return unchecked_; }
  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override;

  double fraction(std::int64_t) const override { return packed_->fraction(decoder_->position()); }

private:
  void go_to(std::int64_t offset) const;
  void start_at(const SeekPoints::Point& point) const;
  std::size_t copy(std::int64_t offset, char* buffer, std::size_t bytes) const noexcept;
  bool advance(std::int64_t target) const;

  std::unique_ptr<ByteSource> packed_;
  std::unique_ptr<Decoder> decoder_;
  std::shared_ptr<const SeekPoints> points_;
  std::unique_ptr<char[]> ring_; ///< the byte at an offset lies at offset % ring_bytes
  // reading moves these
  mutable std::int64_t begin_ = 0; ///< of the bytes in the ring
  mutable std::int64_t end_ = 0;   ///< where the decoder stands, too, unless lost
  mutable bool lost_ = true;
  mutable std::exception_ptr damage_;
  mutable std::string unchecked_;
};

std::size_t UnpackedSource::read(std::int64_t offset, char* buffer, std::size_t bytes) const
{
  if (damage_)
  {
    std::rethrow_exception(damage_);
  }
  try
  {
    this->go_to(offset);
    std::size_t done = 0;
    do
    {
      done += this->copy(offset + static_cast<std::int64_t>(done), buffer + done, bytes - done);
    } while (done < bytes && this->advance(offset + static_cast<std::int64_t>(bytes)));
    return done;
  }
  catch (const IoError&)
  {
    lost_ = true; // the system may be in a better mood next time
    throw;
  }
  catch (...)
  {
    // Damage shows behind its place: what lies before may be wrong as well, so nothing is given now.
    damage_ = std::current_exception();
    throw;
  }
}

/// Starts again where that is needed to read at an offset, or saves decompressing much.
void UnpackedSource::go_to(std::int64_t offset) const
{
  static const SeekPoints::Point start;
  const auto after =
    std::ranges::upper_bound(points_->points, offset, {}, &SeekPoints::Point::offset);
  const SeekPoints::Point& nearest = after == points_->points.begin() ? start : *std::prev(after);
  const bool far_ahead = nearest.offset > end_ + static_cast<std::int64_t>(largest_step);
  if (lost_ || offset < begin_ || far_ahead)
  {
    this->start_at(nearest);
  }
}

void UnpackedSource::start_at(const SeekPoints::Point& point) const
{
  lost_ = true;
  decoder_->restart(point);
  begin_ = point.offset;
  end_ = point.offset;
  lost_ = false;
}

/// Copies what the ring has of [offset, offset + bytes), which does not begin before it.
std::size_t UnpackedSource::copy(
  std::int64_t offset, char* buffer, std::size_t bytes) const noexcept
{
  if (offset >= end_)
  {
    return 0;
  }
  const std::size_t count = std::min(bytes, static_cast<std::size_t>(end_ - offset));
  const std::size_t at = static_cast<std::size_t>(offset) % ring_bytes;
  const std::size_t first = std::min(count, ring_bytes - at);
  std::memcpy(buffer, ring_.get() + at, first);
  std::memcpy(buffer + first, ring_.get(), count - first);
  return count;
}

/// Decompresses a step towards an offset into the ring; false at the end.
bool UnpackedSource::advance(std::int64_t target) const
{
  const std::size_t at = static_cast<std::size_t>(end_) % ring_bytes;
  const std::size_t step =
    std::clamp(static_cast<std::size_t>(target - end_), least_step, largest_step);
  const std::size_t got = decoder_->decode(ring_.get() + at, std::min(step, ring_bytes - at));
  end_ += static_cast<std::int64_t>(got);
  begin_ = std::max(begin_, end_ - static_cast<std::int64_t>(ring_bytes));
  expect_honest(*decoder_, end_, *packed_);
  if (got == 0)
  {
    unchecked_.clear();
    if (decoder_->cut())
    {
      unchecked_ = std::string("expected the end of the ") + decoder_->name() +
        " data, got the end of the file; what is there is taken unchecked";
    }
  }
  return got > 0;
}

/// Returns true if data begin with a magic number, or are a part of one that no text begins with.
bool begins_with(std::string_view data, std::string_view magic)
{
  return data.size() >= 2 && data.substr(0, magic.size()) == magic.substr(0, data.size());
}

/// Frames of Zstandard that are passed over: 0x184D2A50 to 0x184D2A5F, least byte first. The first three are text, too.
bool is_skippable_frame(std::string_view data)
{
  return data.size() >= 4 && (data[0] & 0xf0) == 0x50 && data.substr(1, 3) == "\x2a\x4d\x18";
}
}

std::size_t SeekPoints::bytes() const noexcept
{
  std::size_t bytes = points.capacity() * sizeof(Point);
  for (const Point& point : points)
  {
    bytes += point.window.empty() ? 0 : point.window.capacity() + 1;
  }
  return bytes;
}

PackedInput::PackedInput(const ByteSource& source)
  : source_(source)
  , buffer_(new unsigned char[input_bytes])
{
}

void PackedInput::seek(std::int64_t position) noexcept
{
  if (position >= start_ && position <= start_ + static_cast<std::int64_t>(filled_))
  {
    next_ = static_cast<std::size_t>(position - start_);
    return;
  }
  start_ = position;
  next_ = 0;
  filled_ = 0;
}

bool PackedInput::more()
{
  if (next_ == filled_)
  {
    start_ = this->position();
    next_ = 0;
    filled_ = 0; // should the read throw
    filled_ = source_.read(start_, reinterpret_cast<char*>(buffer_.get()), input_bytes);
  }
  return next_ < filled_;
}

int PackedInput::get()
{
  return this->more() ? buffer_[next_++] : -1;
}

std::int64_t Decoder::to_next_point() const noexcept
{
  const std::int64_t last = !points_ || points_->points.empty() ? 0 : points_->points.back().offset;
  return std::max(std::int64_t{ 0 }, this->spacing() - (offset_ - last));
}

std::int64_t Decoder::spacing() const noexcept
{
  return points_ ? std::max(std::int64_t{ 1 }, points_->spacing)
                 : std::numeric_limits<std::int64_t>::max();
}

void Decoder::add_point(SeekPoints::Point point)
{
  points_->points.push_back(std::move(point));
  while (points_->points.size() > most_points && points_->spacing < SeekPoints::widest_spacing)
  {
    points_->spacing = std::min(2 * this->spacing(), SeekPoints::widest_spacing);
    thin(*points_);
  }
}

void Decoder::fail(const std::string& why) const
{
  throw FormatError(
    std::string("expected ") + this->name() + " data, got bytes that are none (" + why + ")",
    { in_.path(), 0, in_.position() });
}

void expect_honest(const Decoder& decoder, std::int64_t content, const ByteSource& packed)
{
  if (content <= free_content)
  {
    return;
  }
  const std::int64_t size = packed.stamp().size;
  if (content / largest_expansion > size)
  {
    throw LimitError("expected content of at most " + std::to_string(largest_expansion) +
        " times the " + std::to_string(size) +
        " bytes of the file, got more; if you trust the file, unpack it first",
      { decoder.path(), 0, decoder.position() });
  }
}

MakeDecoder find_decoder(const ByteSource& packed)
{
  std::array<char, 4> first = {};
  const std::string_view magic(first.data(), packed.read(0, first.data(), first.size()));
  if (begins_with(magic, "\x1f\x8b\x08"))
  {
    return [](const ByteSource& source, std::shared_ptr<SeekPoints> points)
    { return make_gzip_decoder(source, std::move(points), inflations().front()); };
  }
  if (begins_with(magic, zstd_magic) || is_skippable_frame(magic))
  {
    return make_zstd_decoder;
  }
  return nullptr;
}

std::unique_ptr<ByteSource> unpack_by(const MakeDecoder& make_decoder,
  std::unique_ptr<ByteSource> packed, std::shared_ptr<SeekPoints> points)
{
  const std::shared_ptr<SeekPoints> found =
    points ? std::move(points) : std::make_shared<SeekPoints>();
  return std::make_unique<UnpackedSource>(std::move(packed), found, found, make_decoder);
}

std::unique_ptr<ByteSource> unpack_known(
  std::unique_ptr<ByteSource> packed, std::shared_ptr<const SeekPoints> points)
{
  if (!points)
  {
    return unpack(std::move(packed), nullptr);
  }
  const MakeDecoder make_decoder = find_decoder(*packed);
  return make_decoder
    ? std::make_unique<UnpackedSource>(std::move(packed), std::move(points), nullptr, make_decoder)
    : std::move(packed);
}

std::unique_ptr<ByteSource> unpack(
  std::unique_ptr<ByteSource> packed, std::shared_ptr<SeekPoints> points)
{
  const MakeDecoder make_decoder = find_decoder(*packed);
  return make_decoder ? unpack_by(make_decoder, std::move(packed), std::move(points))
                      : std::move(packed);
}
}
